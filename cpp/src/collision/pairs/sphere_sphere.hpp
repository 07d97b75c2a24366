#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Where the centres coincide, n is b's z axis and F = 0.
Gap gap_between(const Sphere& a, const Pose& X_WA, const Sphere& b, const Pose& X_WB);

}  // namespace saltus
