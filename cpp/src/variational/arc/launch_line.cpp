#include "variational/arc/launch_line.hpp"

#include <cmath>

#include "variational/arc/arc.hpp"

namespace saltus {

void take_out_line(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  LaunchLine& line = *a.launch;
  // dE_d/dv = L_vv v + tau/2 C^T (L_qv v - L_q); w has v as its rates, and L_vv v = L_v
  multiply_by_rates(model.packed, s.w, s.products);
  gather(model.tree, model.packed, s.products.by_joint, 1, line.row);
  gather(model.tree, model.packed, s.w.first, 1, s.x);
  line.row -= s.x;
  pull_back_middle(model.packed, s.J, line.row);
  gather(model.tree, model.packed, s.w.first, 0, s.x);
  line.row = s.x + a.tau / 2 * line.row;
  if (a.whole > 0) {  // of what c kappa adds, the part without second partials of kappa
    const ShadowTerm& shadow = s.compensation->shadow;
    line.row += a.tau * a.tau / 12 * (shadow.kappa_v + a.tau / 2 * shadow.kappa_q);
  }
  line.column = line.n;
  solve(model.tree, model.packed, s.J, line.column);
  line.own = line.row.dot(line.column);
  const double c = discrete_energy(model, a, v, s) - line.energy;
  const double dlambda = -(c + line.row.dot(s.dv)) / line.own;
  line.lambda += dlambda;
  s.dv += dlambda * line.column;
}

double line_residual(const ModelData& model, const ArcProblem& a, const VecX& v,
                     const ArcScratch& s) {
  if (!is_matched(a.launch)) return 0;
  const double target = a.launch->energy, energy = discrete_energy(model, a, v, s);
  return std::abs(energy - target) / (std::abs(target) + std::abs(v.dot(s.L_v)));
}

}  // namespace saltus
