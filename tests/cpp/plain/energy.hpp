// Potential energy, and products of the second partials with a vector in O(n).
#pragma once

#include <vector>

#include "plain/composite.hpp"

namespace saltus::plain {

/// V = -sum m g.c  [J], with the world's origin at height zero. Needs set_configuration.
double potential_energy(const Tree& tree, const MassModel& mass, const Kinematics& kin);

/// Products with one joint-space vector x (n), all by joint (n).
struct SecondPartialsTimes {
  VecX L_vq_x;  ///< L_vq x
  VecX L_qv_x;  ///< L_vq^T x
  VecX L_qq_x;  ///< L_qq x
  VecX L_vv_x;  ///< L_vv x

  struct Below {
    Vec6 U, F;
    Vec3 G;
  };
  struct Above {
    Vec6 S, W;
  };
  std::vector<Below> below;  ///< (n) scratch: sums over subtrees
  std::vector<Above> above;  ///< (n) scratch: sums over ancestors
};

/// Writes all four products from prefix sums along the branches. Needs second_pass.
void multiply_second_partials(const Tree& tree, const Kinematics& kin, const Composite& comp,
                              const VecRef& x, SecondPartialsTimes& out);

}  // namespace saltus::plain
