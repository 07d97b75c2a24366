// First guesses of the direction that separates two cores most.
#pragma once

#include <optional>

#include "collision/shapes/features.hpp"

namespace saltus {

/// The point of a's core least along n less the point of b's farthest along it.
inline Vec3 difference(const Solid& a, const Solid& b, const Vec3& n) {
  return support(a, -n) - support(b, n);
}

/// From b to a where they are apart, else nothing. Where they nearly touch this may be rounding:
/// check what follows from it. The square of the distance is found to a part of `tolerance`, n to
/// its root.
std::optional<Vec3> direction_apart(const Solid& a, const Solid& b, double tolerance);

/// Where they overlap, or just do not.
Vec3 direction_through(const Solid& a, const Solid& b);

}  // namespace saltus
