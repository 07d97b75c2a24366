// The shapes that can touch. Each is given in its own frame; sizes in metres.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "saltus/collision/hull.hpp"

namespace saltus {

/// All points within `radius` of the origin.
struct Sphere {
  static constexpr const char* name = "sphere";  ///< shape_name
  double radius;                                 ///< [m]
};
/// All points within `radius` of the segment z in [-half_length, half_length].
struct Capsule {
  static constexpr const char* name = "capsule";  ///< shape_name
  double radius;                                  ///< [m]
  double half_length;                             ///< [m]
};
/// |x| <= half.x, |y| <= half.y, |z| <= half.z.
struct Box {
  static constexpr const char* name = "box";  ///< shape_name
  Vec3 half;                                  ///< [m]
};
/// Axis z, |z| <= half_length.
struct Cylinder {
  static constexpr const char* name = "cylinder";  ///< shape_name
  double radius;                                   ///< [m]
  double half_length;                              ///< [m]
};
/// The solid z <= 0; its normal is the frame's z axis. Fixed to the world.
struct HalfSpace {
  static constexpr const char* name = "half_space";  ///< shape_name
};

/// (x/radii.x)^2 + (y/radii.y)^2 + (z/radii.z)^2 <= 1.
struct Ellipsoid {
  static constexpr const char* name = "ellipsoid";  ///< shape_name
  Vec3 radii;                                       ///< [m]
};
/// Shared between copies; never null in a model.
struct Convex {
  static constexpr const char* name = "convex";  ///< shape_name
  std::shared_ptr<const Hull> hull;              ///< its corners, faces and edges
};

/// Any of them.
using Shape = std::variant<Sphere, Capsule, Box, Cylinder, HalfSpace, Ellipsoid, Convex>;

/// "half_space": the name of the one that it is.
SALTUS_EXPORT std::string shape_name(const Shape& shape);

/// [m] radius of the ball about the shape's origin that holds it; infinity for a half-space.
SALTUS_EXPORT double bounding_radius(const Shape& shape);

/// [m] a length typical of the shape, for tolerances: its smallest half-extent; infinity for a
/// half-space.
SALTUS_EXPORT double feature_size(const Shape& shape);

/// Where the witness of a shape can move, to second order: the feature of the shape's core (the
/// point or segment that a round shape is swept about, the whole of another) that is nearest.
struct Patch {
  int dim = 0;  ///< 0 a point (corner, centre, end), 1 a curve (edge, axis, rim), 2 a surface
  Vec3 t0 = Vec3::Zero();  ///< the first `dim` valid: unit tangents, orthogonal, across n; in the
  Vec3 t1 = Vec3::Zero();  ///< world
  double k00 = 0;          ///< [1/m] n.x_00, n.x_01, n.x_11 of the core x along t0 and t1:
  double k01 = 0;          ///< not below 0 on a, not above 0 on b (both are convex)
  double k11 = 0;          ///< likewise
};

}  // namespace saltus
