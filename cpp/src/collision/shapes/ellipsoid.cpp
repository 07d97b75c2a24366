// A smooth surface: q(x) = x/r^2 (componentwise) is along its normal, and x = r e, q = e/r for a
// point e of the unit sphere. A witness keeps that e: it tells the normal to rounding, however flat
// the ellipsoid.
//
//   farthest along m: x = r^2 m/|r m|
//   n.x_ij = -(n.q) (t_i/r).(t_j/r)/|q|^2  for unit tangents t_i, from f = |x/r|^2 = 1 along curves
#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

Patch patch_at(const Vec3& radii, const Vec3& q, const Vec3& n, const Vec3& t0, const Vec3& t1) {
  const Vec3 u = t0.cwiseQuotient(radii), v = t1.cwiseQuotient(radii);
  const double bend = -n.dot(q) / q.squaredNorm();
  return {.dim = 2,
          .t0 = t0,
          .t1 = t1,
          .k00 = bend * u.squaredNorm(),
          .k01 = bend * u.dot(v),
          .k11 = bend * v.squaredNorm()};
}

/// At the point x of the surface, in its frame.
Patch patch_at(const Ellipsoid& s, const Vec3& x, const Vec3& n) {
  const Vec3 q = x.cwiseQuotient(s.radii).cwiseQuotient(s.radii), t0 = q.unitOrthogonal();
  return patch_at(s.radii, q, n, t0, q.normalized().cross(t0));
}

/// The witness at the point e of the unit sphere, of any length here.
void put(const Ellipsoid& shape, const Solid& s, const Vec3& e, Feature& f) {
  f.center = e.normalized();
  f.x = s.p + s.R * shape.radii.cwiseProduct(f.center);
  const Vec3 normal = s.R * f.center.cwiseQuotient(shape.radii).normalized();
  f.t0 = normal.unitOrthogonal();
  f.t1 = normal.cross(f.t0);
}

/// Where it is farthest along d, in its frame.
Feature surface_along(const Ellipsoid& e, const Solid& s, const Vec3& d) {
  Feature f = vertex_at(s.p);
  f.kind = Feature::Kind::surface;
  put(e, s, e.radii.cwiseProduct(d), f);
  return f;
}

/// The root of g, see distance_of. `from` is on its left.
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

}  // namespace

double ball_of(const Ellipsoid& s) { return s.radii.maxCoeff(); }
double size_of(const Ellipsoid& s) { return s.radii.minCoeff(); }
std::string flaw_of(const Ellipsoid& s) { return flaw_of_size(s.radii); }

Homogeneous homogeneous_of(const Ellipsoid& e, double mass) {
  const Vec3 s = mass / 5 * e.radii.cwiseAbs2();
  return {4 * std::numbers::pi / 3 * e.radii.prod(), Vec3::Zero(),
          Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()).asDiagonal()};
}

Core core_of(const Ellipsoid& s) { return {.length = s.radii.norm(), .curved = true}; }

Vec3 farthest_of(const Ellipsoid& s, const Vec3& d) {
  const Vec3 w = s.radii.cwiseProduct(d);
  const double length = w.norm();
  if (length < no_length) return {s.radii.x(), 0, 0};
  return s.radii.cwiseProduct(w) / length;
}

void nearby_of(const Ellipsoid& e, const Solid& s, const Vec3& d, double, Nearby& out) {
  out.add(surface_along(e, s, d));
}

void flat_of(const Ellipsoid& e, const Solid& s, const Vec3& d, double, Flat& out) {
  out.point = Feature::Kind::surface;
  out.corners = 1;
  out.corner[0] = s.p + s.R * farthest_of(e, d);
}

Feature surface_of(const Ellipsoid& e, const Solid& s, const Vec3& m) {
  return surface_along(e, s, s.R.transpose() * m);
}

void slide_on(const Ellipsoid& e, const Solid& s, const Vec3& step_W, Feature& f) {
  put(e, s, f.center + (s.R.transpose() * step_W).cwiseQuotient(e.radii), f);
}

Patch patch_on(const Ellipsoid& e, const Solid& s, const Feature& f, const Vec3& n) {
  Patch out = patch_at(e.radii, f.center.cwiseQuotient(e.radii), s.R.transpose() * n,
                       s.R.transpose() * f.t0, s.R.transpose() * f.t1);
  out.t0 = f.t0;
  out.t1 = f.t1;
  return out;
}

/// From the surface: nearest point x, outward q = x/r^2.
///
/// Reference: D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid
/// (2013); here with the least radius taken off, which keeps digits by the medial plane.
///
///   c - x = T q   =>   x_i = r_i^2 c_i/(T + r_i^2),   d = T |q|
///   s = T + r_m^2 >= 0,  r_m the least radius,  D_i = r_i^2 - r_m^2
///   g(s) = sum (r_i c_i/(s + D_i))^2 - 1 = 0
///
/// g falls and is convex: Newton from the left of the root climbs to it without overstepping. Where
/// c lies on the plane across the least axis, between the evolute's cusps, s = 0 and x leaves that
/// plane. Of equally near points that on the + side of the first of the shortest axes counts.
PointDistance distance_of(const Ellipsoid& b, const Vec3& c) {
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
  const Vec3 q = x.cwiseQuotient(b.radii).cwiseQuotient(b.radii), n = q.normalized();
  return {(s - r_m * r_m) * q.norm(), n, patch_at(b, x, n)};
}

Lowest lowest_of(const Ellipsoid& s, const Vec3& m) {
  const Vec3 x = farthest_of(s, m);
  return {x, patch_at(s, x, -m)};
}

}  // namespace saltus
