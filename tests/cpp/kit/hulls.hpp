// Convex shapes from points.
#pragma once

#include <memory>
#include <vector>

#include "saltus/collision/hull.hpp"
#include "saltus/collision/shapes.hpp"

namespace saltus::test {

inline Convex hull_of(const std::vector<Vec3>& points) {
  return {std::make_shared<const Hull>(convex_hull(points))};
}

/// The eight corners of a box.
inline std::vector<Vec3> corners(const Vec3& half, const Pose& X = {}) {
  std::vector<Vec3> points;
  for (int k = 0; k < 8; ++k) {
    points.push_back(X * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).cwiseProduct(half));
  }
  return points;
}

}  // namespace saltus::test
