#include "saltus/model/check_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "model/assembly.hpp"

namespace saltus {
namespace {

constexpr double step = 1e-3;  ///< of differences, and half of it: 1e-12 is left of their errors
constexpr int places = 3;

/// A function of x (n_v), as far from where it is differentiated.
using Shifted = std::function<VecX(const VecX& dx)>;

MatX central(const Shifted& f, Eigen::Index n, double h) {
  MatX out;
  for (Eigen::Index j = 0; j < n; ++j) {
    const VecX dx = h * VecX::Unit(n, j);
    const VecX column = (f(dx) - f(-dx)) / (2 * h);
    if (j == 0) out.resize(column.size(), n);
    out.col(j) = column;
  }
  return out;
}

/// @throws ModelError where `analytic` is not the derivative of f at 0.
void compare(const std::string& kind, const std::string& name, const std::string& what,
             const MatX& analytic, const Shifted& f, Eigen::Index n) {
  const MatX rough = central(f, n, step), fine = central(f, n, step / 2);
  const MatX numeric = (4 * fine - rough) / 3;
  const double size = analytic.cwiseAbs().maxCoeff() + numeric.cwiseAbs().maxCoeff() +
                      f(VecX::Zero(n)).cwiseAbs().maxCoeff();
  Eigen::Index i = 0, j = 0;
  const double worst = (analytic - numeric).cwiseAbs().maxCoeff(&i, &j);
  if (worst <= 1e-7 * size) return;
  const double order =
      std::log2(std::abs(rough(i, j) - analytic(i, j)) / std::abs(fine(i, j) - analytic(i, j)));
  std::ostringstream text;
  text.precision(9);
  text << kind << " " << quoted(name) << ": " << what << "[";
  if (what != "gradient") text << i << ", ";
  text << j << "] is " << analytic(i, j) << ", and differences say " << numeric(i, j);
  text.precision(2);
  text << "; as they are refined they come nearer with order " << order << " (2 where it is right)";
  throw ModelError(text.str(), kind, name);
}

/// Places to look at: the same for all.
struct Places {
  explicit Places(const Model& of) : model(of) {}
  const Model& model;
  std::mt19937_64 random{7};

  VecX q() { return model.random_configuration(random); }
  VecX v() {
    std::normal_distribution<double> normal;
    return VecX::NullaryExpr(model.n_v(), [&] { return normal(random); });
  }
};

void check_potential(const Model& model, const PotentialFunction& V) {
  Places at_random(model);
  const Eigen::Index n = model.n_v();
  for (int k = 0; k < places; ++k) {
    const VecX q = at_random.q();
    VecX V_q(n);
    MatX V_qq(n, n);
    V.gradient(q, V_q);
    V.hessian(q, V_qq);
    const auto value = [&](const VecX& dx) {
      return VecX(VecX::Constant(1, V.value(model.integrate(q, dx))));
    };
    const auto gradient = [&](const VecX& dx) {
      VecX out(n);
      V.gradient(model.integrate(q, dx), out);
      return out;
    };
    compare("potential", V.name, "gradient", V_q.transpose(), value, n);
    compare("potential", V.name, "Hessian", V_qq, gradient, n);
  }
}

template <class Items>
const auto* find(const Items& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const auto& each) { return each.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

void check_derivatives(const Model& model, const FunctionForce& force) {
  Places at_random(model);
  const Eigen::Index n = model.n_v();
  bool has_any = false;
  for (int k = 0; k < places; ++k) {
    const double t = 0.1 * k;
    const VecX q = at_random.q(), v = at_random.v();
    ForceAnswer answer;
    ask(force, {t, q, v}, answer);
    const auto Q = [&](const VecX& q_at, const VecX& v_at) {
      ForceAnswer other;
      ask(force, {t, q_at, v_at}, other);
      return other.Q;
    };
    if (answer.Q_q.size() > 0) {
      const auto by_q = [&](const VecX& dx) { return Q(model.integrate(q, dx), v); };
      compare("force", force.name, "Q_q", answer.Q_q, by_q, n);
    }
    if (answer.Q_v.size() > 0) {
      const auto by_v = [&](const VecX& dx) { return Q(q, v + dx); };
      compare("force", force.name, "Q_v", answer.Q_v, by_v, n);
    }
    has_any = has_any || answer.Q_q.size() + answer.Q_v.size() > 0;
  }
  if (has_any) return;
  throw ModelError("force " + quoted(force.name) +
                       " returns Q alone: it has no derivatives that could be checked",
                   "force", force.name);
}

void check_derivatives(const Model& model, const std::string& name) {
  if (const auto* force = find(model->forces.functions, name)) {
    check_derivatives(model, *force);
  } else if (const auto* V = find(model->mass.potentials.functions, name)) {
    check_potential(model, *V);
  } else {
    std::vector<std::string> names;
    for (const FunctionForce& each : model->forces.functions) names.push_back(each.name);
    for (const PotentialFunction& each : model->mass.potentials.functions) {
      names.push_back(each.name);
    }
    throw ModelError("no force or potential " + quoted(name) + "; there are " + list_names(names),
                     "force", name);
  }
}

}  // namespace saltus
