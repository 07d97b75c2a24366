// What links look like: for pictures; it has no part in the motion.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// A surface.
struct Triangles {
  std::vector<Vec3> vertices;             ///< [m]
  std::vector<std::array<int, 3>> faces;  ///< vertices, counterclockwise seen from outside
};

/// A surface of triangles, shared between copies; never null in a model.
struct TriangleMesh {
  static constexpr const char* name = "mesh";  ///< visual_kind
  std::shared_ptr<const Triangles> triangles;  ///< the surface
};

using Rgba = std::array<double, 4>;  ///< red, green, blue, opacity, each in [0, 1]

/// What a link looks like, or a part of it.
struct Visual {
  static constexpr Rgba grey = {0.7, 0.7, 0.7, 1};  ///< where a file names no colour

  std::string link;                         ///< that carries it
  std::variant<Shape, TriangleMesh> shape;  ///< its form and sizes
  Pose X_LG = {};                           ///< its frame in the link's
  Rgba rgba = grey;                         ///< its colour
  std::string name = {};                    ///< as the file has it; "" where it has none
};

/// "box", "mesh": the name of the shape that it is.
SALTUS_EXPORT std::string visual_kind(const Visual& visual);

/// @throws ModelError on a half-space, which has no end, sizes that no shape has, a mesh whose
/// faces name vertices that are not there or whose vertices are not finite, and numbers that are no
/// colour.
SALTUS_EXPORT void check_visual(const Visual& visual);

}  // namespace saltus
