#include "saltus/model/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "saltus/error.hpp"

namespace saltus {
namespace {

constexpr double pi = std::numbers::pi;

bool fits(double x) { return x > 0 && std::isfinite(x); }

void check_solid(const char* kind, double mass, const std::vector<double>& sizes) {
  if (fits(mass) && std::all_of(sizes.begin(), sizes.end(), fits)) return;
  std::ostringstream text;
  text << "a solid " << kind << " of mass " << mass << " and size";
  for (const double size : sizes) text << " " << size;
  throw ModelError(text.str() + "; all are finite and positive");
}

BodyInertia about_centre(double mass, const Vec3& moments) {
  return {mass, Vec3::Zero(), moments.asDiagonal().toDenseMatrix()};
}

/// Integrals over a polytope, about a point inside it.
struct Moments {
  double volume = 0;           ///< of 1
  Vec3 first = Vec3::Zero();   ///< of x
  Mat3 second = Mat3::Zero();  ///< of x x'
};

/// By tetrahedra from the point to the triangles of the faces; all have positive volume, so that
/// nothing cancels.
Moments moments_about_center(const Hull& hull) {
  Moments sum;
  for (const Hull::Face& face : hull.faces) {
    const auto corner = [&](std::size_t i) {
      return Vec3(hull.vertices[face.corners[i]] - hull.center);
    };
    for (std::size_t i = 2; i < face.corners.size(); ++i) {
      const Vec3 a = corner(0), b = corner(i - 1), c = corner(i), s = a + b + c;
      const double V = a.dot(b.cross(c)) / 6;
      sum.volume += V;
      sum.first += V / 4 * s;
      sum.second +=
          V / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
  }
  return sum;
}

const Hull& hull_of(const Convex& convex) {
  if (convex.hull == nullptr) {
    throw ModelError("a convex solid without a hull; convex_hull(points) makes one");
  }
  return *convex.hull;
}

[[noreturn]] void refuse_half_space() {
  throw ModelError(
      "a half-space has no end, and so no volume and no inertia; add_floor and add_half_space fix "
      "one to the world");
}

struct Volume {
  double operator()(const Sphere& s) const { return 4 * pi / 3 * std::pow(s.radius, 3); }
  double operator()(const Capsule& c) const {
    return (*this)(Sphere{c.radius}) + (*this)(Cylinder{c.radius, c.half_length});
  }
  double operator()(const Box& b) const { return 8 * b.half.prod(); }
  double operator()(const Cylinder& c) const {
    return 2 * pi * c.radius * c.radius * c.half_length;
  }
  double operator()(const HalfSpace&) const { refuse_half_space(); }
  double operator()(const Ellipsoid& e) const { return 4 * pi / 3 * e.radii.prod(); }
  double operator()(const Convex& c) const { return moments_about_center(hull_of(c)).volume; }
};

struct SolidInertia {
  double mass;

  BodyInertia operator()(const Sphere& s) const { return solid_sphere(mass, s.radius); }
  BodyInertia operator()(const Box& b) const { return solid_box(mass, b.half); }
  BodyInertia operator()(const Cylinder& c) const {
    return solid_cylinder(mass, c.radius, c.half_length);
  }

  /// A cylinder, and a ball cut in halves that are moved to its ends. The centre of mass of half a
  /// ball is 3/8 r from its flat face.
  BodyInertia operator()(const Capsule& c) const {
    check_solid("capsule", mass, {c.radius});
    if (c.half_length == 0) return solid_sphere(mass, c.radius);
    check_solid("capsule", mass, {c.radius, c.half_length});
    const double r = c.radius, l = c.half_length;
    const double caps = mass / (1 + 1.5 * l / r), rod = mass - caps;  // volumes 4/3 r^3 to 2 r^2 l
    const double along = (rod / 2 + 0.4 * caps) * r * r;
    const double across =
        rod * (r * r / 4 + l * l / 3) + caps * (0.4 * r * r + l * l + 0.75 * l * r);
    return about_centre(mass, {across, across, along});
  }

  BodyInertia operator()(const HalfSpace&) const { refuse_half_space(); }

  BodyInertia operator()(const Ellipsoid& e) const {
    check_solid("ellipsoid", mass, {e.radii.x(), e.radii.y(), e.radii.z()});
    const Vec3 s = mass / 5 * e.radii.cwiseAbs2();
    return about_centre(mass, {s.y() + s.z(), s.x() + s.z(), s.x() + s.y()});
  }

  BodyInertia operator()(const Convex& c) const {
    const Hull& hull = hull_of(c);
    const Moments sum = moments_about_center(hull);
    check_solid("convex hull", mass, {sum.volume});
    const Vec3 off = sum.first / sum.volume;
    const Mat3 spread = mass * (sum.second / sum.volume - off * off.transpose());
    return {mass, hull.center + off, spread.trace() * Mat3::Identity() - spread};
  }
};

}  // namespace

BodyInertia solid_sphere(double mass, double radius) {
  check_solid("sphere", mass, {radius});
  return about_centre(mass, Vec3::Constant(0.4 * mass * radius * radius));
}

BodyInertia solid_box(double mass, const Vec3& half) {
  check_solid("box", mass, {half.x(), half.y(), half.z()});
  const Vec3 s = mass / 3 * half.cwiseAbs2();
  return about_centre(mass, {s.y() + s.z(), s.x() + s.z(), s.x() + s.y()});
}

BodyInertia solid_cylinder(double mass, double radius, double half_length) {
  check_solid("cylinder", mass, {radius, half_length});
  const double along = 0.5 * mass * radius * radius;
  const double across = along / 2 + mass / 3 * half_length * half_length;
  return about_centre(mass, {across, across, along});
}

BodyInertia solid_inertia(double mass, const Shape& shape) {
  return std::visit(SolidInertia{mass}, shape);
}

double volume(const Shape& shape) {
  if (!std::holds_alternative<HalfSpace>(shape)) solid_inertia(1, shape);  // refuses bad sizes
  return std::visit(Volume{}, shape);
}

}  // namespace saltus
