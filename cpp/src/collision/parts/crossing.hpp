// Two edges that cross: the gap between their lines, and whether they face each other. An edge is
// a segment with a radius: that of a capsule, or of a cylinder without its rims.
#pragma once

#include "saltus/collision/gap.hpp"
#include "saltus/collision/pair.hpp"

namespace saltus {

/// False where it is beyond the ends of an edge b (its axis), by its witness.
bool is_within_ends(const Shape& edge, const Pose& X_WE, const Vec3& p_W);

/// True where n, which is across an edge, is from one of its faces' normals to the other's; `out_W`
/// as in Pair.
bool is_in_cone(const Vec3& n_W, const Vec3& out_W);

/// The signed distance of the two axes, less both radii, as if they had no ends; phi is infinite
/// where they are parallel. Needs a pair of two edges.
Gap crossing_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

/// [m] At most the distance of the two shapes of a crossing, at little cost: of the ball round a
/// cylinder from the other. Minus infinity where neither is one.
double distance_around_cylinder(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

/// False where the lines cross beyond the ends of an edge, or on the far side of a body.
bool is_crossing(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap);

}  // namespace saltus
