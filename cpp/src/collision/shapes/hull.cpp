// Qhull tells which points are corners of which facet; everything else is made here from the points
// as they were given, so that planes hold their corners to rounding.
#include "saltus/collision/hull.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <tuple>

#include "collision/shapes/facets.hpp"
#include "saltus/error.hpp"

namespace saltus {
namespace {

using Corners = std::vector<std::vector<int>>;  // (faces) counterclockwise

constexpr double eps = std::numeric_limits<double>::epsilon();
// What is thinner than a millionth of its size is flat: files in single precision cannot tell it
// from a plane, and normals of its narrow faces would be rounding.
constexpr double thinnest = 1e-6;

/// The points without duplicates, moved and scaled to size 1 about the origin.
struct Cloud {
  std::vector<int> index;    ///< of each in the points given
  std::vector<Vec3> points;  ///< largest |coordinate| 0.5 to 1
  Vec3 middle;               ///< of the box around the points given
  double size;               ///< a power of 2, above half the longest side of this box
  double rounding;           ///< of a coordinate given, in this scale
};

[[noreturn]] void fail(const std::string& what, const std::string& why) {
  throw ModelError(what + ": " + why);
}

std::string show(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

std::string show(const Vec3& x) {
  return "(" + show(x[0]) + " " + show(x[1]) + " " + show(x[2]) + ")";
}

/// The first of each, in the order given.
std::vector<int> distinct(const std::vector<Vec3>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::tuple(points[i][0], points[i][1], points[i][2], i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  const auto same = [&](int a, int b) { return points[a] == points[b]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  std::sort(order.begin(), order.end());
  return order;
}

Cloud cloud(const std::vector<Vec3>& points, const std::string& what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    fail(what, "point " + std::to_string(i) + " is not finite: " + show(points[i]));
  }
  Cloud cloud;
  cloud.index = distinct(points);
  if (cloud.index.size() < 4) {
    const std::string given = std::to_string(points.size()) + " points";
    const std::size_t n = cloud.index.size();
    fail(what, given + (n < points.size() ? ", " + std::to_string(n) + " of them distinct" : "") +
                   "; a convex solid needs 4 that are not in a plane");
  }
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  cloud.middle = 0.5 * low + 0.5 * high;
  cloud.size = std::ldexp(1.0, std::ilogb((0.5 * high - 0.5 * low).maxCoeff()) + 1);
  cloud.rounding = eps * std::fmax(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  cloud.rounding /= cloud.size;
  for (const int i : cloud.index) cloud.points.push_back((points[i] - cloud.middle) / cloud.size);
  return cloud;
}

/// Along the axes of its inertia, the thinnest first; [half of its longest side].
Vec3 extents(const std::vector<Vec3>& points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(axes.transpose() * (p - mean));
    high = high.cwiseMax(axes.transpose() * (p - mean));
  }
  return high - low;
}

void check_is_solid(const Cloud& cloud, const std::string& what) {
  const Vec3 e = extents(cloud.points);
  const double least = std::fmax(thinnest * e[2], 64 * cloud.rounding);
  if (e[0] > least) return;
  const std::string shape = e[1] > least ? "a plane" : "a line";
  fail(what, std::to_string(cloud.points.size()) + " points that lie in " + shape + ": " +
                 show(e[2] * cloud.size) + " long, " + show(e[1] * cloud.size) + " wide, " +
                 show(e[0] * cloud.size) + " thin; a convex solid is thicker than " +
                 show(least * cloud.size));
}

/// A vertex between two faces only lies on an edge of theirs. Facets that shrink to less than a
/// triangle are left as they are, for is_closed to find.
void drop_points_on_edges(Corners& faces, std::size_t points) {
  std::vector<int> uses(points, 0);
  for (const std::vector<int>& face : faces) {
    for (const int corner : face) ++uses[corner];
  }
  for (std::vector<int>& face : faces) {
    face.erase(std::remove_if(face.begin(), face.end(), [&](int c) { return uses[c] < 3; }),
               face.end());
  }
}

/// a - b = high + low without rounding (Knuth).
struct Difference {
  Difference(double a, double b) : high(a - b) {
    const double minus_b = high - a;
    low = (a - (high - minus_b)) - (b + minus_b);
  }
  double high, low;
};

/// a b - c d, whose products may cancel to the last digit (Kahan), and what the low parts add.
double cross(const Difference& a, const Difference& b, const Difference& c, const Difference& d) {
  const double cd = c.high * d.high;
  const double rounding = std::fma(-c.high, d.high, cd);
  const double high = std::fma(a.high, b.high, -cd) + rounding;
  return high + ((a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high));
}

/// Twice the area of the triangle, along its normal. Its digits are good even where the triangle is
/// a needle, which clouds with nearly coplanar points are full of.
Vec3 triangle(const Vec3& origin, const Vec3& p, const Vec3& q) {
  const Difference a[3] = {{p[0], origin[0]}, {p[1], origin[1]}, {p[2], origin[2]}};
  const Difference b[3] = {{q[0], origin[0]}, {q[1], origin[1]}, {q[2], origin[2]}};
  return {cross(a[1], b[2], a[2], b[1]), cross(a[2], b[0], a[0], b[2]),
          cross(a[0], b[1], a[1], b[0])};
}

/// Newell's: the sum over triangles is the best normal of corners that are a little off a plane.
Vec3 normal_of(const std::vector<int>& face, const std::vector<Vec3>& points) {
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    area += triangle(points[face[0]], points[face[i]], points[face[i + 1]]);
  }
  return area.normalized();
}

/// Faces, with vertices numbered as the corners are, without their offsets.
void add_faces(Hull& hull, const Corners& corners, double size) {
  std::vector<Vec3> scaled = hull.vertices;  // by a power of 2, so without rounding
  for (Vec3& v : scaled) v /= size;
  for (const std::vector<int>& face : corners) {
    hull.faces.push_back({normal_of(face, scaled), 0, face});
  }
}

/// The greatest normal.v, uphill from a corner of the face: from vertex to neighbour.
double climb(const Hull& hull, const Hull::Face& face) {
  int best = face.corners[0];
  double offset = face.normal.dot(hull.vertices[best]);
  for (int at = -1; at != best;) {
    at = best;
    for (int k = hull.first_neighbour[at]; k < hull.first_neighbour[at + 1]; ++k) {
      const double other = face.normal.dot(hull.vertices[hull.neighbour[k]]);
      if (!(other > offset)) continue;
      offset = other;
      best = hull.neighbour[k];
    }
  }
  return offset;
}

/// So that no vertex is outside, to rounding where they are too many to look at all for all faces.
void set_offsets(Hull& hull) {
  constexpr std::size_t most = 10'000'000;
  const bool all = hull.vertices.size() * hull.faces.size() <= most;
  for (Hull::Face& face : hull.faces) {
    face.offset = climb(hull, face);
    if (!all) continue;
    for (const Vec3& v : hull.vertices) face.offset = std::fmax(face.offset, face.normal.dot(v));
  }
}

/// @return false where an edge has not one face on each side.
bool add_edges(Hull& hull) {
  std::map<std::pair<int, int>, int> left;  // (from, to) -> face that runs along it
  for (int f = 0; f < static_cast<int>(hull.faces.size()); ++f) {
    const std::vector<int>& c = hull.faces[f].corners;
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (!left.emplace(std::pair(c[i], c[(i + 1) % c.size()]), f).second) return false;
    }
  }
  for (const auto& [ends, face] : left) {
    const auto [from, to] = ends;
    const auto other = left.find({to, from});
    if (other == left.end()) return false;
    if (from < to) hull.edges.push_back({from, to, face, other->second});
  }
  return true;
}

void add_neighbours(Hull& hull) {
  const std::size_t n = hull.vertices.size();
  std::vector<std::vector<int>> rows(n);
  for (const Hull::Edge& edge : hull.edges) {
    rows[edge.from].push_back(edge.to);
    rows[edge.to].push_back(edge.from);
  }
  hull.first_neighbour = {0};
  for (std::vector<int>& row : rows) {
    std::sort(row.begin(), row.end());
    hull.neighbour.insert(hull.neighbour.end(), row.begin(), row.end());
    hull.first_neighbour.push_back(static_cast<int>(hull.neighbour.size()));
  }
}

/// A polytope by Euler's formula, with each corner in the plane of its face.
bool is_sound(const Hull& hull, double tolerance) {
  const std::size_t V = hull.vertices.size(), E = hull.edges.size(), F = hull.faces.size();
  if (V + F != E + 2) return false;
  return std::all_of(hull.faces.begin(), hull.faces.end(), [&](const Hull::Face& face) {
    return std::all_of(face.corners.begin(), face.corners.end(), [&](int corner) {
      return face.normal.dot(hull.vertices[corner]) >= face.offset - tolerance;
    });
  });
}

/// @return false where Qhull's facets, this thick, make no polytope.
bool assemble(Hull& hull, Corners faces, const Cloud& cloud, const std::vector<Vec3>& given,
              double thickness) {
  drop_points_on_edges(faces, cloud.points.size());
  std::vector<int> number(cloud.points.size(), -1);
  for (const std::vector<int>& face : faces) {
    if (face.size() < 3) return false;
    for (const int corner : face) number[corner] = 0;
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<int>(hull.vertices.size());
    hull.vertices.push_back(given[cloud.index[i]]);
    sum += cloud.points[i];
  }
  for (std::vector<int>& face : faces) {
    for (int& corner : face) corner = number[corner];
  }
  hull.center = cloud.middle + cloud.size * (sum / static_cast<double>(hull.vertices.size()));
  add_faces(hull, faces, cloud.size);
  if (!add_edges(hull)) return false;
  add_neighbours(hull);
  set_offsets(hull);
  // facets joined of several are as thick as the sum of what they were joined by
  return is_sound(hull, 100 * thickness * cloud.size);
}

}  // namespace

Hull convex_hull(const std::vector<Vec3>& points, const std::string& what) {
  const Cloud cloud = saltus::cloud(points, what);
  check_is_solid(cloud, what);
  std::string failure = "its facets do not close";
  // Rounding alone decides what is coplanar, unless Qhull fails at it.
  for (double thickness = 1e-13 + 4 * cloud.rounding; thickness < 1e-6; thickness *= 10) {
    Facets facets = hull_facets(cloud.points, thickness);
    Hull hull;
    if (!facets.failure.empty()) {
      failure = "Qhull says " + facets.failure;
    } else if (assemble(hull, std::move(facets.corners), cloud, points, thickness)) {
      return hull;
    }
  }
  fail(what, std::to_string(cloud.points.size()) + " points without a convex hull: " + failure);
}

}  // namespace saltus
