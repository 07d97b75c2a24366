#include "collision/gap/core.hpp"

#include <cassert>
#include <cmath>

#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

Vec3 farthest(const Sphere&, const Vec3&) { return Vec3::Zero(); }
Vec3 farthest(const Capsule& s, const Vec3& d) { return {0, 0, side(d.z()) * s.half_length}; }
Vec3 farthest(const Box& s, const Vec3& d) {
  return {side(d.x()) * s.half.x(), side(d.y()) * s.half.y(), side(d.z()) * s.half.z()};
}
Vec3 farthest(const Cylinder& s, const Vec3& d) {
  const double rho = std::hypot(d.x(), d.y()), z = side(d.z()) * s.half_length;
  if (rho < no_length) return {s.radius, 0, z};
  return {s.radius * d.x() / rho, s.radius * d.y() / rho, z};
}
Vec3 farthest(const HalfSpace&, const Vec3&) {
  assert(!"core_support of a half-space");
  return Vec3::Zero();
}
Vec3 farthest(const Ellipsoid& s, const Vec3& d) {
  const Vec3 w = s.radii.cwiseProduct(d);
  const double length = w.norm();
  if (length < no_length) return {s.radii.x(), 0, 0};
  return s.radii.cwiseProduct(w) / length;
}
Vec3 farthest(const Convex& s, const Vec3& d) {
  const std::vector<Vec3>& v = s.hull->vertices;
  std::size_t best = 0;
  for (std::size_t k = 1; k < v.size(); ++k) {
    if (v[k].dot(d) > v[best].dot(d)) best = k;
  }
  return v[best];
}

}  // namespace

double core_radius(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
  return 0;
}

double core_extent(const Shape& shape) {
  if (std::holds_alternative<Sphere>(shape)) return 0;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->half_length;
  return bounding_radius(shape);
}

Vec3 core_support(const Shape& shape, const Vec3& direction) {
  return std::visit([&](const auto& s) { return farthest(s, direction); }, shape);
}

}  // namespace saltus
