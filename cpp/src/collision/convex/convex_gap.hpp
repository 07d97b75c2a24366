#pragma once

#include "collision/convex/solid.hpp"

namespace saltus {

/// The gap of two solids given about `origin`, by their cores.
Gap convex_gap(const Solid& a, const Solid& b, const Vec3& origin);

}  // namespace saltus
