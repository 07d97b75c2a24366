#pragma once

#include "collision/shapes/features.hpp"
#include "saltus/collision/gap.hpp"

namespace saltus {

/// The gap of two solids given about `origin`, by their cores.
Gap convex_gap(const Solid& a, const Solid& b, const Vec3& origin);

}  // namespace saltus
