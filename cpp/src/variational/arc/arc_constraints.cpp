#include "variational/arc/arc_constraints.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {
namespace {

/// c and dc/dv of one constraint; c is scaled by tau (hold), so that it stays regular at tau = 0.
double constraint(const ModelData& model, const ArcProblem& a, const VecX& v, ArcConstraint& c,
                  ArcScratch& s) {
  c.row.setZero();
  if (c.kind == ArcConstraint::Kind::hold) {
    const Gap g = pair_gap_at_end(model, c.watched(), s);
    add_gap_gradient(model.tree, s.kin_end, c.watched(), g, c.row);
    pull_back_end(model.packed, s.J, c.row);
    return (g.phi - c.target) / a.tau;
  }
  // dE_d/dv = L_vv v + tau/2 C^T (L_qv v - L_q); w has v as its rates, and L_vv v = L_v
  multiply_by_rates(model.packed, s.w, s.products);
  gather(model.tree, model.packed, s.products.by_joint, 1, c.row);
  gather(model.tree, model.packed, s.w.first, 1, s.x);
  c.row -= s.x;
  pull_back_middle(model.packed, s.J, c.row);
  gather(model.tree, model.packed, s.w.first, 0, s.x);
  c.row = s.x + a.tau / 2 * c.row;
  if (a.whole > 0) {  // of what c kappa adds, the part without second partials of kappa
    const ShadowTerm& shadow = s.compensation->shadow;
    c.row += a.tau * a.tau / 12 * (shadow.kappa_v + a.tau / 2 * shadow.kappa_q);
  }
  return discrete_energy(model, a, v, s) - c.target;
}

}  // namespace

void add_constraints(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const int m = static_cast<int>(a.constraints.size());
  if (m == 0) return;
  integrate(model.tree, a.q, a.tau, v, s.q);
  place_end(model, s.q, s);
  SmallMat S(m, m);
  SmallVec rhs(m);
  for (int i = 0; i < m; ++i) {
    ArcConstraint& c = a.constraints[i];
    rhs[i] = -constraint(model, a, v, c, s) - c.row.dot(s.dv);
    c.column = c.n;
    solve(model.tree, model.packed, s.J, c.column);
  }
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) S(i, j) = a.constraints[i].row.dot(a.constraints[j].column);
  }
  const SmallVec dlambda = solve_small(S, rhs);
  for (int i = 0; i < m; ++i) {
    a.constraints[i].lambda += dlambda[i];
    s.dv += dlambda[i] * a.constraints[i].column;
  }
}

double constraint_residual(const ModelData& model, const ArcProblem& a, const VecX& v,
                           ArcScratch& s) {
  double size = 0;
  if (a.constraints.empty()) return size;
  integrate(model.tree, a.q, a.tau, v, s.q);
  place_end(model, s.q, s);
  for (ArcConstraint& c : a.constraints) {
    if (c.kind == ArcConstraint::Kind::hold) {
      const double phi = pair_gap_at_end(model, c.watched(), s).phi;
      // 1e-12: a hundredth of pair.touch is closed
      size = std::max(size, std::abs(phi - c.target) / c.pair->touch * 1e-12);
    } else {
      const double energy = discrete_energy(model, a, v, s);
      size = std::max(size,
                      std::abs(energy - c.target) / (std::abs(c.target) + std::abs(v.dot(s.L_v))));
    }
  }
  return size;
}

}  // namespace saltus
