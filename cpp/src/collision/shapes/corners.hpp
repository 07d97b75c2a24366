// The corners and edges of a shape, by number, with names.
#pragma once

#include <string>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// A part of a shape, in the shape's frame.
struct PartOfShape {
  std::string name;  ///< "" for all of it
  Shape shape;
  Pose X_GP;                 ///< its frame
  Vec3 out = Vec3::Zero();   ///< of an edge or a rim: as in Pair
  std::vector<Vec3> inward;  ///< of a corner: along the edges that meet in it
};

/// Box 8, capsule 2, convex as many as it has vertices, cylinder 8; the others have none.
int corner_count(const Shape& shape);
PartOfShape corner(const Shape& shape, int k);

/// Box 12, capsule 1 and cylinder 1: its axis, convex as many as it has; the others have none.
int edge_count(const Shape& shape);
/// Along its z axis: a capsule, of radius 0 for an edge of flat faces, or the cylinder itself.
PartOfShape edge(const Shape& shape, int k);

/// Cylinder 2; the others have none.
int rim_count(const Shape& shape);
/// As a disc.
PartOfShape rim(const Shape& shape, int k);

}  // namespace saltus
