// Springs between points, constant forces, curves and functions in the passes (theory, F2).
//
//   point spring  f_a = -k (1 - l/d) r, f_b = -f_a    Q = (J_a - J_b)^T f_a
//   V_qq = (J_a - J_b)^T K (J_a - J_b) - f.H          K = k (1 - l/d) 1 + k l/d n n^T
//
// f.H, H = dJ/dq, is made of generators G = J x f, as gravity's is, that of constant forces too;
// the rest are three columns a spring. All of it is by velocity and added to slots at the end, so
// that plain loops do.
#include "lagrangian/packed/potentials.hpp"

#include <cmath>
#include <sstream>

#include "saltus/error.hpp"

namespace saltus::packed {
namespace {

/// k (1 - l/d), which pulls at d = 0 in no direction.
double tension_of(const PackedSpring& spring, double d) {
  if (spring.is_smooth()) return spring.stiffness;
  return d > 0 ? spring.stiffness * (1 - spring.length / d) : 0;
}

void check_answer(const PotentialFunction& V, const char* what, const MatX& x, Eigen::Index rows,
                  Eigen::Index columns) {
  const auto refuse = [&](const std::string& why) {
    throw ModelError("potential \"" + V.name + "\" returned " + what + why, "potential", V.name);
  };
  if (x.rows() != rows || x.cols() != columns) {
    refuse(" of " + std::to_string(x.rows()) + " by " + std::to_string(x.cols()) +
           " numbers; it is " + std::to_string(rows) + " by " + std::to_string(columns));
  }
  if (!x.allFinite()) refuse(" that is not finite");
}

/// The sum of V_q of all functions, (n_v).
VecX gradients(const PackedPotentials& all, const Packed& w) {
  const Eigen::Index n = w.pull.size();
  VecX sum = VecX::Zero(n), V_q(n);
  for (const PotentialFunction& each : all.functions) {
    each.gradient(w.q, V_q);
    check_answer(each, "a gradient", V_q, n, 1);
    sum += V_q;
  }
  return sum;
}

void add_to_slots(const PackedTree& t, const VecX& Q, double by, int number, Blocks<2>& to) {
  for (std::size_t c = 0; c < t.slot_of_velocity.size(); ++c) {
    at(to, t.slot_of_velocity[c])[number * lanes] += by * Q[static_cast<Eigen::Index>(c)];
  }
}

}  // namespace

void set_potentials(const Tree& tree, const Potentials& from, PackedTree& t) {
  if (from.empty()) return;
  auto all = std::make_shared<PackedPotentials>();
  for (const PointSpring& s : from.springs) {
    all->springs.push_back(
        {pack_point(tree, t, s.a), pack_point(tree, t, s.b), s.name, s.stiffness, s.length});
  }
  for (const PointForce& f : from.forces) {
    all->forces.push_back({pack_point(tree, t, f.at), f.force});
  }
  all->curves = from.curves;
  all->functions = from.functions;
  all->n_q = tree.n_q;
  t.columns = static_cast<int>(3 * all->springs.size()) +
              tree.n_v * static_cast<int>(all->functions.size());
  t.dense_arcs = 3 * t.columns > tree.n_v;
  t.potentials = std::move(all);
}

void prepare_potentials(const PackedTree& t, Packed& w) {
  if (t.potentials == nullptr) return;
  const auto n = static_cast<Eigen::Index>(t.slot_of_velocity.size());
  w.springs.resize(t.potentials->springs.size());
  for (MatX* each : {&w.coupled, &w.coupled_q, &w.coupled_v}) each->setZero(n, t.columns);
  for (VecX* each : {&w.pull, &w.pull_size}) each->setZero(n);
  if (t.potentials->functions.empty()) return;
  w.function_pull.setZero(n);
  w.q.setZero(t.potentials->n_q);
}

void set_pull(const PackedTree& t, Packed& w) {
  const PackedPotentials& all = *t.potentials;
  w.pull.setZero();
  w.pull_size.setZero();
  for (std::size_t k = 0; k < all.springs.size(); ++k) {
    const PackedSpring& s = all.springs[k];
    Packed::PlacedSpring& at_k = w.springs[k];
    at_k.P_a = position_from_O(w, s.a);
    at_k.P_b = position_from_O(w, s.b);
    at_k.r = (at_k.P_a - at_k.P_b) + (origin_of(w, s.a) - origin_of(w, s.b));
    at_k.d = at_k.r.norm();
    at_k.force = -tension_of(s, at_k.d) * at_k.r;
    add_pull(w, s.a, at_k.P_a, at_k.force, w.pull, w.pull_size);
    add_pull(w, s.b, at_k.P_b, -at_k.force, w.pull, w.pull_size);
  }
  for (const PackedForce& f : all.forces) {
    add_pull(w, f.at, position_from_O(w, f.at), f.force, w.pull, w.pull_size);
  }
  for (const CurveSpring& c : all.curves) {
    const double f = c.multiplier * value_of(c, t, w).f;
    w.pull[c.velocity] -= f;
    w.pull_size[c.velocity] += std::abs(f);
  }
}

void add_potential_partials(const PackedTree& t, Packed& w) {
  const PackedPotentials& all = *t.potentials;
  add_to_slots(t, w.pull, 1, 1, w.first);
  if (all.functions.empty()) return;
  w.function_pull = -gradients(all, w);
  add_to_slots(t, w.function_pull, 1, 1, w.first);
}

void add_potential_arcs(const PackedTree& t, double tau, Packed& w) {
  add_ball_pull(t, tau, w.pull, w);
  if (w.function_pull.size() > 0) add_ball_pull(t, tau, w.function_pull, w);
}

void add_potential_scale(const PackedTree& t, double tau, Packed& w) {
  for (std::size_t c = 0; c < t.slot_of_velocity.size(); ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    double size = w.pull_size[i];
    if (w.function_pull.size() > 0) size += std::abs(w.function_pull[i]);
    *at(w.scale, t.slot_of_velocity[c]) += tau / 2 * size;
  }
}

void add_potential_generators(const PackedTree& t, Packed& w) {
  const PackedPotentials& all = *t.potentials;
  for (const PackedForce& f : all.forces) {
    add_pull_partials(f.at, position_from_O(w, f.at), f.force, w);
  }
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < all.springs.size(); ++k, column += 3) {
    const PackedSpring& s = all.springs[k];
    const Packed::PlacedSpring& at_k = w.springs[k];
    add_pull_partials(s.a, at_k.P_a, at_k.force, w);
    add_pull_partials(s.b, at_k.P_b, -at_k.force, w);
    w.coupled.middleCols<3>(column).setZero();
    add_motion(w, s.a, at_k.P_a, 1, w.coupled.middleCols(column, 3));
    add_motion(w, s.b, at_k.P_b, -1, w.coupled.middleCols(column, 3));
    Mat3 K = tension_of(s, at_k.d) * Mat3::Identity();
    if (!s.is_smooth() && at_k.d > 0) {
      const double d3 = at_k.d * at_k.d * at_k.d;
      K += s.stiffness * s.length / d3 * (at_k.r * at_k.r.transpose());
    }
    w.coupled_q.middleCols<3>(column) = -w.coupled.middleCols<3>(column).lazyProduct(K);
  }
  if (all.functions.empty()) return;
  const Eigen::Index n = w.pull.size();
  MatX V_qq(n, n);
  for (const PotentialFunction& each : all.functions) {
    each.hessian(w.q, V_qq);
    check_answer(each, "a Hessian", V_qq, n, n);
    w.coupled.middleCols(column, n).setIdentity();
    w.coupled_q.middleCols(column, n) = -V_qq.transpose();
    column += n;
  }
}

void add_curve_pivots(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J) {
  for (const CurveSpring& c : t.potentials->curves) {
    const double slope = c.multiplier * c.multiplier * value_of(c, t, w).slope;
    *at(J.added, t.slot_of_velocity[c.velocity]) += tau * tau / 4 * slope;
  }
}

void add_curve_products(const PackedTree& t, const Packed& w, PackedProducts& out) {
  for (const CurveSpring& c : t.potentials->curves) {
    const int slot = t.slot_of_velocity[c.velocity];
    const double slope = c.multiplier * c.multiplier * value_of(c, t, w).slope;
    at(out.by_joint, slot)[2 * lanes] -= slope * *at(w.s_dot, slot);
  }
}

double potential_energy_of(const PackedTree& t, const Packed& w) {
  const PackedPotentials& all = *t.potentials;
  double V = 0;
  for (std::size_t k = 0; k < all.springs.size(); ++k) {
    const double x = w.springs[k].d - all.springs[k].length;
    V += all.springs[k].stiffness / 2 * x * x;
  }
  for (const PackedForce& f : all.forces) {
    V -= f.force.dot(position_from_O(w, f.at) + origin_of(w, f.at));
  }
  for (const CurveSpring& c : all.curves) V += value_of(c, t, w).integral;
  for (const PotentialFunction& each : all.functions) {
    const double value = each.value(w.q);
    check_answer(each, "a value", MatX::Constant(1, 1, value), 1, 1);
    V += value;
  }
  return V;
}

void add_potential_torques(const PackedTree& t, const Packed& w, PackedForces& out) {
  const PackedPotentials& all = *t.potentials;
  check_springs(t, w);
  const auto subtract = [&](const VecX& pull, double by) {
    for (std::size_t c = 0; c < t.slot_of_velocity.size(); ++c) {
      *at(out.tau, t.slot_of_velocity[c]) -= by * pull[static_cast<Eigen::Index>(c)];
    }
  };
  subtract(w.pull, 1);
  if (!all.functions.empty()) subtract(gradients(all, w), -1);
}

void add_compensation(const PackedTree& t, const Packed& w, PackedForces& out) {
  for (const PackedForce& f : t.potentials->forces) {
    const Vec3 P = position_from_O(w, f.at);
    for (const PointMover& m : f.at.movers) {  // by joint: gather has the multipliers
      *at(out.tau, m.slot) += motion_of(w, m.slot, P).dot(f.force);
    }
  }
}

}  // namespace saltus::packed

namespace saltus {

void check_springs(const PackedTree& t, const Packed& w, double time) {
  for (std::size_t k = 0; t.potentials != nullptr && k < t.potentials->springs.size(); ++k) {
    const PackedSpring& spring = t.potentials->springs[k];
    if (spring.is_smooth() || w.springs[k].d != 0) continue;  // no number is another's error
    std::ostringstream text;
    text << "spring \"" << spring.name << "\" has both ends in one point at t = " << time
         << " s, where its force has no direction; one of length 0 may pass there";
    throw StepError(text.str(), time, 0, 0);
  }
}

}  // namespace saltus
