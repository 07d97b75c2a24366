// The tree of joints: one-degree joints, each a unit screw about the z axis of its own frame.
//
// X_PJ(q) = X_PJ(0) exp(s e_z), s = multiplier * q + offset, for joint J with parent P. Every axis
// is re-framed to z when the joint is added, so that the kinematics have no case for the direction
// of an axis. Fixed joints do not exist here: they are folded into placements.
//
// A ball is three joints of this list through one point, one for each axis x, y, z of its placement
// (theory, O1). None of them turns the next: their screws do not depend on q, and the frame of the
// third is turned by a unit quaternion, four numbers of q where v has three.
#pragma once

#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// A unit screw about (or along) z.
struct Joint {
  /// How it moves.
  enum class Kind { revolute, prismatic, helical, ball };
  Kind kind = Kind::revolute;  ///< of this joint
  double pitch = 0;            ///< [m/rad] helical only: advance along the axis per radian
  int axis = 0;                ///< ball only: 0, 1, 2; the third carries what the ball turns

  /// Of any pitch, or a ball's.
  bool turns() const { return kind != Kind::prismatic; }
  /// One of a ball's three.
  bool is_ball() const { return kind == Kind::ball; }
};

/// Which velocity drives a joint: its rate is `multiplier * v[velocity]`, and its displacement, but
/// for a ball, `multiplier * q[tree.coordinate[velocity]] + offset` (mimic joints share a
/// velocity).
struct Drive {
  int velocity = 0;       ///< index in v
  double multiplier = 1;  ///< of the velocity
  double offset = 0;      ///< [rad | m]
};

/// Three joints, `joint` the first, and where their numbers are.
struct Ball {
  int joint;       ///< the first of the three
  int velocity;    ///< of the first axis; the others follow
  int coordinate;  ///< of the quaternion x y z w
};

/// Joints in topological order: `parent[i] < i`; -1 is the world.
struct Tree {
  int n_q = 0;                  ///< numbers in q: a ball has four
  int n_v = 0;                  ///< numbers in v and p: a ball has three
  std::vector<int> coordinate;  ///< (n_v) index in q of what v moves; of a ball its quaternion's
  std::vector<Ball> balls;      ///< in the order of their joints
  std::vector<int> parent;      ///< (n)
  std::vector<Joint> joint;     ///< (n)
  std::vector<Pose> X_PJ;       ///< (n) placement in the parent's frame at s = 0
  std::vector<Drive> drive;     ///< (n)
  std::vector<int> root;        ///< (n) the world's child above joint i (or i itself)
  std::vector<int> reference;   ///< (n) valid at roots: the joint whose origin is O of that tree
  bool one_to_one = true;       ///< drive[i] = {i, 1, 0} for all i: no mimic joints

  /// n
  int joints() const { return static_cast<int>(parent.size()); }
  bool is_ancestor(int i, int j) const {  ///< i is j or above j
    while (j > i) j = parent[j];
    return i == j;
  }
};

/// Appends a joint and keeps the derived fields (n_q, n_v, root, reference, one_to_one) right. A
/// velocity is numbered when a joint first names it, and those before it that none has named yet.
/// @return index of the new joint. Writes: every field of `tree` but `balls`.
SALTUS_EXPORT int add_joint(Tree& tree, int parent, const Joint& joint, const Pose& X_PJ,
                            const Drive& drive);

/// Appends the three joints of a ball, whose velocities are the tree's next three.
/// @return index of the third, which carries the child. Writes: every field of `tree`.
SALTUS_EXPORT int add_ball(Tree& tree, int parent, const Pose& X_PJ);

/// Rotation that takes z to the unit vector `axis`; exact (a permutation) for coordinate axes, so
/// that planar motion stays planar to the last bit.
SALTUS_EXPORT Mat3 rotation_z_to(const Vec3& axis);

/// Joints of one ball: the order in which they turn is none.
inline bool are_of_one_ball(const Tree& tree, int i, int j) {
  return tree.joint[i].is_ball() && tree.joint[j].is_ball() &&
         i - tree.joint[i].axis == j - tree.joint[j].axis;
}

}  // namespace saltus
