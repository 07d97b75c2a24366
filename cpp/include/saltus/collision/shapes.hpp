// The shapes that can touch. Each is given in its own frame; sizes in metres.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "saltus/collision/hull.hpp"

namespace saltus {

struct Sphere {
  double radius;
};
/// All points within `radius` of the segment z in [-half_length, half_length].
struct Capsule {
  double radius, half_length;
};
/// |x| <= half.x, |y| <= half.y, |z| <= half.z.
struct Box {
  Vec3 half;
};
/// Axis z, |z| <= half_length.
struct Cylinder {
  double radius, half_length;
};
/// The solid z <= 0; its normal is the frame's z axis. Fixed to the world.
struct HalfSpace {};

/// (x/radii.x)^2 + (y/radii.y)^2 + (z/radii.z)^2 <= 1.
struct Ellipsoid {
  Vec3 radii;
};
/// Shared between copies; never null in a model.
struct Convex {
  std::shared_ptr<const Hull> hull;
};

using Shape = std::variant<Sphere, Capsule, Box, Cylinder, HalfSpace, Ellipsoid, Convex>;

/// "sphere", "capsule", "box", "cylinder", "half_space", "ellipsoid", "convex".
SALTUS_EXPORT std::string shape_name(const Shape& shape);

/// [m] radius of the ball about the shape's origin that holds it; infinity for a half-space.
SALTUS_EXPORT double bounding_radius(const Shape& shape);

/// [m] a length typical of the shape, for tolerances: its smallest half-extent; infinity for a
/// half-space.
SALTUS_EXPORT double feature_size(const Shape& shape);

}  // namespace saltus
