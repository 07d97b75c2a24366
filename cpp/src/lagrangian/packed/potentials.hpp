// Potentials beside gravity and linear springs of coordinates (potentials.cpp), for the passes.
#pragma once

#include "saltus/lagrangian/newton_euler.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/lagrangian/packed_point.hpp"
#include "saltus/lagrangian/shadow.hpp"

namespace saltus {

struct PackedSpring {
  PackedPoint a, b;
  std::string name;
  double stiffness, length;
  /// V is smooth at d = 0.
  bool is_smooth() const { return length == 0; }
};

struct PackedForce {
  PackedPoint at;
  Vec3 force;
};

struct PackedPotentials {
  std::vector<PackedSpring> springs;
  std::vector<PackedForce> forces;
  std::vector<CurveSpring> curves;
  std::vector<PotentialFunction> functions;
  int n_q = 0;
};

namespace packed {

/// Writes t.potentials and t.columns. Needs all else of `t`.
void set_potentials(const Tree& tree, const Potentials& from, PackedTree& t);
/// Room in `w` for what they are to write.
void prepare_potentials(const PackedTree& t, Packed& w);

/// Places springs; writes w.pull. Needs place.
void set_pull(const PackedTree& t, Packed& w);
/// To L_q.
void add_potential_partials(const PackedTree& t, Packed& w);
/// To the L_q' and L_v' of balls.
void add_potential_arcs(const PackedTree& t, double tau, Packed& w);
/// To the scale of an arc's residual.
void add_potential_scale(const PackedTree& t, double tau, Packed& w);
/// To G, and the first columns of w.coupled.
void add_potential_generators(const PackedTree& t, Packed& w);
/// Slopes of curves: to J.added, to L_qq v.
void add_curve_pivots(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J);
void add_curve_products(const PackedTree& t, const Packed& w, PackedProducts& out);
double potential_energy_of(const PackedTree& t, const Packed& w);
/// To the torques of newton_euler. @throws StepError as check_springs
void add_potential_torques(const PackedTree& t, const Packed& w, PackedForces& out);
/// To the torques of gravity_pass: what is compensated.
void add_compensation(const PackedTree& t, const Packed& w, PackedForces& out);
/// To kappa and its gradient; of functions none.
void add_potential_shadow(const PackedTree& t, const Packed& w, ShadowTerm& out);

inline CurveValue value_of(const CurveSpring& c, const PackedTree& t, const Packed& w) {
  const double s = c.multiplier * *at(w.s, t.slot_of_velocity[c.velocity]) + c.offset;
  return c.curve(s);
}

}  // namespace packed
}  // namespace saltus
