// Corners and rims that touch a solid with flat faces: which face bears them.
#pragma once

#include "saltus/collision/gap.hpp"
#include "saltus/collision/pair.hpp"

namespace saltus {

/// The gap of a pair of a corner with edges (pair.inward) and a shape, against which it moves; see
/// part_gap.
Gap corner_on_faces(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3& motion_W);

/// The gap of a rim, a disc, and a shape; b is no half-space.
Gap rim_on_faces(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

}  // namespace saltus
