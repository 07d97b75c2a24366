// A damper between two points: the force -c d' along the line between them (theory, F2).
//
//   r = P_a - P_b, d = |r|, n = r / d, d' = n.r'       f_a = -c d' n, f_b = -f_a
//
// Where both points are one, n is that of r', and where that is 0, too, there is no force.
#pragma once

#include <string>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

struct PointDamper {
  std::string name;
  int joint_a = -1, joint_b = -1;  ///< of the tree; -1: the world
  Vec3 p_a = Vec3::Zero();         ///< [m] in the joint's frame
  Vec3 p_b = Vec3::Zero();
  double damping = 0;  ///< [N s/m]
};

}  // namespace saltus
