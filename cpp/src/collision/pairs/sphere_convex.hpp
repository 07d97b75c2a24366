#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Inside b, and on its surface, the nearest face counts, of equally near ones the first listed.
Gap gap_between(const Sphere& a, const Pose& X_WA, const Convex& b, const Pose& X_WB);

}  // namespace saltus
