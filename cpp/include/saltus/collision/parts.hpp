// Shapes that touch in more than a point have several gaps: one for each part that can bear load.
//
// A signed distance has one normal; a box on a floor has four corners that bear it. So two shapes
// that can lie flat on one another are watched by their parts, each with a gap of its own and with
// a name that stays the same from step to step:
//
//   corners   of a box, ends of a capsule, vertices of a convex solid, four points on each rim of a
//             cylinder, against the other shape (theory, section 7: a sphere of radius 0)
//   edges     of boxes and convex solids, axes of capsules and cylinders, where they cross
//   over      an edge and the rims of a cylinder that lies flat on it: where it goes in below the
//             cap, and where it comes out; two rims: left and right
//   rims      of a cylinder, as discs, against the other shape: each at its nearest point
//   whole     the signed distance of the two, in place of edges where there are too many of them;
//             silent where a corner or a rim is nearest
//
// The smallest of them is the signed distance, where that is near 0.
#pragma once

#include <string>

#include "saltus/collision/gap.hpp"
#include "saltus/collision/pair.hpp"

namespace saltus {

/// How many gaps two shapes have; 0 where there is none (two half-spaces). The order does not
/// matter.
SALTUS_EXPORT int part_count(const Shape& a, const Shape& b);

/// The gap number `part` in [0, part_count) of two shapes. A half-space becomes b, and a corner or
/// sphere a: then `a` and `b` are exchanged in the result.
SALTUS_EXPORT Pair make_pair(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b,
                             int part);

/// The two shapes as wholes: one gap, the signed distance, whatever their parts.
SALTUS_EXPORT Pair make_solid_pair(const Tree& tree, const std::vector<PlacedShape>& shapes, int a,
                                   int b);

/// "block[+-+] ~ floor": the shapes' names, with what part of them it is.
SALTUS_EXPORT std::string pair_name(const std::vector<PlacedShape>& shapes, const Pair& pair);

/// The gap of a pair from the poses of its parts. That of a part which does not face the other goes
/// on smoothly, and means nothing there: is_silent tells. phi is infinite between parallel edges.
SALTUS_EXPORT Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

/// The same where a moves by `motion_W` against b: it decides where a corner is on several faces at
/// once, of which it leaves one fastest. phi is the greatest of their heights, and grows as that.
SALTUS_EXPORT Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB,
                           const Vec3& motion_W);

/// True where the part does not face the other: edges that do not cross, a whole or a rim whose
/// nearest point has a gap of its own, the rim of a cylinder that stands.
SALTUS_EXPORT bool is_silent(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap);

}  // namespace saltus
