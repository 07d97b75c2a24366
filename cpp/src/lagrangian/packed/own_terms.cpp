// What a coordinate has of its own: armature, a spring, slopes of forces (theory, F1).
//
// All of it stands in one slot a coordinate and couples nothing, so that plain loops over
// coordinates do.
#include "lagrangian/packed/own_terms.hpp"

#include "lagrangian/packed/potentials.hpp"

#include <cmath>

namespace saltus::packed {
namespace {

/// Calls f(slot, armature, stiffness, rest) for each coordinate.
template <class F>
void for_each_own(const PackedTree& t, const F& f) {
  if (t.own.empty()) return;
  for (const int slot : t.slot_of_velocity) {
    const double* own = at(t.own, slot);
    f(slot, own[0], own[lanes], own[2 * lanes]);
  }
}

/// Delta += -tau/2 Q_v C of a ball.
void add_to_ball(const PackedBall& ball, double slope, double tau, PackedMatrix& J) {
  double* numbers = at(J.ball, ball.slot[2]);
  for (int c = 0; c < 9; ++c)
    numbers[(18 + c) * lanes] -= tau / 2 * slope * numbers[(9 + c) * lanes];
}

}  // namespace

void add_own_partials(const PackedTree& t, Packed& w) {
  for_each_own(t, [&](int slot, double armature, double stiffness, double rest) {
    double* first = at(w.first, slot);
    first[0] += armature * *at(w.s_dot, slot);
    first[lanes] -= stiffness * (*at(w.s, slot) - rest);
  });
}

void add_own_scale(const PackedTree& t, double tau, Packed& w) {
  for_each_own(t, [&](int slot, double armature, double stiffness, double rest) {
    const double pull = stiffness * (std::abs(*at(w.s, slot)) + std::abs(rest));
    *at(w.scale, slot) += armature * std::abs(*at(w.s_dot, slot)) + tau / 2 * pull;
  });
}

double own_energy(const PackedTree& t, const Packed& w) {
  double V = 0;
  for_each_own(t, [&](int slot, double, double stiffness, double rest) {
    const double x = *at(w.s, slot) - rest;
    V += stiffness / 2 * x * x;
  });
  return V;
}

void add_own_products(const PackedTree& t, const Packed& w, PackedProducts& out) {
  for_each_own(t, [&](int slot, double, double stiffness, double) {
    at(out.by_joint, slot)[2 * lanes] -= stiffness * *at(w.s_dot, slot);
  });
  if (t.potentials != nullptr) add_curve_products(t, w, out);
  for (std::size_t c = 0; c < t.slot_of_velocity.size() && !w.slope.empty(); ++c) {
    const int slot = t.slot_of_velocity[c];
    at(out.by_joint, slot)[2 * lanes] += *at(w.slope, slot) * *at(w.s_dot, slot);
  }
  const std::vector<int>& slots = t.slot_of_velocity;
  for (Eigen::Index r = 0; r < w.coupled.cols(); ++r) {
    double rate = 0;
    for (std::size_t c = 0; c < slots.size(); ++c) {
      rate += w.coupled_q(static_cast<Eigen::Index>(c), r) * *at(w.s_dot, slots[c]);
    }
    for (std::size_t c = 0; c < slots.size(); ++c) {
      at(out.by_joint, slots[c])[2 * lanes] += w.coupled(static_cast<Eigen::Index>(c), r) * rate;
    }
  }
}

void add_own_torques(const PackedTree& t, const Packed& w, PackedForces& out) {
  for_each_own(t, [&](int slot, double armature, double stiffness, double rest) {
    *at(out.tau, slot) += armature * *at(out.s_ddot, slot) + stiffness * (*at(w.s, slot) - rest);
  });
}

void add_own_shadow(const PackedTree& t, const Packed& w, ShadowTerm& out) {
  for_each_own(t, [&](int slot, double armature, double stiffness, double) {
    const double v = *at(w.s_dot, slot), a = *at(out.s_ddot, slot);
    double* to = at(out.by_joint, slot);
    to[0] += stiffness * v * v - armature * a * a;
    to[lanes] -= 2 * stiffness * a;
    to[2 * lanes] += 2 * stiffness * v;
  });
}

void set_own_pivots(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J) {
  const bool has_slopes = tau > 0 && !w.slope.empty();
  const bool has_curves = t.potentials != nullptr && !t.potentials->curves.empty();
  const bool has_lock = J.lock.size() > 0;
  if (t.own.empty() && !has_slopes && !has_curves && !has_lock) {
    J.added.clear();
    return;
  }
  J.added.assign(static_cast<std::size_t>(t.slots / lanes), {});
  for_each_own(t, [&](int slot, double armature, double stiffness, double) {
    *at(J.added, slot) = armature + tau * tau / 4 * stiffness;
  });
  if (has_curves) add_curve_pivots(t, w, tau, J);
  for (Eigen::Index c = 0; c < J.lock.size(); ++c) {
    *at(J.added, t.slot_of_velocity[static_cast<std::size_t>(c)]) += J.lock[c];
  }
  if (!has_slopes) return;
  for (const PackedBall& ball : t.balls) {
    add_to_ball(ball, at(w.slope, ball.slot[2])[lanes], tau, J);
  }
  for (const int slot : t.slot_of_velocity) {
    const double* slope = at(w.slope, slot);
    *at(J.added, slot) -= tau / 2 * (slope[lanes] + tau / 2 * slope[0]);
  }
  for (const PackedBall& ball : t.balls) {  // those are in Delta
    for (const int slot : ball.slot) *at(J.added, slot) = 0;
  }
}

void add_to_diagonal(const PackedGroup& g, PackedMatrix& J) {
  if (J.added.empty()) return;
  for (int k = 0; k < g.positions; ++k) {
    for (int lane = 0; lane < g.width; ++lane) {
      const double own = *at(J.added, g.slot(k) + lane);
      const long entry = g.row[k] * lanes + g.level[k] * g.width + lane;
      J.lower[entry / lanes].x[0][entry % lanes] += own;
      if (!J.symmetric) J.upper[entry / lanes].x[0][entry % lanes] += own;
    }
  }
}

bool set_coupled(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J) {
  if (w.coupled.cols() == 0 || !(tau > 0)) return false;
  if (w.coupled_q.isZero(0) && w.coupled_v.isZero(0)) return false;
  J.G = w.coupled;
  J.H = tau / 2 * w.coupled_q;
  for (const PackedBall& ball : t.balls) {
    const double* C = at(J.ball, ball.slot[2]) + 9 * lanes;
    const Eigen::Map<const Mat3, 0, Eigen::Stride<3 * lanes, lanes>> map(C);
    for (Eigen::Index r = 0; r < J.G.cols(); ++r) {
      J.G.col(r).segment<3>(ball.velocity) = map * w.coupled.col(r).segment<3>(ball.velocity);
      const Vec3 by_middle = J.H.col(r).segment<3>(ball.velocity);
      J.H.col(r).segment<3>(ball.velocity) = map.transpose() * by_middle;
    }
  }
  J.H += w.coupled_v;
  J.H *= -tau / 2;
  return true;
}

void add_coupled(PackedMatrix& J) {
  for (Eigen::Index r = 0; r < J.G.cols(); ++r) {
    J.dense.noalias() += J.G.col(r) * J.H.col(r).transpose();
  }
}

bool factorize_coupled(const Tree& tree, const PackedTree& t, const Packed& w, double tau,
                       PackedMatrix& J) {
  if (!set_coupled(t, w, tau, J)) return true;
  const Eigen::Index n = J.G.cols();
  J.JG.resize(J.G.rows(), n);
  for (VecX* each : {&J.Hx, &J.Hy}) each->resize(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    J.column = J.G.col(r);
    solve_scaled(tree, t, J, J.column);
    J.JG.col(r) = J.column;
  }
  J.inner.noalias() = J.H.transpose() * J.JG;
  J.inner.diagonal().array() += 1;
  J.inner_lu.compute(J.inner);
  const auto pivots = J.inner_lu.matrixLU().diagonal().array();
  J.is_coupled = pivots.isFinite().all() && (pivots.abs() > 0).all();
  return J.is_coupled;
}

void solve_coupled(PackedMatrix& J, VecX& x) {
  if (!J.is_coupled) return;
  J.Hx.noalias() = J.H.transpose() * x;
  J.Hy = J.inner_lu.solve(J.Hx);
  x.noalias() -= J.JG * J.Hy;
}

// (J^T + H G^T)^-1 = J^-T (1 - H (1 + G^T J^-T H)^-1 (J^-1 G)^T)
void solve_coupled_transposed(PackedMatrix& J, VecX& x) {
  if (!J.is_coupled) return;
  J.Hx.noalias() = J.JG.transpose() * x;
  J.Hy = J.inner_lu.transpose().solve(J.Hx);
  x.noalias() -= J.H * J.Hy;
}

}  // namespace saltus::packed
