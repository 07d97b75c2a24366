#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Inside b the nearest point of the surface counts; of equally near ones that on the + side, of
/// the first of b's shortest axes.
Gap gap_between(const Sphere& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB);

}  // namespace saltus
