// From a shape's frame to the world; what every pair with a sphere comes down to.
#pragma once

#include "collision/shapes/point_distance.hpp"
#include "saltus/collision/gap.hpp"

namespace saltus {

/// A point of the world in the coordinates of frame B; subtracts before it turns, so that nothing
/// is lost far from the origin.
inline Vec3 in_frame(const Pose& X_WB, const Vec3& p_W) {
  return X_WB.R.transpose() * (p_W - X_WB.p);
}

inline Patch in_world(const Mat3& R_WB, const Patch& patch) {
  if (patch.dim == 0) return {};
  Patch out = patch;
  out.t0 = R_WB * patch.t0;
  if (patch.dim == 2) out.t1 = R_WB * patch.t1;
  return out;
}

/// phi = d(c) - r_a,   n = grad d,   p_A = c - r_a n,   p_B = c - d n        c: the sphere's centre
inline Gap sphere_gap(const Sphere& a, const Pose& X_WA, const Pose& X_WB, const PointDistance& x) {
  const Vec3 n_W = X_WB.R * x.n;
  return {.phi = x.d - a.radius,
          .n_W = n_W,
          .p_WA = X_WA.p - a.radius * n_W,
          .p_WB = X_WA.p - x.d * n_W,
          .center_W = X_WA.p,
          .d = x.d + x.radius,
          .a = {},
          .b = in_world(X_WB.R, x.patch)};
}

}  // namespace saltus
