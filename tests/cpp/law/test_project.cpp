// The cone that impulses lie in, by itself.
#include <gtest/gtest.h>

#include <random>

#include "variational/law/pile_island.hpp"

namespace saltus {
namespace {

Vec3 random_point(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

TEST(Project, StaysWhereItIsLawful) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double friction = trial % 4 * 0.5;
    const Vec3 p = to_cone(random_point(random), friction);
    EXPECT_GE(p[0], 0);
    EXPECT_LE(p.tail<2>().norm(), friction * p[0] * (1 + 1e-15));
    // rounding of one norm and one product
    EXPECT_LE((to_cone(p, friction) - p).norm(), 1e-15 * p.norm());
  }
}

/// P' by central differences: P is smooth but on the cone's border and where nothing is pressed.
TEST(Project, ItsDerivativeIsThatOfDifferences) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const double friction = trial % 4 * 0.5, step = 1e-6;
    const Vec3 a = random_point(random);
    const double limit = friction * a[0];
    if (std::abs(a[0]) < 1e-3 || std::abs(a.tail<2>().norm() - limit) < 1e-3) continue;
    if (friction > 0 && a.tail<2>().norm() < 1e-2) continue;
    Mat3 D;
    to_cone(a, friction, &D);
    for (int k = 0; k < 3; ++k) {
      const Vec3 dx = step * Vec3::Unit(k);
      const Vec3 difference = (to_cone(a + dx, friction) - to_cone(a - dx, friction)) / (2 * step);
      // 1e-12 of step^2 times third derivatives (1 / |a_t|^2 <= 1e4), 1e-10 of rounding
      EXPECT_LE((difference - D.col(k)).norm(), 1e-7) << trial;
    }
  }
}

/// Dry friction of a joint: an interval, whatever the other two numbers are.
TEST(Project, AnIntervalCutsAndItsDerivativeIsThatOfDifferences) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 a = random_point(random);
    const double bound = 0.1 + trial % 5 * 0.3, step = 1e-6;
    Mat3 D;
    const Vec3 p = to_set(a, 0, bound, &D);
    EXPECT_LE(std::abs(p[0]), bound);
    EXPECT_TRUE(p.tail<2>().isZero(0));
    EXPECT_EQ(to_set(p, 0, bound), p);
    if (std::abs(std::abs(a[0]) - bound) < 1e-3) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = step * Vec3::Unit(k);
      const Vec3 slope = (to_set(a + d, 0, bound) - to_set(a - d, 0, bound)) / (2 * step);
      EXPECT_LE((slope - D.col(k)).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace saltus
