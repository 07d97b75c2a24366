#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// The normal is the half-space's z axis on both sides of its face.
Gap gap_between(const Sphere& a, const Pose& X_WA, const HalfSpace& b, const Pose& X_WB);

}  // namespace saltus
