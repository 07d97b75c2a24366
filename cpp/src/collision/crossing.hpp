// Two edges that cross: the gap between their lines, and whether they face each other.
#pragma once

#include "saltus/collision/contact.hpp"

namespace saltus {

/// The signed distance of the two axes, less both radii, as if they had no ends; phi is infinite
/// where they are parallel. Needs a pair of two capsules (radius 0 for edges).
Gap crossing_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

/// False where the lines cross beyond the ends of an edge, or on the far side of a body.
bool is_crossing(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap);

}  // namespace saltus
