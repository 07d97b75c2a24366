// Positions and changes of positions: q (n_q) and v (n_v), which differ where there are balls.
//
//   q (+) x: one-degree joints add; a ball's R becomes exp(f) R, f its three numbers of x, in the
//            axes of its placement                                            (theory, O)
//   q1 (-) q0: the x with q0 (+) x = q1, of balls the shortest, |f| <= pi
//
// Quaternions are x y z w, child's axes in those of the placement. They are normalised by every
// (+), to 2e-16.
#pragma once

#include "saltus/spatial/rotation.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {

/// out <- q (+) scale v; `out` (n_q) may be q itself.
SALTUS_EXPORT void integrate(const Tree& tree, const VecRef& q, double scale, const VecRef& v,
                             VecX& out);

/// out (n_v) <- q1 (-) q0.
SALTUS_EXPORT void difference(const Tree& tree, const VecRef& q0, const VecRef& q1, VecX& out);

/// All numbers 0, but quaternions, which are the identity.
SALTUS_EXPORT VecX neutral(const Tree& tree);

/// The quaternion of a ball.
inline Eigen::Map<const Quaternion> quaternion(const Ball& ball, const VecRef& q) {
  return Eigen::Map<const Quaternion>(q.data() + ball.coordinate);
}

/// [rad | m] displacement of a one-degree joint; 0 of a ball's.
inline double displacement(const Tree& tree, int joint, const VecRef& q) {
  if (tree.joint[joint].is_ball()) return 0;
  const Drive& drive = tree.drive[joint];
  return drive.multiplier * q[tree.coordinate[drive.velocity]] + drive.offset;
}

/// The ball that a joint of kind ball is of.
SALTUS_EXPORT const Ball& ball_of(const Tree& tree, int joint);

}  // namespace saltus
