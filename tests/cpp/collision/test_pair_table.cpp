// The numbers of pairs against a list of all of them.
#include "saltus/collision/pair_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
  const std::vector<std::string> kinds = {"sphere", "capsule", "box", "cylinder", "half_space"};
  for (int scene = 0; scene < 50; ++scene) {
    const int n = 1 + random.index(30);
    std::vector<PlacedShape> shapes;
    Rules rules;
    for (int i = 0; i < n; ++i) {
      shapes.push_back(
          place(random_shape(kinds[random.index(5)], random), random.index(8) - 1, {}));
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
