#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Where a's centre is on b's segment, n is b's x axis and F = 0.
Gap gap_between(const Sphere& a, const Pose& X_WA, const Capsule& b, const Pose& X_WB);

}  // namespace saltus
