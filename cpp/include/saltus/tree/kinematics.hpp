// Down pass: poses, screws and twists of all joints (theory: section 2, "down").
//
//   V_i = V_parent + S_i v_i          W_i = V_i x S_i
//
// For the three joints of a ball W takes V of the third, which is the child's (theory, O1).
//
// World axes. The reference point O of each tree is the origin of its first turning joint, moving
// with it: any point that is held fixed while differentiating is valid, and this one keeps all
// digits when the tree is far from the world's origin (|p| enters inertias as its square).
#pragma once

#include <vector>

#include "saltus/tree/tree.hpp"

namespace saltus {

/// Pose and motion of one joint frame.
struct JointMotion {
  Vec6 S = Vec6::Zero();  ///< unit screw about O                     written by set_configuration
  Vec6 V = Vec6::Zero();  ///< twist of the joint frame about O       written by set_velocity
  Vec6 W = Vec6::Zero();  ///< V x S, of a ball with the third's V    written by set_velocity
  Mat3 R;                 ///< R_WJ                                   written by set_configuration
  Vec3 p;                 ///< [m] origin of J from O, world axes     written by set_configuration
  double s = 0;           ///< [rad | m] displacement, 0 of a ball's  written by set_configuration
};

/// Where all joints are, and how they move.
struct Kinematics {
  std::vector<JointMotion> joint;  ///< (n)
  std::vector<Vec3> origin;        ///< (n) [m] p_WO of the tree that joint i belongs to; by root

  Kinematics() = default;
  /// Sized for a tree; poses are not set.
  explicit Kinematics(const Tree& tree) : joint(tree.parent.size()), origin(tree.parent.size()) {}

  /// Pose of joint frame i in the world; i = -1 is the world itself.
  Pose X_WJ(const Tree& tree, int i) const {
    if (i < 0) return {};
    return {joint[i].R, joint[i].p + origin[tree.root[i]]};
  }
};

/// Writes R, p, S and origin from q (n_q).
SALTUS_EXPORT void set_configuration(const Tree& tree, const VecRef& q, Kinematics& kin);

/// Writes V and W from v (n_v); needs set_configuration first.
SALTUS_EXPORT void set_velocity(const Tree& tree, const VecRef& v, Kinematics& kin);

/// Joint-space vector of the velocities: out[i] = multiplier_i * v[velocity_i].
SALTUS_EXPORT void to_joints(const Tree& tree, const VecRef& v, VecX& out);

/// Adjoint of to_joints: out[k] = sum of multiplier_i * f[i] over the joints that v[k] drives.
SALTUS_EXPORT void to_coordinates(const Tree& tree, const VecRef& f, VecX& out);

}  // namespace saltus
