// Every bounded shape is a convex core and all points within a radius of it: a sphere's core is its
// centre, a capsule's its segment, that of any other shape the shape itself.
#pragma once

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// [m] 0 where the core is the shape.
double core_radius(const Shape& shape);

/// [m] radius of the ball about the shape's origin that holds the core; infinity for a half-space.
double core_extent(const Shape& shape);

/// The point of the core that is farthest along `direction` (any length), in the shape's frame; of
/// equally far ones always the same. Not for half-spaces.
Vec3 core_support(const Shape& shape, const Vec3& direction);

}  // namespace saltus
