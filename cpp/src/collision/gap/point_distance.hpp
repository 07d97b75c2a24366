// What every pair with a sphere comes down to: the signed distance of the sphere's centre c from
// a convex solid.
//
//   phi = d(c) - r_a,   n = grad d,   p_A = c - r_a n,   p_B = c - d n
//
// and the feature of the solid that is nearest, whose patch gives F = d2 d (curvature.cpp).
// Reference: theory, section 7, "by feature". d < 0 inside, where it belongs to the nearest face.
// All solids here are convex, so d is a convex function of c everywhere, inside too; the certified
// advance (chord.cpp) rests on that. F jumps where the nearest feature changes; there, it is that
// of one of the two.
#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// In the solid's frame.
struct PointDistance {
  double d;           ///< [m] from the surface, negative inside
  Vec3 n;             ///< unit normal, away from the solid
  Patch patch;        ///< of the solid's core
  double radius = 0;  ///< [m] of the solid round its core; d has it taken off
};

/// A flat face across axis k.
inline Patch face_across(int k) {
  return {.dim = 2, .t0 = Vec3::Unit((k + 1) % 3), .t1 = Vec3::Unit((k + 2) % 3)};
}

/// [m] The square of a shorter vector has lost its digits: a point this close to a feature lies
/// on it, and has no direction of its own.
inline constexpr double no_length = 1e-140;

/// Distance from a corner, or from a point that a round shape is swept about; `v` is the vector
/// from it. On the point itself: n = fallback, F = 0.
inline PointDistance distance_from_point(const Vec3& v, const Vec3& fallback) {
  const double d = v.norm();
  if (d < no_length) return {0, fallback, {}};
  return {d, v / d, {}};
}

/// Distance from a straight line along axis `t` of the frame; component t of `v` is ignored.
/// On the line itself: n = fallback, F = 0.
inline PointDistance distance_from_line(Vec3 v, int t, const Vec3& fallback) {
  v[t] = 0;
  PointDistance out = distance_from_point(v, fallback);
  if (out.d > 0) out.patch = {.dim = 1, .t0 = Vec3::Unit(t), .t1 = Vec3::Zero()};
  return out;
}

/// Which side of 0 a coordinate is on; 0 counts as the + side.
inline double side(double x) { return x < 0 ? -1 : 1; }

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

/// The gap of a sphere from its centre's distance to the solid b.
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
