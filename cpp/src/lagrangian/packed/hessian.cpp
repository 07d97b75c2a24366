#include "saltus/lagrangian/packed_hessian.hpp"

#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace {

using Strided3 = Eigen::Map<const Vec3, 0, Eigen::InnerStride<lanes>>;
using Strided6 = Eigen::Map<const Vec6, 0, Eigen::InnerStride<lanes>>;
using Generators = HessianProduct::Generators;

void sum_below(const VecRef& x, const VecRef& y, HessianProduct& out) {
  for (HessianProduct::Below& each : out.below) {
    each.a.setZero();
    each.g.setZero();
  }
  for (std::size_t i = out.own.size(); i-- > 0;) {
    const Generators& own = out.own[i];
    const double x_i = own.multiplier * x[own.velocity], y_i = own.multiplier * y[own.velocity];
    HessianProduct::Below& to = out.below[i];
    to.a += y_i * own.U + x_i * own.F;
    to.g += x_i * own.G;
    if (own.parent < 0) continue;
    HessianProduct::Below& parent = out.below[static_cast<std::size_t>(own.parent)];
    parent.a += to.a;
    parent.g += to.g;
  }
}

/// Of a joint that is not of a ball.
void multiply_joint(const Generators& own, const HessianProduct::Below& below,
                    const HessianProduct::Above& above, HessianProduct& out) {
  out.by_v[own.velocity] += own.multiplier * (own.S.dot(below.a) + own.U.dot(above.s));
  out.by_q[own.velocity] += own.multiplier * (own.W.dot(below.a) + own.S.head<3>().dot(below.g) +
                                              own.F.dot(above.s) + own.G.dot(above.r));
}

/// Sums over proper ancestors, and the products with both sums.
void multiply_down(const Tree& tree, const VecRef& x, const VecRef& y, HessianProduct& out) {
  for (std::size_t i = 0; i < out.own.size(); ++i) {
    const Generators& own = out.own[i];
    HessianProduct::Above& to = out.above[i];
    if (own.parent < 0) {
      to.s.setZero();
      to.r.setZero();
    } else {
      const auto p = static_cast<std::size_t>(own.parent);
      const Generators& parent = out.own[p];
      const double x_p = parent.multiplier * x[parent.velocity];
      const double y_p = parent.multiplier * y[parent.velocity];
      to.s = out.above[p].s + y_p * parent.S + x_p * parent.W;
      to.r = out.above[p].r + x_p * parent.S.head<3>();
    }
    if (!tree.joint[i].is_ball()) multiply_joint(own, out.below[i], to, out);
  }
}

/// Within a ball each joint is above all three, itself included, in L_vv, L_vq, L_qq; and so below
/// all in their transposes.
void multiply_ball(const PackedBall& ball, const VecRef& x, const VecRef& y, int first,
                   bool transposed, HessianProduct& out) {
  HessianProduct::Below of_v = out.below[first], of_q = of_v;
  HessianProduct::Above up_v = out.above[first], up_q = up_v;
  for (int k = 0; k < 3; ++k) {
    const Generators& own = out.own[static_cast<std::size_t>(first + k)];
    const double x_k = x[ball.velocity + k], y_k = y[ball.velocity + k];
    of_q.a -= y_k * own.U;
    up_q.s += y_k * own.S;
    if (!transposed) continue;
    of_q.a -= x_k * own.F;
    of_q.g -= x_k * own.G;
    up_q.s += x_k * own.W;
    up_q.r += x_k * own.S.head<3>();
  }
  for (int k = 0; k < 3; ++k) {
    const Generators& own = out.own[static_cast<std::size_t>(first + k)];
    out.by_v[ball.velocity + k] = own.S.dot(of_v.a) + own.U.dot(up_v.s);
    out.by_q[ball.velocity + k] =
        own.W.dot(of_q.a) + own.S.head<3>().dot(of_q.g) + own.F.dot(up_q.s) + own.G.dot(up_q.r);
  }
}

/// What coordinates have of their own, and forces on one of them.
void add_own(const PackedTree& t, const Packed& w, const VecRef& x, const VecRef& y,
             HessianProduct& out) {
  for (std::size_t c = 0; c < t.slot_of_velocity.size(); ++c) {
    const int slot = t.slot_of_velocity[c];
    const auto i = static_cast<Eigen::Index>(c);
    if (!t.own.empty()) {
      const double* own = at(t.own, slot);
      out.by_v[i] += own[0] * y[i];
      out.by_q[i] -= own[lanes] * x[i];
    }
    if (w.slope.empty()) continue;
    const double* slope = at(w.slope, slot);
    out.by_q[i] += slope[0] * x[i];
  }
  if (t.potentials == nullptr) return;
  for (const CurveSpring& c : t.potentials->curves) {
    const double slope = c.multiplier * c.multiplier * packed::value_of(c, t, w).slope;
    out.by_q[c.velocity] -= slope * x[c.velocity];
  }
}

void add_slopes_by_v(const PackedTree& t, const Packed& w, const VecRef& y, VecX& to) {
  for (std::size_t c = 0; c < t.slot_of_velocity.size() && !w.slope.empty(); ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    to[i] += at(w.slope, t.slot_of_velocity[c])[lanes] * y[i];
  }
}

void multiply(const Tree& tree, const PackedTree& t, const Packed& w, const VecRef& x,
              const VecRef& y, bool transposed, HessianProduct& out) {
  out.by_v.setZero();
  out.by_q.setZero();
  sum_below(x, y, out);
  multiply_down(tree, x, y, out);
  for (std::size_t b = 0; b < t.balls.size(); ++b) {
    multiply_ball(t.balls[b], x, y, tree.balls[b].joint, transposed, out);
  }
  add_own(t, w, x, y, out);
}

}  // namespace

HessianProduct::HessianProduct(const Tree& tree)
    : own(static_cast<std::size_t>(tree.joints())), below(own.size()), above(own.size()) {
  for (VecX* each : {&by_v, &by_q}) each->setZero(tree.n_v);
}

void take_generators(const Tree& tree, const PackedTree& t, const Packed& w, HessianProduct& out) {
  for (int i = 0; i < tree.joints(); ++i) {
    const int slot = t.slot[i];
    const double *S_W = at(w.S_W, slot), *U_F_G = at(w.U_F_G, slot);
    Generators& own = out.own[static_cast<std::size_t>(i)];
    own.S = Strided6(S_W);
    own.W = Strided6(S_W + 6 * lanes);
    own.U = Strided6(U_F_G);
    own.F = Strided6(U_F_G + 6 * lanes);
    own.G = Strided3(U_F_G + 12 * lanes);
    own.multiplier = tree.drive[i].multiplier;
    own.velocity = tree.drive[i].velocity;
    own.parent = tree.parent[i];
  }
}

void multiply_by_hessian(const Tree& tree, const PackedTree& t, const Packed& w, const VecRef& x,
                         const VecRef& y, HessianProduct& out) {
  multiply(tree, t, w, x, y, false, out);
  add_slopes_by_v(t, w, y, out.by_q);
  for (Eigen::Index r = 0; r < w.coupled.cols(); ++r) {
    const double rate = w.coupled_q.col(r).dot(x) + w.coupled_v.col(r).dot(y);
    out.by_q += rate * w.coupled.col(r);
  }
}

void multiply_by_transposed(const Tree& tree, const PackedTree& t, const Packed& w, const VecRef& x,
                            const VecRef& y, HessianProduct& out) {
  multiply(tree, t, w, x, y, true, out);
  add_slopes_by_v(t, w, x, out.by_v);
  for (Eigen::Index r = 0; r < w.coupled.cols(); ++r) {
    const double push = w.coupled.col(r).dot(x);
    out.by_q += push * w.coupled_q.col(r);
    out.by_v += push * w.coupled_v.col(r);
  }
}

}  // namespace saltus
