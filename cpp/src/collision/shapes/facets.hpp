// Qhull, behind one function.
#pragma once

#include <string>
#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

struct Facets {
  std::vector<std::vector<int>> corners;  ///< (facets) points, counterclockwise seen from outside
  std::string failure;                    ///< Qhull's words where it gave up; then no facets
};

/// The facets of the points' hull; neighbours that are flat to within `thickness` are one facet.
/// Asks for points of size 1 about the origin. Thread-safe.
Facets hull_facets(const std::vector<Vec3>& points, double thickness);

}  // namespace saltus
