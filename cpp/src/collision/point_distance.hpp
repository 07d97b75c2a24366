// What every pair with a sphere comes down to: the signed distance of the sphere's centre c from
// a convex solid.
//
//   phi = d(c) - r_a,   n = grad d,   F = d2 d,   p_A = c - r_a n,   p_B = c - d n
//
// Reference: theory, section 7, "by feature". d < 0 inside, where it belongs to the nearest face.
// All solids here are convex, so d is a convex function of c everywhere, inside too; the certified
// advance (chord.cpp) rests on that. F jumps where the nearest feature changes; there, it is that
// of one of the two.
#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// In the solid's frame.
struct PointDistance {
  double d;               ///< [m] from the surface, negative inside
  Vec3 n;                 ///< unit normal, away from the solid
  Mat3 F = Mat3::Zero();  ///< [1/m] second derivative of d; 0 where it is infinite
};

/// [m] The square of a shorter vector has lost its digits: a point this close to a feature lies
/// on it, and has no direction of its own.
inline constexpr double no_length = 1e-140;

/// Distance from a corner, or from a point that a round shape is swept about; `v` is the vector
/// from it. On the point itself: n = fallback, F = 0.
inline PointDistance distance_from_point(const Vec3& v, const Vec3& fallback) {
  const double d = v.norm();
  if (d < no_length) return {0, fallback};
  const Vec3 n = v / d;
  return {d, n, (Mat3::Identity() - n * n.transpose()) / d};
}

/// Distance from a straight line along axis `t` of the frame; component t of `v` is ignored.
/// On the line itself: n = fallback, F = 0.
inline PointDistance distance_from_line(Vec3 v, int t, const Vec3& fallback) {
  v[t] = 0;
  PointDistance out = distance_from_point(v, fallback);
  if (out.d > 0) out.F(t, t) = 0;  // (I - t t^T - n n^T) / d: no curvature along the line
  return out;
}

/// Which side of 0 a coordinate is on; 0 counts as the + side.
inline double side(double x) { return x < 0 ? -1 : 1; }

/// A point of the world in the coordinates of frame B; subtracts before it turns, so that nothing
/// is lost far from the origin.
inline Vec3 in_frame(const Pose& X_WB, const Vec3& p_W) {
  return X_WB.R.transpose() * (p_W - X_WB.p);
}

/// The gap of a sphere from its centre's distance to the solid b.
inline Gap sphere_gap(const Sphere& a, const Pose& X_WA, const Pose& X_WB,
                      const PointDistance& distance_B) {
  const Vec3 n_W = X_WB.R * distance_B.n;
  return {.phi = distance_B.d - a.radius,
          .n_W = n_W,
          .p_WA = X_WA.p - a.radius * n_W,
          .p_WB = X_WA.p - distance_B.d * n_W,
          .center_W = X_WA.p,
          .F_W = X_WB.R * distance_B.F * X_WB.R.transpose()};
}

}  // namespace saltus
