// An ellipsoid's surface, q(x) = x/r^2 (componentwise) along its normal.
//
//   farthest along m: x = r^2 m/|r m|
//   n.x_ij = -(n.q) (t_i/r).(t_j/r)/|q|^2  for unit tangents t_i, from f = |x/r|^2 = 1 along curves
#pragma once

#include <cmath>

#include "saltus/collision/gap.hpp"

namespace saltus {

/// m: any length but 0.
inline Vec3 ellipsoid_support(const Ellipsoid& s, const Vec3& m) {
  const Vec3 w = s.radii.cwiseProduct(m);
  return s.radii.cwiseProduct(w) / w.norm();
}

/// Outward, not of unit length.
inline Vec3 ellipsoid_normal(const Ellipsoid& s, const Vec3& x) {
  return x.cwiseQuotient(s.radii).cwiseQuotient(s.radii);
}

/// At the point x of the surface, bends along n; in its frame.
inline Patch ellipsoid_patch(const Ellipsoid& s, const Vec3& x, const Vec3& n) {
  const Vec3 q = ellipsoid_normal(s, x);
  Patch out{.dim = 2, .t0 = q.unitOrthogonal(), .t1 = Vec3::Zero()};
  out.t1 = q.normalized().cross(out.t0);
  const Vec3 u = out.t0.cwiseQuotient(s.radii), v = out.t1.cwiseQuotient(s.radii);
  const double bend = -n.dot(q) / q.squaredNorm();
  out.k00 = bend * u.squaredNorm();
  out.k01 = bend * u.dot(v);
  out.k11 = bend * v.squaredNorm();
  return out;
}

}  // namespace saltus
