// Volume and inertia of homogeneous solids: what a body weighs, by its shape.
#pragma once

#include "saltus/collision/shapes.hpp"
#include "saltus/lagrangian/mass_model.hpp"

namespace saltus {

/// Inertia of a homogeneous ball about its centre, a frequent need.
/// @throws ModelError where the mass or a size is not finite and positive; so the other solids.
SALTUS_EXPORT BodyInertia solid_sphere(double mass, double radius);
/// The same of a box and of a cylinder along z, by the sizes of their shapes.
SALTUS_EXPORT BodyInertia solid_box(double mass, const Vec3& half);
/// The same of a cylinder along z.
SALTUS_EXPORT BodyInertia solid_cylinder(double mass, double radius, double half_length);

/// Of any shape, in its own frame. The centre of mass of a convex hull need not be the origin.
/// @throws ModelError on a half-space, which has no end, and on sizes that no shape has.
SALTUS_EXPORT BodyInertia solid_inertia(double mass, const Shape& shape);

/// [m^3] @throws as solid_inertia.
SALTUS_EXPORT double volume(const Shape& shape);

}  // namespace saltus
