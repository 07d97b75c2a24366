// The numbers of pairs against a list of all of them.
#include "saltus/collision/pair_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/random_scene.hpp"
#include "saltus/error.hpp"

namespace saltus {
namespace {

using testing_scene::place;
using testing_scene::Random;
using testing_scene::random_shape;

struct Rules : PairRules {
  bool apart(int i, int j) const {
    const auto both = [&](const auto& list, int a, int b) {
      return std::any_of(list.begin(), list.end(), [&](const auto& each) {
        return std::minmax(each.first, each.second) == std::minmax(a, b);
      });
    };
    return both(excluded, i, j) || both(excluded_groups, group[i], group[j]);
  }
};

TEST(PairTable, NumbersEveryWatchedPairOnceRowByRow) {
  Random random(51);
  const std::vector<std::string> kinds = {"sphere",   "capsule",    "box",
                                          "cylinder", "half_space", "convex"};
  for (int scene = 0; scene < 50; ++scene) {
    const int n = 1 + random.index(30);
    std::vector<PlacedShape> shapes;
    Rules rules;
    for (int i = 0; i < n; ++i) {
      shapes.push_back(
          place(random_shape(kinds[random.index(6)], random), random.index(8) - 1, {}));
      rules.group.push_back(random.index(3));
    }
    for (int k = random.index(6); k > 0; --k) {
      rules.excluded.emplace_back(random.index(n), random.index(n));
    }
    for (int k = random.index(2); k > 0; --k) {
      rules.excluded_groups.emplace_back(random.index(3), random.index(3));
    }
    const PairTable table(shapes, rules);
    int number = 0;
    std::vector<char> used(shapes.size(), 0);
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        const bool watched = shapes[i].joint != shapes[j].joint && !rules.apart(i, j);
        const int parts = watched ? part_count(shapes[i].shape, shapes[j].shape) : 0;
        ASSERT_EQ(table.count(i, j), parts);
        ASSERT_EQ(table.count(j, i), parts);
        if (parts == 0) continue;
        used[i] = used[j] = 1;
        ASSERT_EQ(table.range(j, i).first, number);
        for (int part = 0; part < parts; ++part, ++number) {
          const PairTable::Key key = table.key(number);
          ASSERT_EQ(key.a, i);
          ASSERT_EQ(key.b, j);
          ASSERT_EQ(key.part, part);
        }
      }
    }
    EXPECT_EQ(table.size(), number);
    for (int i = 0; i < n; ++i) EXPECT_EQ(table.is_used(i), used[i] != 0);
  }
}

// Pinned: corners, crossings, rims, whole. A gem has 4 corners and 6 edges, a hull of 12 sides 24
// and 36, which with a box are more than 400 crossings.
TEST(PairTable, CountsTheParts) {
  const auto hull = [](int sides) {
    std::vector<Vec3> points;
    for (int k = 0; k < 2 * sides; ++k) {
      const double angle = (k / 2) * 2 * std::numbers::pi / sides;
      points.emplace_back(std::cos(angle), std::sin(angle), k % 2);
    }
    if (sides == 2) points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return test::hull_of(points);
  };
  const Shape rod = Capsule{1, 1}, box = Box{Vec3::Ones()}, can = Cylinder{1, 1};
  const Shape gem = hull(2), prism = hull(6), drum = hull(12), floor = HalfSpace{};
  EXPECT_EQ(part_count(rod, can), 2 + 8 + 3 + 2);
  EXPECT_EQ(part_count(can, box), 8 + 8 + 12 * 3 + 2);
  EXPECT_EQ(part_count(can, can), 8 + 8 + 1 + 4 + 2 + 4);
  EXPECT_EQ(part_count(can, floor), 8 + 2);
  EXPECT_EQ(part_count(gem, rod), 4 + 2 + 6);
  EXPECT_EQ(part_count(box, gem), 8 + 4 + 12 * 6);
  EXPECT_EQ(part_count(gem, gem), 4 + 4 + 6 * 6);
  EXPECT_EQ(part_count(prism, prism), 12 + 12 + 18 * 18);
  EXPECT_EQ(part_count(gem, can), 4 + 8 + 6 * 3 + 2);
  EXPECT_EQ(part_count(drum, can), 24 + 8 + 36 * 3 + 2);
  EXPECT_EQ(part_count(drum, box), 24 + 8 + 1);
  EXPECT_EQ(part_count(drum, drum), 24 + 24 + 1);
}

TEST(PairTable, HasRoomForTenThousandBalls) {
  std::vector<PlacedShape> shapes;
  for (int i = 0; i < 10000; ++i) shapes.push_back(place(Sphere{1}, i, {}));
  const PairTable table = testing_scene::table_of(shapes);
  EXPECT_EQ(table.size(), 10000 * 9999 / 2);
  EXPECT_EQ(table.range(9998, 9999).first, table.size() - 1);
  EXPECT_EQ(table.key(table.size() - 1).a, 9998);
}

TEST(PairTable, SaysWherePairsCannotBeNumbered) {
  std::vector<PlacedShape> shapes;
  for (int i = 0; i < 70000; ++i) shapes.push_back(place(Sphere{1}, i, {}));
  EXPECT_THROW(testing_scene::table_of(shapes), ModelError);
}

}  // namespace
}  // namespace saltus
