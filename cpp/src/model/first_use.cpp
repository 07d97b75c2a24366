// Are the derivatives of a user's functions right? A look at the first use of a model: cheap, and
// sure of what it says.
#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "model/assembly.hpp"
#include "saltus/model/check_derivatives.hpp"

namespace saltus {
namespace {

constexpr int places = 2;
constexpr double step = 1e-4;    ///< of differences: 1e-8 of the third derivative, rounding 1e-12
constexpr double beside = 0.01;  ///< [rad | m] places from q, off kinks that a start is on
constexpr double speed = 0.3;    ///< [rad/s | m/s] of rates there

/// Functions of x, as far from where they are differentiated.
using Shifted = std::function<MatX(const VecX& dx)>;

/// A derivative as a function says it: entry (i, j) of f by x_j.
struct Claim {
  std::string kind, name, what;
  MatX says;
};

std::string words(const Claim& claim, Eigen::Index i, Eigen::Index j, double numeric) {
  std::ostringstream text;
  text.precision(9);
  text << claim.kind << " " << quoted(claim.name) << ": " << claim.what << "[";
  if (claim.what != "gradient") text << i << ", ";
  text << j << "] is " << claim.says(i, j) << ", and differences say " << numeric
       << "; check_derivatives looks at all of it";
  return text.str();
}

/// What is wrong, "" where nothing is known to be. 1e-5: far above rounding, and a wrong derivative
/// is wrong by parts of itself.
std::string flaw(const Claim& claim, const Shifted& f) {
  const VecX at = f(VecX::Zero(claim.says.cols()));
  const double most = at.size() > 0 ? at.cwiseAbs().maxCoeff() : 0;
  const double size = claim.says.size() > 0 ? claim.says.cwiseAbs().maxCoeff() : 0;
  for (Eigen::Index j = 0; j < claim.says.cols(); ++j) {
    const VecX dx = step * VecX::Unit(claim.says.cols(), j);
    const VecX more = f(dx), less = f(-dx);
    for (Eigen::Index i = 0; i < claim.says.rows(); ++i) {
      const double numeric = (more[i] - less[i]) / (2 * step);
      const double kink = std::abs(more[i] - 2 * at[i] + less[i]) / step;
      const double tolerance = 1e-5 * std::max(size, std::abs(numeric)) + 1e-7 * most + 10 * kink;
      if (std::abs(claim.says(i, j) - numeric) > tolerance) return words(claim, i, j, numeric);
    }
  }
  return {};
}

struct Place {
  const Model& model;
  double t;
  VecX q, v;
};

MatX column(const VecX& x) { return x; }

std::string flaw_of(const Place& at, const FunctionForce& force) {
  ForceAnswer answer;
  ask(force, {at.t, at.q, at.v}, answer);
  const auto Q = [&](const VecX& q, const VecX& v) {
    ForceAnswer other;
    ask(force, {at.t, q, v}, other);
    return column(other.Q);
  };
  std::string found;
  if (answer.Q_q.size() > 0) {
    found = flaw({"force", force.name, "Q_q", answer.Q_q},
                 [&](const VecX& dx) { return Q(at.model.integrate(at.q, dx), at.v); });
  }
  if (answer.Q_v.size() > 0 && found.empty()) {
    found = flaw({"force", force.name, "Q_v", answer.Q_v},
                 [&](const VecX& dx) { return Q(at.q, at.v + dx); });
  }
  return found;
}

std::string flaw_of(const Place& at, const PotentialFunction& V) {
  const Eigen::Index n = at.model.n_v();
  VecX V_q(n);
  MatX V_qq(n, n);
  V.gradient(at.q, V_q);
  V.hessian(at.q, V_qq);
  if (V_q.size() != n || V_qq.rows() != n || V_qq.cols() != n) return {};  // a step says it
  const std::string found =
      flaw({"potential", V.name, "gradient", V_q.transpose()}, [&](const VecX& dx) {
        return MatX(MatX::Constant(1, 1, V.value(at.model.integrate(at.q, dx))));
      });
  if (!found.empty()) return found;
  return flaw({"potential", V.name, "Hessian", V_qq}, [&](const VecX& dx) {
    VecX gradient(n);
    V.gradient(at.model.integrate(at.q, dx), gradient);
    return column(gradient);
  });
}

/// What a function throws where no step has been is no error of a run: the place is left out.
template <class Function>
void check(const std::string& kind, const Place& at, const Function& function) {
  std::string found;
  try {
    found = flaw_of(at, function);
  } catch (const std::exception&) {
    return;
  }
  if (!found.empty()) throw ModelError(found, kind, function.name);
}

}  // namespace

// The mark is set first: others that start meanwhile do not wait, nor look as well.
void check_derivatives_once(const Model& model, const VecRef& q, double t) {
  const std::shared_ptr<std::atomic<bool>>& mark = model->has_checked_functions;
  if (mark == nullptr || mark->exchange(true)) return;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto random_vector = [&](double size) {
    return VecX(VecX::NullaryExpr(model.n_v(), [&] { return size * normal(random); }));
  };
  try {
    for (int k = 0; k < places; ++k) {
      const Place at{model, t, model.integrate(q, random_vector(beside)), random_vector(speed)};
      for (const FunctionForce& each : model->forces.functions) check("force", at, each);
      for (const PotentialFunction& each : model->mass.potentials.functions) {
        check("potential", at, each);
      }
    }
  } catch (const ModelError&) {
    *mark = false;  // wrong as before
    throw;
  }
}

}  // namespace saltus
