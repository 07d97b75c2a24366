// Two placed shapes and their gap, with surfaces and supports written down anew.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision/random_scene.hpp"

namespace saltus::testing_scene {

constexpr double eps = 2.3e-16;

// Signed functions that vanish on a shape's surface and are negative inside: no distances off the
// surface, but of its order near it.
inline double outside(const Sphere& s, const Vec3& p) { return p.norm() - s.radius; }
inline double outside(const HalfSpace&, const Vec3& p) { return p.z(); }
inline double outside(const Box& s, const Vec3& p) { return (p.cwiseAbs() - s.half).maxCoeff(); }
inline double outside(const Cylinder& s, const Vec3& p) {
  return std::max(std::hypot(p.x(), p.y()) - s.radius, std::abs(p.z()) - s.half_length);
}
inline double outside(const Capsule& s, const Vec3& p) {
  const double along = std::min(std::max(p.z(), -s.half_length), s.half_length);
  return (p - along * Vec3::UnitZ()).norm() - s.radius;
}
inline double outside(const Ellipsoid& s, const Vec3& p) {
  const Vec3 x = p.cwiseQuotient(s.radii);
  return (x.norm() - 1) / x.cwiseQuotient(s.radii).norm();
}
inline double outside(const Convex& s, const Vec3& p) {
  double out = -1e300;
  for (const Hull::Face& f : s.hull->faces) out = std::max(out, f.normal.dot(p) - f.offset);
  return out;
}
inline double outside(const Shape& shape, const Vec3& p) {
  return std::visit([&](const auto& s) { return outside(s, p); }, shape);
}

// The greatest m.x of a shape, m a unit vector.
inline double reach(const Sphere& s, const Vec3&) { return s.radius; }
inline double reach(const Capsule& s, const Vec3& m) {
  return s.radius + s.half_length * std::abs(m.z());
}
inline double reach(const Box& s, const Vec3& m) { return s.half.dot(m.cwiseAbs()); }
inline double reach(const Cylinder& s, const Vec3& m) {
  return s.radius * std::hypot(m.x(), m.y()) + s.half_length * std::abs(m.z());
}
inline double reach(const HalfSpace&, const Vec3& m) {
  return (m - Vec3::UnitZ()).norm() < 8 * eps ? 0 : 1e300;
}
inline double reach(const Ellipsoid& s, const Vec3& m) { return s.radii.cwiseProduct(m).norm(); }
inline double reach(const Convex& s, const Vec3& m) {
  double out = -1e300;
  for (const Vec3& v : s.hull->vertices) out = std::max(out, m.dot(v));
  return out;
}
inline double reach(const Shape& shape, const Vec3& m) {
  return std::visit([&](const auto& s) { return reach(s, m); }, shape);
}

struct Placed {
  Shape a, b;
  Pose X_WA, X_WB;

  Gap gap() const { return saltus::gap(a, X_WA, b, X_WB); }
  Placed moved_by(const Vec3& step) const { return {a, b, {X_WA.R, X_WA.p + step}, X_WB}; }
  /// [m] what positions are rounded to, over eps
  double scale() const { return 1 + X_WA.p.norm() + X_WB.p.norm(); }
  /// How far apart the shapes are along the unit n.
  double separation(const Vec3& n) const {
    return n.dot(X_WA.p - X_WB.p) - reach(a, -(X_WA.R.transpose() * n)) -
           reach(b, X_WB.R.transpose() * n);
  }
};

/// a near b's surface, inside b, or far off; now and then all is far from the world's origin.
inline Placed random_placed(const std::pair<std::string, std::string>& names, Random& random) {
  Placed x{random_shape(names.first, random),
           random_shape(names.second, random),
           {},
           random.pose(random.chance(0.1) ? 1000 : 1)};
  x.X_WA = {random.rotation(), x.X_WB.p + random.vector(random.chance(0.2) ? 10 : 1)};
  return x;
}

}  // namespace saltus::testing_scene
