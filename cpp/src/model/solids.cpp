#include "saltus/model/solids.hpp"

#include <cmath>
#include <sstream>

#include "collision/shapes/facts.hpp"
#include "saltus/error.hpp"

namespace saltus {
namespace {

Homogeneous checked(double mass, const Shape& shape) {
  if (std::holds_alternative<HalfSpace>(shape)) {
    throw ModelError(
        "a half-space has no end, and so no volume and no inertia; add_floor and add_half_space "
        "fix one to the world");
  }
  const std::string what = flaw(shape);
  if (what.empty() && mass > 0 && std::isfinite(mass)) return homogeneous(shape, mass);
  std::ostringstream text;
  text << "a solid " << shape_name(shape) << " of mass " << mass
       << (what.empty() ? "; it is finite and positive" : ", " + what);
  throw ModelError(text.str());
}

}  // namespace

BodyInertia solid_sphere(double mass, double radius) { return solid_inertia(mass, Sphere{radius}); }

BodyInertia solid_box(double mass, const Vec3& half) { return solid_inertia(mass, Box{half}); }

BodyInertia solid_cylinder(double mass, double radius, double half_length) {
  return solid_inertia(mass, Cylinder{radius, half_length});
}

BodyInertia solid_inertia(double mass, const Shape& shape) {
  const Homogeneous solid = checked(mass, shape);
  return {mass, solid.center, solid.I};
}

double volume(const Shape& shape) { return checked(1, shape).volume; }

}  // namespace saltus
