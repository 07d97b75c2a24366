// The tree of joints: one-degree joints, each a unit screw about the z axis of its own frame.
//
// X_PJ(q) = X_PJ(0) exp(s e_z), s = multiplier * q[coordinate] + offset, for joint J with parent P.
// Every axis is re-framed to z when the joint is added, so that the kinematics have no case for
// the direction of an axis. Fixed joints do not exist here: they are folded into placements.
#pragma once

#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// A unit screw about (or along) z.
struct Joint {
  enum class Kind { revolute, prismatic, helical };
  Kind kind = Kind::revolute;
  double pitch = 0;  ///< [m/rad] helical only: advance along the axis per radian

  bool turns() const { return kind != Kind::prismatic; }
};

/// Which coordinate drives a joint: `s = multiplier * q[coordinate] + offset` (mimic joints share
/// a coordinate).
struct Drive {
  int coordinate = 0;
  double multiplier = 1;
  double offset = 0;
};

/// Joints in topological order: `parent[i] < i`; -1 is the world.
struct Tree {
  int coordinates = 0;         ///< n_q
  std::vector<int> parent;     ///< (n)
  std::vector<Joint> joint;    ///< (n)
  std::vector<Pose> X_PJ;      ///< (n) placement in the parent's frame at s = 0
  std::vector<Drive> drive;    ///< (n)
  std::vector<int> root;       ///< (n) the world's child above joint i (or i itself)
  std::vector<int> reference;  ///< (n) valid at roots: the joint whose origin is O of that tree
  bool one_to_one = true;      ///< drive[i] = {i, 1, 0} for all i: no mimic joints

  int joints() const { return static_cast<int>(parent.size()); }
  bool is_ancestor(int i, int j) const {  ///< i is j or above j
    while (j > i) j = parent[j];
    return i == j;
  }
};

/// Appends a joint and keeps the derived fields (root, reference, one_to_one) right.
/// @return index of the new joint. Writes: every field of `tree`.
SALTUS_EXPORT int add_joint(Tree& tree, int parent, const Joint& joint, const Pose& X_PJ,
                            const Drive& drive);

/// Rotation that takes z to the unit vector `axis`; exact (a permutation) for coordinate axes, so
/// that planar motion stays planar to the last bit.
SALTUS_EXPORT Mat3 rotation_z_to(const Vec3& axis);

}  // namespace saltus
