// Convex polytopes: the hull of a cloud of points, with its faces and edges.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// A convex solid with flat faces: all x with normal.x <= offset for every face. [m] in its frame.
struct Hull {
  struct Face {
    Vec3 normal;               ///< unit, outward
    double offset;             ///< [m] normal.x on the face
    std::vector<int> corners;  ///< its vertices, counterclockwise seen from outside, 3 or more
  };
  struct Edge {
    int from, to;     ///< vertices
    int left, right;  ///< faces: seen from outside and looking along the edge; left runs with it
  };
  std::vector<Vec3> vertices;
  std::vector<Face> faces;  ///< no two in one plane
  std::vector<Edge> edges;
  std::vector<int> first_neighbour;  ///< (vertices + 1) where the row of a vertex starts in
  std::vector<int> neighbour;        ///< the vertices at the other ends of its edges
  Vec3 center;                       ///< [m] mean of the vertices, inside
};

/// The convex hull of points, facets that are coplanar to rounding joined to one face; by Qhull.
/// Its vertices are some of the points, unchanged and in their order. Thread-safe.
/// @throws ModelError where they are fewer than 4, not finite, or lie in a plane, which is to say
/// that they are thinner than 1e-6 of their length (`what` names them in the message).
SALTUS_EXPORT Hull convex_hull(const std::vector<Vec3>& points, const std::string& what = "points");

}  // namespace saltus
