#include <algorithm>
#include <cmath>
#include <sstream>

#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

std::string show(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x[0] << " " << x[1] << " " << x[2] << ")";
  return text.str();
}

bool below(int index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

}  // namespace

std::string flaw_of_hull(const Hull& hull) {
  const std::size_t V = hull.vertices.size(), E = hull.edges.size(), F = hull.faces.size();
  if (V < 4 || V + F != E + 2) {
    return std::to_string(V) + " vertices, " + std::to_string(E) + " edges and " +
           std::to_string(F) + " faces make no polytope";
  }
  for (const Vec3& v : hull.vertices) {
    if (!v.allFinite()) return "a vertex is not finite: " + show(v);
  }
  for (const Hull::Face& face : hull.faces) {
    const bool unit = std::abs(face.normal.norm() - 1) < 1e-9;
    if (!unit) return "a face has normal " + show(face.normal) + ", which is no unit vector";
    const auto is_vertex = [&](int corner) { return below(corner, V); };
    if (face.corners.size() < 3 ||
        !std::all_of(face.corners.begin(), face.corners.end(), is_vertex)) {
      return "the corners of a face are not three or more of its " + std::to_string(V) +
             " vertices";
    }
    if (!(face.normal.dot(hull.center) < face.offset)) {
      return "its center " + show(hull.center) + " is not below a face";
    }
  }
  for (const Hull::Edge& e : hull.edges) {
    if (!below(e.from, V) || !below(e.to, V) || !below(e.left, F) || !below(e.right, F)) {
      return "an edge names a vertex or a face that does not exist";
    }
  }
  const bool rows =
      hull.first_neighbour.size() == V + 1 && hull.first_neighbour.front() == 0 &&
      std::is_sorted(hull.first_neighbour.begin(), hull.first_neighbour.end()) &&
      hull.first_neighbour.back() == static_cast<int>(2 * E) && hull.neighbour.size() == 2 * E &&
      std::all_of(hull.neighbour.begin(), hull.neighbour.end(), [&](int v) { return below(v, V); });
  return rows ? "" : "its lists of neighbours do not fit its edges";
}

}  // namespace saltus
