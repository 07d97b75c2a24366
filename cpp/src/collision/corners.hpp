// The corners and edges of a shape, by number, with names.
#pragma once

#include <string>

#include "saltus/collision/contact.hpp"

namespace saltus {

/// A part of a shape, in the shape's frame.
struct PartOfShape {
  std::string name;  ///< "" for all of it
  Shape shape;
  Pose X_GP;                 ///< its frame
  Vec3 out = Vec3::Zero();   ///< of an edge of a solid: out of the shape, in the part's frame
  std::vector<Vec3> inward;  ///< of a corner: along the edges that meet in it
};

/// Box 8, capsule 2, convex as many as it has vertices, cylinder 8; the others have none.
int corner_count(const Shape& shape);
PartOfShape corner(const Shape& shape, int k);

/// Box 12, capsule 1; those of the others are not listed.
int edge_count(const Shape& shape);
/// A capsule along its z axis: of radius 0 for a box's edge.
PartOfShape edge(const Shape& shape, int k);

/// The two rims of a cylinder, as discs.
PartOfShape rim(const Cylinder& shape, int k);

}  // namespace saltus
