// Numbers of one slot of a placed tree.
#pragma once

#include "saltus/lagrangian/packed_point.hpp"

namespace saltus {

inline Mat3 rotation_of(const Packed& w, int slot) {
  Mat3 R;
  for (int c = 0; c < 3; ++c) R.col(c) = three(at(w.R, slot) + 3 * c * lanes);
  return R;
}

/// [m] From O.
inline Vec3 position_of(const Packed& w, int slot) { return three(at(w.p, slot)); }

/// A twist about O as that of the joint's origin, in the joint's frame: (turn, move).
inline Vec6 in_joint(const Mat3& R, const Vec3& p, const Vec6& twist) {
  return spatial(R.transpose() * angular(twist),
                 R.transpose() * (linear(twist) + angular(twist).cross(p)));
}

/// What a twist about O moves a point P by.
inline Vec3 velocity_at(const Vec6& twist, const Vec3& P) {
  return linear(twist) + angular(twist).cross(P);
}

}  // namespace saltus
