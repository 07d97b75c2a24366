#include "saltus/collision/shapes.hpp"

#include <cmath>
#include <limits>

namespace saltus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A new shape is one line in each of these three.
std::string name_of(const Sphere&) { return "sphere"; }
std::string name_of(const Capsule&) { return "capsule"; }
std::string name_of(const Box&) { return "box"; }
std::string name_of(const Cylinder&) { return "cylinder"; }
std::string name_of(const HalfSpace&) { return "half_space"; }
std::string name_of(const Ellipsoid&) { return "ellipsoid"; }
std::string name_of(const Convex&) { return "convex"; }

double ball_of(const Sphere& s) { return s.radius; }
double ball_of(const Capsule& s) { return s.half_length + s.radius; }
double ball_of(const Box& s) { return s.half.norm(); }
double ball_of(const Cylinder& s) { return std::hypot(s.radius, s.half_length); }
double ball_of(const HalfSpace&) { return infinity; }
double ball_of(const Ellipsoid& s) { return s.radii.maxCoeff(); }
double ball_of(const Convex& s) {
  double square = 0;
  for (const Vec3& v : s.hull->vertices) square = std::fmax(square, v.squaredNorm());
  return std::sqrt(square);
}

double size_of(const Sphere& s) { return s.radius; }
double size_of(const Capsule& s) { return s.radius; }
double size_of(const Box& s) { return s.half.minCoeff(); }
double size_of(const Cylinder& s) { return std::fmin(s.radius, s.half_length); }
double size_of(const HalfSpace&) { return infinity; }
double size_of(const Ellipsoid& s) { return s.radii.minCoeff(); }
double size_of(const Convex& s) {  // the least distance from the middle to a face
  double size = infinity;
  for (const Hull::Face& f : s.hull->faces) {
    size = std::fmin(size, f.offset - f.normal.dot(s.hull->center));
  }
  return size;
}

}  // namespace

std::string shape_name(const Shape& shape) {
  return std::visit([](const auto& s) { return name_of(s); }, shape);
}

double bounding_radius(const Shape& shape) {
  return std::visit([](const auto& s) { return ball_of(s); }, shape);
}

double feature_size(const Shape& shape) {
  return std::visit([](const auto& s) { return size_of(s); }, shape);
}

}  // namespace saltus
