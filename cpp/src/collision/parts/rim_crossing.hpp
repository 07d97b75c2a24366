// Edges that cross the rims of a cylinder, and rims that cross rims, where a cap lies flat.
//
// A can that stands on a table, in part beyond its border, is held where the border goes in below
// its cap and where it comes out. These are watched while the edge is within `flat` of the cap's
// plane; beyond, one place alone is nearest, and the rim as a whole has it.
#pragma once

#include "saltus/collision/gap.hpp"
#include "saltus/collision/pair.hpp"

namespace saltus {

/// The signed distance of the rim's circle, there, and the line of the edge, less its radius; or of
/// the two circles. phi is infinite where there is no such place. Needs a pair of a cylinder, a,
/// and an edge or another cylinder, with pair.rim in, out, left or right.
Gap rim_crossing_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

/// False where it is beyond an end of the edge, on the far side of a body, or tilted.
bool is_rim_crossing(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap);

/// True where the nearest point of a rim (RimPart::nearest) is not its to watch: a corner, an edge
/// or a rim that crosses it flat. Of a cylinder that stands on a face the four points bear it.
bool is_rim_silent(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap);

/// True where the corner of a pair is one of the points on the rims of a cylinder that does not
/// stand, or nearly: its rim bears it then, wherever it rolls.
bool is_rim_point_silent(const Pair& pair, const Pose& X_WA, const Gap& gap);

/// The part of a pair that moves with a body and is near its place here: the half of the edge on
/// that side, or a line across the cap. False where there is none.
struct NearRim {
  bool of_a;  ///< it stands for a part of a; else of b
  Placed part;
};
bool near_rim(const Pair& pair, const Pose& X_BA, NearRim& out);

}  // namespace saltus
