// The signed distance d(c) of a point c from a convex solid, to second order: what every pair with
// a sphere comes down to.
//
// n = grad d, and the feature that is nearest, whose patch gives F = d2 d (curvature.cpp).
// Reference: theory, section 7, "by feature". d < 0 inside, where it belongs to the nearest face.
// All solids here are convex, so d is a convex function of c everywhere, inside too; the certified
// advance (chord.cpp) rests on that. F jumps where the nearest feature changes; there, it is that
// of one of the two.
#pragma once

#include "saltus/collision/shapes.hpp"

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

/// Distance from a corner, or from a point that a shape of this radius is swept about; `v` is the
/// vector from it. On the point itself: n = fallback, F = 0.
inline PointDistance distance_from_point(const Vec3& v, const Vec3& fallback, double radius = 0) {
  const double d = v.norm();
  if (d < no_length) return {0 - radius, fallback, {}, radius};
  return {d - radius, v / d, {}, radius};
}

/// Distance from a straight line along axis `t` of the frame; component t of `v` is ignored.
/// On the line itself: n = fallback, F = 0.
inline PointDistance distance_from_line(Vec3 v, int t, const Vec3& fallback, double radius = 0) {
  v[t] = 0;
  PointDistance out = distance_from_point(v, fallback, radius);
  if (v.norm() >= no_length) out.patch = {.dim = 1, .t0 = Vec3::Unit(t), .t1 = Vec3::Zero()};
  return out;
}

/// Which side of 0 a coordinate is on; 0 counts as the + side.
inline double side(double x) { return x < 0 ? -1 : 1; }

}  // namespace saltus
