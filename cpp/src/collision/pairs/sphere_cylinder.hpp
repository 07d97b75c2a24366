#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Inside b the nearer of side and cap counts, the cap if equal, its + side at 0; on the axis the
/// side's n is b's x axis and F = 0.
Gap gap_between(const Sphere& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB);

}  // namespace saltus
