#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

// A direction counts as level where it rises by no more than a rounding error. Of equally low
// points the one counts that is on the + side of the body's own axes (a convex: whose vertex is
// listed first), so that a body lying flat touches at a corner, at an end or, upright cylinder, at
// the rim on its x axis.
Gap gap_between(const Capsule& a, const Pose& X_WA, const HalfSpace& b, const Pose& X_WB);
Gap gap_between(const Box& a, const Pose& X_WA, const HalfSpace& b, const Pose& X_WB);
Gap gap_between(const Cylinder& a, const Pose& X_WA, const HalfSpace& b, const Pose& X_WB);
Gap gap_between(const Ellipsoid& a, const Pose& X_WA, const HalfSpace& b, const Pose& X_WB);
Gap gap_between(const Convex& a, const Pose& X_WA, const HalfSpace& b, const Pose& X_WB);

}  // namespace saltus
