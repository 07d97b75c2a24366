#include "variational/energy_meter.hpp"

namespace saltus {

EnergyMeter::EnergyMeter(const ModelData& model)
    : energy{0, 0, 0}, w(model.packed), M(model.tree, model.packed), products(model.packed) {
  for (VecX* x : {&v, &L_q, &L_vq_v, &L_qq_v, &force, &a}) x->setZero(model.tree.coordinates);
}

// kappa = a^T M a - v^T L_qq v with M a = L_q - L_vq v (theory, section 5); a^T M a = a . force.
bool measure(const ModelData& model, const VecX& q, const VecX& p, double h, EnergyMeter& m) {
  const Tree& tree = model.tree;
  const PackedTree& packed = model.packed;
  set_coordinates(tree, packed, q, m.w);
  place(packed, m.w);
  mass_pass(packed, m.w);
  if (!factorize(tree, packed, m.w, 0, m.M)) return false;
  m.v = p;
  solve(tree, packed, m.M, m.v);

  set_rates(tree, packed, m.v, m.w);
  move(packed, m.w);
  first_pass(packed, m.w);
  second_pass(packed, m.w);
  multiply_by_rates(packed, m.w, m.products);
  gather(tree, packed, m.w.first, 1, m.L_q);
  gather(tree, packed, m.products.by_joint, 0, m.L_vq_v);
  gather(tree, packed, m.products.by_joint, 2, m.L_qq_v);
  m.force = m.L_q - m.L_vq_v;
  m.a = m.force;
  solve(tree, packed, m.M, m.a);
  const double kappa = m.a.dot(m.force) - m.v.dot(m.L_qq_v);

  m.energy.kinetic = 0.5 * p.dot(m.v);
  m.energy.potential = potential_energy(packed, m.w);
  m.energy.shadow = m.energy.kinetic + m.energy.potential - h * h * kappa / 24;
  return true;
}

}  // namespace saltus
