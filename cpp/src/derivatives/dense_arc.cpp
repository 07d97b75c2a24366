#include "derivatives/dense_arc.hpp"

#include "derivatives/small_products.hpp"

namespace saltus {
namespace {

using Turn = TurnDerivative;

/// X <- X A on balls.
template <Mat3 Turn::* A>
void turn_columns(const ArcDerivative& arc, MatX& X) {
  for (const Turn& t : arc.turns) {
    X.middleCols<3>(t.velocity) = (X.middleCols<3>(t.velocity) * (t.*A)).eval();
  }
}

/// X <- A X on balls.
template <Mat3 Turn::* A>
void turn_rows(const ArcDerivative& arc, MatX& X) {
  for (const Turn& t : arc.turns) {
    X.middleRows<3>(t.velocity) = (t.*A * X.middleRows<3>(t.velocity)).eval();
  }
}

/// f_q and, in N, f_v.
void set_force_slopes(const ModelData& model, const Packed& w, DenseScratch& s) {
  s.f_q = s.L.L_qq;
  s.N = s.L.L_vq.transpose();
  if (w.coupled.cols() > 0) s.N += w.coupled * w.coupled_v.transpose();
  for (Eigen::Index c = 0; c < s.N.rows() && !w.slope.empty(); ++c) {
    const int slot = model.packed.slot_of_velocity[static_cast<std::size_t>(c)];
    s.f_q(c, c) += at(w.slope, slot)[0];
    s.N(c, c) += at(w.slope, slot)[lanes];
  }
}

/// J^-1 into s.J.
bool set_inverse(const ModelData& model, ArcDerivative& arc, DenseScratch& s) {
  const double half = arc.tau / 2;
  if (arc.turns.empty()) {
    s.J = s.L.L_vv + half * (s.L.L_vq - s.N) - half * half * s.f_q;
    if (arc.s.shift.size() > 0) {
      s.J.diagonal() += half * arc.s.shift.cwiseProduct(model.forces.damping);
    }
    return invert(s.J);
  }
  s.J.setIdentity(model.tree.n_v, model.tree.n_v);
  VecX column;
  for (Eigen::Index c = 0; c < s.J.cols(); ++c) {
    column = s.J.col(c);
    solve_scaled(model.tree, model.packed, arc.s.J, column);
    s.J.col(c) = column;
  }
  return s.J.allFinite();
}

/// G and N of the header, and f_q half, with what rows of balls have more, into f_q.
void set_parts(const ArcDerivative& arc, DenseScratch& s) {
  const double half = arc.tau / 2;
  s.G = s.f_q;
  turn_rows<&Turn::C>(arc, s.G);
  s.G = s.L.L_vq - half * s.G;
  turn_columns<&Turn::half>(arc, s.G);
  s.part = half * s.f_q;
  turn_columns<&Turn::C>(arc, s.part);
  s.N += s.part;
  if (arc.turns.empty()) return;
  s.part = half * s.L.L_vq;
  turn_columns<&Turn::C>(arc, s.part);
  s.part += s.L.L_vv;
  for (const Turn& t : arc.turns) {
    const Mat3 rate = cross_matrix(t.rate);
    s.N.middleRows<3>(t.velocity) += rate * s.part.middleRows<3>(t.velocity);
    s.N.block<3, 3>(t.velocity, t.velocity) -= cross_matrix(t.L_v);
    s.f_q.middleRows<3>(t.velocity) += rate * s.L.L_vq.middleRows<3>(t.velocity);
  }
  turn_columns<&Turn::half>(arc, s.f_q);
}

}  // namespace

bool is_plain(const FlownArc& arc) {
  return arc.held.size() == 0 && arc.kick.size() == 0 && !arc.match.is_set &&
         arc.held.rubs.size() == 0 && arc.arc.energy_q.size() == 0;
}

bool set_dense(const ModelData& model, FlownArc& flown, DenseScratch& s) {
  if (flown.has_dense) return true;
  ArcDerivative& arc = flown.arc;
  const Eigen::Index n = model.tree.n_v;
  const double tau = arc.tau;
  second_partials(model.tree, model.packed, arc.s.w, s.rows, s.L);
  set_force_slopes(model, arc.s.w, s);
  if (!set_inverse(model, arc, s)) return false;
  set_parts(arc, s);
  MatX& A = flown.dense;
  A.resize(2 * n, 2 * n);
  s.dv.setZero(n, n);
  add_product(s.J, s.G, s.dv);
  s.dv = -s.dv;
  s.part = s.f_q;
  add_product(s.N, s.dv, s.part);
  turn_rows<&Turn::K>(arc, s.dv);
  A.topLeftCorner(n, n) = tau * s.dv;
  A.bottomLeftCorner(n, n) = tau * s.part;
  turn_columns<&Turn::K>(arc, s.J);
  s.part.setZero(n, n);
  add_product(s.N, s.J, s.part);
  turn_rows<&Turn::K>(arc, s.J);
  A.topRightCorner(n, n) = tau * s.J;
  A.bottomRightCorner(n, n) = tau * s.part;
  A.diagonal().array() += 1;
  for (const Turn& t : arc.turns) {
    A.block<3, 3>(t.velocity, t.velocity) += t.whole - Mat3::Identity();
  }
  flown.has_dense = true;
  return true;
}

void push_dense(const ModelData& model, FlownArc& flown, const MatX& dQ, const VecX& left,
                bool is_unit, MatX& Z) {
  const ArcDerivative& arc = flown.arc;
  const Eigen::Index n = model.tree.n_v;
  if (is_unit) {
    Z = flown.dense;
  } else if (!Z.isZero(0)) {
    MatX out = MatX::Zero(Z.rows(), Z.cols());
    add_product(flown.dense, Z, out);
    Z.swap(out);
  }
  if (dQ.cols() > 0) {
    MatX dp = arc.tau / 2 * dQ;
    for (const Turn& t : arc.turns) {
      dp.middleRows<3>(t.velocity) = (t.K.inverse() * t.C * dp.middleRows<3>(t.velocity)).eval();
    }
    const MatX by_p = flown.dense.rightCols(n);
    add_product(by_p, dp, Z);
    Z.bottomRows(n) += arc.tau * dQ - dp;
  }
  if (left.isZero(0)) return;
  Tangent b{VecX::Zero(n), VecX::Zero(n), 0, 0};
  push_flown(model, flown, VecX::Zero(n), 1, {}, b);
  Z.topRows(n) += b.q * left.transpose();
  Z.bottomRows(n) += b.p * left.transpose();
}

}  // namespace saltus
