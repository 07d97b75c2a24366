#include "saltus/lagrangian/partials.hpp"

#include "lagrangian/packed/potentials.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/lagrangian/second_partials.hpp"

namespace saltus {
namespace {

/// Spreads the rows over both triangles; coordinates that drive several joints collect them.
void add_pairs(const Tree& tree, const PackedTree& t, const SecondPartials& rows,
               LagrangianPartials& L) {
  for_each_pair(t, [&](int j, int i, long entry) {
    const Drive &dj = tree.drive[j], &di = tree.drive[i];
    const int cj = dj.velocity, ci = di.velocity;
    const double scale = di.multiplier * dj.multiplier;
    const double vv = scale * number(rows.L_vv, entry), qq = scale * number(rows.L_qq, entry);
    L.L_vv(ci, cj) += vv;
    L.L_qq(ci, cj) += qq;
    L.L_vq(ci, cj) += scale * number(rows.L_vq, entry);
    if (i == j) return;
    L.L_vv(cj, ci) += vv;
    L.L_qq(cj, ci) += qq;
    L.L_vq(cj, ci) += scale * number(rows.L_qv, entry);
  });
  for (const PackedBall& ball : t.balls) {
    const double* lower = at(rows.L_qq_lower, ball.slot[2]);
    const int c = ball.velocity;
    L.L_qq(c + 1, c) = lower[0];
    L.L_qq(c + 2, c) = lower[lanes];
    L.L_qq(c + 2, c + 1) = lower[2 * lanes];
  }
}

/// What coordinates have of their own, in L_vv and L_qq.
void add_own_pairs(const PackedTree& t, MatX& L_vv, MatX* L_qq) {
  for (std::size_t c = 0; c < t.slot_of_velocity.size() && !t.own.empty(); ++c) {
    const double* own = at(t.own, t.slot_of_velocity[c]);
    const auto i = static_cast<Eigen::Index>(c);
    L_vv(i, i) += own[0];
    if (L_qq) (*L_qq)(i, i) -= own[lanes];
  }
}

/// What forces that join several coordinates have in L_qq.
void add_coupled_pairs(const Packed& w, MatX& L_qq) {
  if (w.coupled.cols() > 0) L_qq += w.coupled * w.coupled_q.transpose();
}

/// Of curves.
void add_curve_pairs(const PackedTree& t, const Packed& w, MatX& L_qq) {
  if (t.potentials == nullptr) return;
  for (const CurveSpring& c : t.potentials->curves) {
    L_qq(c.velocity, c.velocity) -= c.multiplier * c.multiplier * packed::value_of(c, t, w).slope;
  }
}

/// Writes L_v and L_q by joint, and all that second_pass needs.
void set_first_partials(const Tree& tree, const PackedTree& t, const VecRef& q, const VecRef& v,
                        Packed& w) {
  set_coordinates(tree, t, q, w);
  set_rates(tree, t, v, w);
  place(t, w);
  move(t, w);
  first_pass(t, w);
}

}  // namespace

void second_partials(const Tree& tree, const PackedTree& t, const Packed& w, SecondPartials& rows,
                     LagrangianPartials& L) {
  multiply_pairs(t, w, rows);
  for (MatX* x : {&L.L_qq, &L.L_vq, &L.L_vv}) x->setZero(tree.n_v, tree.n_v);
  add_pairs(tree, t, rows, L);
  add_own_pairs(t, L.L_vv, &L.L_qq);
  add_coupled_pairs(w, L.L_qq);
  add_curve_pairs(t, w, L.L_qq);
}

void lagrangian(const Tree& tree, const PackedTree& t, const VecRef& q, const VecRef& v,
                LagrangianPartials& L) {
  Packed w(t);
  SecondPartials rows(t);
  set_first_partials(tree, t, q, v, w);
  check_springs(t, w);
  const double V = potential_energy(t, w);
  second_pass(t, w);
  second_partials(tree, t, w, rows, L);
  for (VecX* x : {&L.L_q, &L.L_v}) x->resize(tree.n_v);
  gather(tree, t, w.first, 0, L.L_v);
  gather(tree, t, w.first, 1, L.L_q);
  L.value = 0.5 * v.dot(L.L_v) - V;
}

LagrangianPartials lagrangian(const Tree& tree, const PackedTree& t, const VecRef& q,
                              const VecRef& v) {
  LagrangianPartials L;
  lagrangian(tree, t, q, v, L);
  return L;
}

VecX momenta(const Tree& tree, const PackedTree& t, const VecRef& q, const VecRef& v) {
  Packed w(t);
  set_first_partials(tree, t, q, v, w);
  VecX p(tree.n_v);
  gather(tree, t, w.first, 0, p);
  return p;
}

MatX mass_matrix(const Tree& tree, const PackedTree& t, const VecRef& q) {
  Packed w(t);
  SecondPartials rows(t);
  set_coordinates(tree, t, q, w);
  place(t, w);
  mass_pass(t, w);
  multiply_pairs(t, w, rows);
  MatX M = MatX::Zero(tree.n_v, tree.n_v);
  for_each_pair(t, [&](int j, int i, long entry) {
    const Drive &dj = tree.drive[j], &di = tree.drive[i];
    const double M_ij = di.multiplier * dj.multiplier * number(rows.L_vv, entry);
    M(di.velocity, dj.velocity) += M_ij;
    if (i != j) M(dj.velocity, di.velocity) += M_ij;
  });
  add_own_pairs(t, M, nullptr);
  return M;
}

}  // namespace saltus
