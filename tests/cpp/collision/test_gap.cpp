// The contract of Gap, over every pair in the table: one test for all.
#include "saltus/collision/gap.hpp"

#include <gtest/gtest.h>

#include "collision/gap_scene.hpp"

namespace saltus {
namespace {

using testing_scene::eps;
using testing_scene::outside;
using testing_scene::Placed;
using testing_scene::Random;
using testing_scene::random_placed;

using Names = std::pair<std::string, std::string>;

class AllPairs : public ::testing::TestWithParam<Names> {
 protected:
  Random random{7};
  Placed place() { return random_placed(GetParam(), random); }
};

TEST_P(AllPairs, WitnessesAndNormal) {
  for (int k = 0; k < 2000; ++k) {
    const Placed x = place();
    const Gap g = x.gap();
    const double rounding = 16 * eps * x.scale();
    EXPECT_LE((g.p_WA - g.p_WB - g.phi * g.n_W).norm(), rounding);
    EXPECT_NEAR(g.n_W.norm(), 1, 16 * eps);
    EXPECT_NEAR(outside(x.a, x.X_WA.inverse() * g.p_WA), 0, rounding);
    EXPECT_NEAR(outside(x.b, x.X_WB.inverse() * g.p_WB), 0, rounding);
    // P is on the contact line
    EXPECT_LE(g.n_W.cross(g.center_W - g.p_WA).norm(), rounding);
    if (std::holds_alternative<Sphere>(x.a)) {
      EXPECT_EQ(g.center_W, x.X_WA.p);
    }
  }
}

// The certificate: n separates by phi, and nothing separates more.
TEST_P(AllPairs, NoDirectionSeparatesMore) {
  for (int k = 0; k < 1000; ++k) {
    const Placed x = place();
    const Gap g = x.gap();
    const double rounding = 16 * eps * x.scale();
    EXPECT_NEAR(x.separation(g.n_W), g.phi, rounding);
    for (int i = 0; i < 300; ++i) {
      const double size = std::pow(10, random.uniform(-9, 0));
      const Vec3 n = i < 150 ? random.direction() : (g.n_W + random.vector(size)).normalized();
      EXPECT_LE(x.separation(n), g.phi + rounding);
    }
  }
}

TEST_P(AllPairs, ExchangeTurnsTheNormalRound) {
  for (int k = 0; k < 500; ++k) {
    const Placed x = place();
    const Gap g = x.gap(), h = gap(x.b, x.X_WB, x.a, x.X_WA);
    const double rounding = 64 * eps * x.scale();
    EXPECT_NEAR(g.phi, h.phi, rounding);
    const double turn = rounding * (1 + curvature(g).norm());
    EXPECT_LE((g.n_W + h.n_W).norm(), turn);
    EXPECT_LE((g.p_WA - h.p_WB).norm(), turn);
    EXPECT_LE((g.p_WB - h.p_WA).norm(), turn);
    EXPECT_LE((F_W(g) - F_W(h)).norm(), turn * (1 + curvature(g).norm()));
  }
}

TEST_P(AllPairs, MovesWithTheBodies) {
  for (int k = 0; k < 500; ++k) {
    Placed x = place();
    const Gap g = x.gap();
    const Pose X = random.pose(2);
    x.X_WA = X * x.X_WA;
    x.X_WB = X * x.X_WB;
    const Gap h = x.gap();
    // rounding of the products, 1e-13 at 1 km, over the least length of a feature
    const double rounding = 2e-15 * x.scale();
    EXPECT_NEAR(g.phi, h.phi, rounding);
    const double bend = 1 + curvature(g).norm();
    EXPECT_LE((X.R * g.n_W - h.n_W).norm(), rounding * bend);
    EXPECT_LE((X * g.p_WB - h.p_WB).norm(), 2 * rounding * bend);
    EXPECT_LE((X.R * F_W(g) * X.R.transpose() - F_W(h)).norm(), 4 * rounding * bend * bend);
  }
}

// The certified advance along chords rests on this.
TEST_P(AllPairs, IsConvexInTheCentre) {
  for (int k = 0; k < 2000; ++k) {
    const Placed x = place();
    const Gap g = x.gap();
    const Vec3 step = random.vector(random.chance(0.5) ? 2 : 0.1);
    const double there = x.moved_by(step).gap().phi;
    EXPECT_GE(there, g.phi + g.n_W.dot(step) - 16 * eps * x.scale());
    EXPECT_LE(std::abs(there - g.phi), step.norm() + 16 * eps * x.scale());
  }
}

// Brought together along n, bodies keep n, and touch as well as they are told to.
TEST_P(AllPairs, IsAsAccurateWhereBodiesTouch) {
  for (int k = 0; k < 1000; ++k) {
    Placed x = place();
    x.X_WA.p -= x.X_WB.p;  // no rounding by far-off origins
    x.X_WB.p.setZero();
    const Gap g = x.gap();
    const double size = std::pow(10, -3.0 - random.index(13)),
                 phi = random.chance(0.5) ? size : -size;
    if (phi < g.phi && g.phi < 0) continue;
    const Placed y = x.moved_by((phi - g.phi) * g.n_W);
    const Gap h = y.gap();
    const double rounding = 16 * eps * x.scale();
    // of overlapping bodies another direction may be the better beyond the touch
    if (phi > 0 || g.phi < phi) {
      EXPECT_NEAR(h.phi, phi, rounding);
    }
    EXPECT_NEAR(y.separation(h.n_W), h.phi, rounding);
    EXPECT_LE((h.p_WA - h.p_WB - h.phi * h.n_W).norm(), rounding);
    for (int i = 0; i < 100; ++i) {
      const double angle = std::pow(10, random.uniform(-9, 0));
      EXPECT_LE(y.separation((h.n_W + random.vector(angle)).normalized()), h.phi + rounding);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, AllPairs, ::testing::ValuesIn(gap_table()),
                         [](const ::testing::TestParamInfo<Names>& names) {
                           return names.param.first + "_" + names.param.second;
                         });

TEST(GapTable, IsAsDocumented) {
  // every two kinds once, but for two half-spaces; a half-space is always b
  const std::vector<std::string> kinds = {"sphere",     "capsule",   "box",   "cylinder",
                                          "half_space", "ellipsoid", "convex"};
  std::vector<Names> expected;
  for (const std::string& a : kinds) {
    for (const std::string& b : kinds) {
      const bool later =
          std::find(kinds.begin(), kinds.end(), a) <= std::find(kinds.begin(), kinds.end(), b);
      const bool above = b == "half_space" && a != b;
      if ((later && a != "half_space") || above) expected.emplace_back(a, b);
    }
  }
  EXPECT_EQ(expected.size(), 27u);
  EXPECT_EQ(gap_table(), expected);
}

TEST(GapTable, AgreesWithHasGapInBothOrders) {
  const std::vector<Shape> all = {Sphere{1},      Capsule{1, 1}, Box{Vec3::Ones()},
                                  Cylinder{1, 1}, HalfSpace{},   Ellipsoid{Vec3::Ones()},
                                  Convex{}};
  for (const Shape& a : all) {
    for (const Shape& b : all) {
      const bool planes = shape_name(a) == "half_space" && shape_name(b) == "half_space";
      EXPECT_EQ(has_gap(a, b), !planes) << shape_name(a) << " " << shape_name(b);
    }
  }
}

TEST(Shapes, Sizes) {
  EXPECT_EQ(bounding_radius(Sphere{2}), 2);
  EXPECT_EQ(bounding_radius(Capsule{1, 3}), 4);
  EXPECT_EQ(bounding_radius(Box{Vec3(2, 3, 6)}), 7);
  EXPECT_EQ(bounding_radius(Cylinder{3, 4}), 5);
  EXPECT_TRUE(std::isinf(bounding_radius(HalfSpace{})));
  EXPECT_EQ(feature_size(Sphere{2}), 2);
  EXPECT_EQ(feature_size(Capsule{1, 0.1}), 1);
  EXPECT_EQ(feature_size(Box{Vec3(2, 3, 1)}), 1);
  EXPECT_EQ(feature_size(Cylinder{3, 2}), 2);
  EXPECT_TRUE(std::isinf(feature_size(HalfSpace{})));
}

}  // namespace
}  // namespace saltus
