#include <cmath>
#include <numbers>

#include "collision/shapes/facts.hpp"

namespace saltus {

double ball_of(const Sphere& s) { return s.radius; }
double size_of(const Sphere& s) { return s.radius; }
std::string flaw_of(const Sphere& s) { return flaw_of_size(Vec3::Constant(s.radius)); }

Homogeneous homogeneous_of(const Sphere& s, double mass) {
  const double r = s.radius;
  const Vec3 moments = Vec3::Constant(0.4 * mass * r * r);
  return {4 * std::numbers::pi / 3 * std::pow(r, 3), Vec3::Zero(), moments.asDiagonal()};
}

Core core_of(const Sphere& s) { return {.radius = s.radius}; }

Vec3 brick_of(const Sphere&) { return Vec3::Zero(); }

/// Where the centres coincide, n is the z axis and F = 0.
PointDistance distance_of(const Sphere& s, const Vec3& c) {
  return distance_from_point(c, Vec3::UnitZ(), s.radius);
}

}  // namespace saltus
