// A sphere's centre c from an ellipsoid's surface, nearest point x, outward q = x/r^2.
//
// Reference: D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid
// (2013); here with the least radius taken off, which keeps digits by the medial plane.
//
//   c - x = T q   =>   x_i = r_i^2 c_i/(T + r_i^2),   d = T |q|
//   s = T + r_m^2 >= 0,  r_m the least radius,  D_i = r_i^2 - r_m^2
//   g(s) = sum (r_i c_i/(s + D_i))^2 - 1 = 0
//
// g falls and is convex: Newton from the left of the root climbs to it without overstepping. Where
// c lies on the plane across the least axis, between the evolute's cusps, s = 0 and x leaves that
// plane.
#include "collision/pairs/sphere_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

#include "collision/gap/ellipsoid_patch.hpp"
#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

/// The root of g. `from` is on its left.
double multiplier(const Vec3& rc, const Vec3& D, double from) {
  double s = from;
  for (int k = 0; k < 60; ++k) {
    double g = -1, slope = 0;
    for (int i = 0; i < 3; ++i) {
      if (rc[i] == 0) continue;  // 0/0 otherwise
      const double q = rc[i] / (s + D[i]);
      g += q * q;
      slope += 2 * q * q / (s + D[i]);
    }
    const double next = s + g / slope;
    if (!(next > s)) break;  // also ends on the noise at the root
    s = next;
  }
  return s;
}

PointDistance distance_from_ellipsoid(const Vec3& c, const Ellipsoid& b) {
  int m = 0;
  const double r_m = b.radii.minCoeff(&m);
  Vec3 D, rc = b.radii.cwiseProduct(c);
  for (int i = 0; i < 3; ++i) D[i] = (b.radii[i] - r_m) * (b.radii[i] + r_m);
  double off_plane = 0, on_plane = 0;  // does any shortest axis tell a side; g + 1 of the others
  for (int i = 0; i < 3; ++i) {
    if (std::abs(rc[i]) < no_length) rc[i] = 0;
    if (D[i] > 0) on_plane += std::pow(rc[i] / D[i], 2);
    if (D[i] <= 0) off_plane = std::max(off_plane, std::abs(rc[i]));
  }
  Vec3 x;
  double s = 0;
  if (off_plane == 0 && on_plane <= 1) {
    for (int i = 0; i < 3; ++i) x[i] = D[i] > 0 ? b.radii[i] * rc[i] / D[i] : 0;
    x[m] = r_m * std::sqrt(1 - on_plane);
  } else {
    // each term of g alone is 1 at r_i |c_i| - D_i
    s = multiplier(rc, D, (rc.cwiseAbs() - D).cwiseMax(0).maxCoeff());
    for (int i = 0; i < 3; ++i) x[i] = rc[i] == 0 ? 0 : b.radii[i] * (rc[i] / (s + D[i]));
  }
  const Vec3 q = ellipsoid_normal(b, x), n = q.normalized();
  return {(s - r_m * r_m) * q.norm(), n, ellipsoid_patch(b, x, n)};
}

}  // namespace

Gap gap_between(const Sphere& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, distance_from_ellipsoid(in_frame(X_WB, X_WA.p), b));
}

}  // namespace saltus
