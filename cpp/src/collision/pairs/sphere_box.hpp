#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Inside b the nearest face counts; of equally near ones the first of x, y, z, its + side at 0.
Gap gap_between(const Sphere& a, const Pose& X_WA, const Box& b, const Pose& X_WB);

}  // namespace saltus
