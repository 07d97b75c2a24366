// The hull of a cloud: which points are corners, and that its faces and edges make one polytope.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "kit/ask.hpp"
#include "kit/hulls.hpp"
#include "saltus/collision/hull.hpp"
#include "saltus/error.hpp"

namespace saltus {
namespace {

using Points = std::vector<Vec3>;

double size_of(const Hull& hull) {
  double size = 0;
  for (const Vec3& v : hull.vertices) size = std::fmax(size, (v - hull.center).norm());
  return size;
}

/// What rounding may do: to the coordinates as given, and to normals of faces of this size.
double rounding(const Hull& hull) {
  return 1e-14 * (hull.center.norm() + size_of(hull)) + 1e-12 * size_of(hull);
}

double farthest(const Points& points, const Vec3& direction) {
  double far = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) far = std::fmax(far, direction.dot(p));
  return far;
}

void expect_holds(const Hull& hull, const Points& points) {
  for (const Hull::Face& face : hull.faces) {
    ASSERT_LE(farthest(points, face.normal), face.offset + rounding(hull));
    ASSERT_LE(farthest(hull.vertices, face.normal), face.offset);
    ASSERT_LT(face.normal.dot(hull.center), face.offset);
  }
}

void expect_faces(const Hull& hull) {
  for (const Hull::Face& face : hull.faces) {
    const std::vector<int>& c = face.corners;
    ASSERT_GE(c.size(), 3u);
    EXPECT_NEAR(face.normal.norm(), 1, 1e-15);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vec3& a = hull.vertices[c[i]];
      const Vec3& b = hull.vertices[c[(i + 1) % c.size()]];
      const Vec3& d = hull.vertices[c[(i + 2) % c.size()]];
      EXPECT_NEAR(face.normal.dot(a), face.offset, rounding(hull));
      EXPECT_GT((b - a).cross(d - b).dot(face.normal), 0);  // a left turn at every corner
    }
  }
}

bool runs_along(const Hull::Face& face, int from, int to) {
  const std::vector<int>& c = face.corners;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c[i] == from && c[(i + 1) % c.size()] == to) return true;
  }
  return false;
}

void expect_edges(const Hull& hull) {
  std::size_t corners = 0;
  for (const Hull::Face& face : hull.faces) corners += face.corners.size();
  EXPECT_EQ(corners, 2 * hull.edges.size());
  std::set<std::pair<int, int>> ends;
  for (const Hull::Edge& edge : hull.edges) {
    EXPECT_TRUE(runs_along(hull.faces[edge.left], edge.from, edge.to));
    EXPECT_TRUE(runs_along(hull.faces[edge.right], edge.to, edge.from));
    ends.insert({edge.from, edge.to});
    ends.insert({edge.to, edge.from});
  }
  ASSERT_EQ(ends.size(), 2 * hull.edges.size());
  ASSERT_EQ(hull.first_neighbour.size(), hull.vertices.size() + 1);
  ASSERT_EQ(hull.neighbour.size(), ends.size());
  EXPECT_EQ(hull.first_neighbour.front(), 0);
  EXPECT_EQ(hull.first_neighbour.back(), static_cast<int>(hull.neighbour.size()));
  for (int v = 0; v < static_cast<int>(hull.vertices.size()); ++v) {
    EXPECT_GE(hull.first_neighbour[v + 1] - hull.first_neighbour[v], 3);
    for (int k = hull.first_neighbour[v]; k < hull.first_neighbour[v + 1]; ++k) {
      EXPECT_EQ(ends.count({v, hull.neighbour[k]}), 1u);
    }
  }
}

/// All that a hull promises.
Hull checked_hull(const Points& points) {
  Hull hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size() + hull.faces.size(), hull.edges.size() + 2);  // Euler
  auto given = points.begin();
  for (const Vec3& v : hull.vertices) {  // in the order given
    given = std::find(given, points.end(), v);
    EXPECT_NE(given, points.end());
  }
  expect_holds(hull, points);
  expect_faces(hull);
  expect_edges(hull);
  return hull;
}

void expect_counts(const Hull& hull, std::size_t vertices, std::size_t faces, std::size_t edges) {
  EXPECT_EQ(hull.vertices.size(), vertices);
  EXPECT_EQ(hull.faces.size(), faces);
  EXPECT_EQ(hull.edges.size(), edges);
}

Points box(const Vec3& half) { return test::corners(half); }

/// A grid of the solid box: corners, points on edges and faces, points inside.
Points filled_box(const Vec3& half, int cells) {
  Points points;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      for (int k = 0; k <= cells; ++k) {
        points.push_back((2.0 / cells * Vec3(i, j, k) - Vec3::Ones()).cwiseProduct(half));
      }
    }
  }
  return points;
}

/// Midpoints of the faces' edges pushed to the unit sphere, again and again.
Points icosphere(int times) {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  Points points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      for (const Vec3& p : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)}) {
        points.push_back(p.normalized());
      }
    }
  }
  for (int i = 0; i < times; ++i) {
    const Hull hull = convex_hull(points);
    for (const Hull::Edge& e : hull.edges) {
      points.push_back((hull.vertices[e.from] + hull.vertices[e.to]).normalized());
    }
  }
  return points;
}

Points moved(Points points, const Mat3& R, const Vec3& by) {
  for (Vec3& p : points) p = R * p + by;
  return points;
}

Points random_cloud(std::mt19937& random, int count, const Vec3& half) {
  std::normal_distribution<double> normal;
  Points points;
  for (int i = 0; i < count; ++i) {
    points.push_back(half.cwiseProduct(Vec3(normal(random), normal(random), normal(random))));
  }
  return points;
}

void expect_error(const Points& points, const std::vector<std::string>& parts) {
  test::expect_error([&] { convex_hull(points, "the stone"); }, parts);
}

TEST(Hull, OfATetrahedron) {
  const Hull hull = checked_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  expect_counts(hull, 4, 4, 6);
  EXPECT_LT((hull.center - Vec3(0.25, 0.25, 0.25)).norm(), 1e-15);
}

TEST(Hull, OfABoxHasItsCornersEdgesAndSides) {
  expect_counts(checked_hull(box({1, 2, 3})), 8, 6, 12);
  expect_counts(checked_hull(filled_box({1, 2, 3}, 7)), 8, 6, 12);
  expect_counts(checked_hull(filled_box({0.1, 0.2, 1e-4}, 5)), 8, 6, 12);
}

TEST(Hull, OfATurnedBoxThatRoundingSpoilsIsTheSame) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3, 3);
  for (int i = 0; i < 50; ++i) {
    const Mat3 R = rotation_from_rpy(angle(random), angle(random), angle(random));
    for (const double far : {0.0, 1.0, 1e3, 1e6}) {
      const Points points = moved(filled_box({0.3, 0.2, 0.1}, 4), R, far * Vec3(1, -2, 0.5));
      expect_counts(checked_hull(points), 8, 6, 12);
    }
  }
}

TEST(Hull, OfPointsThatComeTwiceIsTheSame) {
  Points points = box({1, 1, 1});
  for (const Vec3& p : box({1, 1, 1})) points.push_back(p);
  points.push_back({-0.0, 0.0, 0.0});
  points.push_back({0.0, -0.0, 0.0});
  expect_counts(checked_hull(points), 8, 6, 12);
}

TEST(Hull, OfAnIcosphereHasAllItsPoints) {
  for (const int times : {0, 1, 2, 3, 4}) {
    const std::size_t faces = 20u << (2 * times);
    expect_counts(checked_hull(icosphere(times)), faces / 2 + 2, faces, 3 * faces / 2);
  }
}

TEST(Hull, OfAPrismHasPolygonsAsCaps) {
  for (const int n : {3, 5, 64, 1000}) {
    Points points;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / n;
      for (const double z : {-0.3, 0.3}) points.push_back({std::cos(angle), std::sin(angle), z});
    }
    const auto corners = static_cast<std::size_t>(n);
    expect_counts(checked_hull(points), 2 * corners, corners + 2, 3 * corners);
    const Mat3 R = rotation_from_rpy(0.3, -1.1, 2);
    expect_counts(checked_hull(moved(points, R, {5, 6, 7})), 2 * corners, corners + 2, 3 * corners);
  }
}

TEST(Hull, OfRandomClouds) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) checked_hull(random_cloud(random, 4 + i % 4, {1, 1, 1}));
  for (const int count : {10, 30, 100, 3000}) {
    for (const Vec3& half : {Vec3(1, 1, 1), Vec3(1e-3, 2e-3, 1e-3), Vec3(1, 1, 1e-4),
                             Vec3(1e-4, 1e-4, 1), Vec3(1e4, 1, 10)}) {
      for (int i = 0; i < 5; ++i) checked_hull(random_cloud(random, count, half));
    }
  }
}

TEST(Hull, OfACloudInSinglePrecision) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const Mat3 R = rotation_from_rpy(0.1 * i, 0.2, 0.3);
    Points points = moved(filled_box({0.3, 0.2, 0.1}, 6), R, {0.5, 0.1, 0});
    for (Vec3& p : points) p = p.cast<float>().cast<double>();
    const Hull hull = checked_hull(points);
    EXPECT_LT(hull.vertices.size(), points.size());
  }
}

TEST(Hull, IsAsSmallOrLargeAsItsPoints) {
  for (const double scale : {1e-100, 1e-9, 1e9, 1e100}) {
    Points points = filled_box({1, 2, 3}, 3);
    for (Vec3& p : points) p *= scale;
    expect_counts(checked_hull(points), 8, 6, 12);
  }
}

TEST(Hull, NeedsFourPointsThatAreNotInAPlane) {
  expect_error({}, {"the stone: 0 points", "needs 4"});
  expect_error({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"the stone: 3 points", "needs 4"});
  expect_error(Points(9, Vec3(1, 2, 3)), {"the stone: 9 points, 1 of them distinct"});
  expect_error({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}},
               {"4 points that lie in a plane: 2 long, 1 wide, 0 thin"});
  expect_error({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, {"that lie in a line: 5.19615 long"});
  expect_error(filled_box({1, 1, 1e-7}, 3),
               {"64 points that lie in a plane", "2e-07 thin", "thicker than"});
  expect_error(moved(box({1e-9, 1e-9, 1e-9}), Mat3::Identity(), {1e6, 0, 0}), {"the stone: 8"});
}

TEST(Hull, NeedsFinitePoints) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    Points points = box({1, 1, 1});
    points[5][1] = bad;
    expect_error(points, {"the stone: point 5 is not finite: ("});
  }
}

}  // namespace
}  // namespace saltus
