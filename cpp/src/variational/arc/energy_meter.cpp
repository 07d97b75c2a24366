#include "variational/arc/energy_meter.hpp"

#include "saltus/lagrangian/packed_point.hpp"

namespace saltus {

EnergyMeter::EnergyMeter(const ModelData& model)
    : energy{0, 0, 0},
      w(model.packed),
      M(model.tree, model.packed),
      free(model.tree, model.packed) {
  v.setZero(model.tree.n_v);
}

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
  check_springs(packed, m.w);
  free_motion(tree, packed, m.w, m.M, m.free);

  m.energy.kinetic = 0.5 * p.dot(m.v);
  m.energy.potential = potential_energy(packed, m.w);
  m.energy.shadow = m.energy.kinetic + m.energy.potential - h * h * m.free.kappa / 24;
  return true;
}

}  // namespace saltus
