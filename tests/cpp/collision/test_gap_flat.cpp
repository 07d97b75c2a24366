// Flat on flat and parallel: where many witnesses are right, a documented one; never NaN.
#include <gtest/gtest.h>

#include "collision/gap_scene.hpp"

namespace saltus {
namespace {

using test::hull_of;
using testing_scene::eps;
using testing_scene::outside;
using testing_scene::Placed;
using testing_scene::Random;

Convex prism(int sides, double radius, double half) {
  std::vector<Vec3> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), half);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -half);
  }
  return hull_of(points);
}

Convex octahedron(double r) {
  std::vector<Vec3> points;
  for (int k = 0; k < 3; ++k) {
    points.push_back(r * Vec3::Unit(k));
    points.push_back(-r * Vec3::Unit(k));
  }
  return hull_of(points);
}

/// All that holds wherever bodies are.
void expect_sound(const Placed& x, const Gap& g, Random& random) {
  const double rounding = 16 * eps * x.scale();
  ASSERT_TRUE(std::isfinite(g.phi));
  EXPECT_NEAR(g.n_W.norm(), 1, 8 * eps);
  EXPECT_LE((g.p_WA - g.p_WB - g.phi * g.n_W).norm(), rounding);
  EXPECT_NEAR(outside(x.a, x.X_WA.inverse() * g.p_WA), 0, rounding);
  EXPECT_NEAR(outside(x.b, x.X_WB.inverse() * g.p_WB), 0, rounding);
  EXPECT_NEAR(x.separation(g.n_W), g.phi, rounding);
  for (int i = 0; i < 50; ++i) {
    const double size = std::pow(10, random.uniform(-9, 0));
    EXPECT_LE(x.separation((g.n_W + random.vector(size)).normalized()), g.phi + rounding);
  }
  EXPECT_TRUE(curvature(g).allFinite());
}

struct Case {
  const char* name;
  Shape a, b;
  Mat3 R;  ///< of a in b's frame
  Vec3 p;  ///< a's origin in b's frame
  double phi;
  Vec3 p_B;  ///< the documented witness on b, in b's frame
};

void PrintTo(const Case& x, std::ostream* out) { *out << x.name; }

class Flat : public ::testing::TestWithParam<Case> {};

TEST_P(Flat, TakesTheDocumentedWitness) {
  const Case& x = GetParam();
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    // at the origin exactly flat; turned and moved, rounding tilts it, and it must stay sound
    const bool exact = k == 0;
    const Pose X_WB = exact ? Pose{} : random.pose(1);
    const Placed placed{x.a, x.b, X_WB * Pose{x.R, x.p}, X_WB};
    const Gap g = placed.gap();
    expect_sound(placed, g, random);
    EXPECT_NEAR(g.phi, x.phi, 8 * eps * placed.scale());
    // never two features of one direction that both are straight along
    EXPECT_LE(curvature(g).norm(), 20);
    if (exact) {
      EXPECT_LE((g.p_WB - x.p_B).norm(), 1e-14) << g.p_WB.transpose();
    }
    const Placed turned{x.b, x.a, placed.X_WB, placed.X_WA};
    const Gap h = turned.gap();
    expect_sound(turned, h, random);
    EXPECT_NEAR(h.phi, x.phi, 8 * eps * placed.scale());
  }
}

// Near touch, at touch and through it: the same as far off.
TEST_P(Flat, IsSoundAtAnyDistance) {
  const Case& x = GetParam();
  Random random(5);
  const Vec3 n = Placed{x.a, x.b, {x.R, x.p}, {}}.gap().n_W;
  for (const double phi :
       {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0, -1e-15, -1e-12, -1e-9, -1e-6, -1e-3}) {
    for (int k = 0; k < 10; ++k) {
      const Pose X_WB = k == 0 ? Pose{} : random.pose(1);
      const Placed placed{x.a, x.b, X_WB * Pose{x.R, x.p + (phi - x.phi) * n}, X_WB};
      const Gap g = placed.gap();
      expect_sound(placed, g, random);
      // through each other, edges come apart across a face rather than the way they came
      EXPECT_GE(g.phi, phi - 16 * eps * placed.scale());
      EXPECT_LE(g.phi, std::max(phi, 0.0) + 16 * eps * placed.scale());
    }
  }
}

// Tilts down to rounding: from flat to not flat without a jump of phi.
TEST_P(Flat, IsSoundWithAnyTilt) {
  const Case& x = GetParam();
  Random random(6);
  for (int k = 0; k < 300; ++k) {
    const double angle = std::pow(10, random.uniform(-17, -4));
    const Mat3 tilt = Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix();
    const Vec3 shift = random.chance(0.5) ? Vec3(Vec3::Zero()) : random.vector(angle);
    const Pose X_WB = random.chance(0.5) ? Pose{} : random.pose(1);
    const Placed placed{x.a, x.b, X_WB * Pose{tilt * x.R, x.p + shift}, X_WB};
    expect_sound(placed, placed.gap(), random);
  }
}

const Mat3 I = Mat3::Identity();
const Mat3 quarter = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix();
const Mat3 across = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()).toRotationMatrix();
const Mat3 eighth = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitZ()).toRotationMatrix();
const Box cube{Vec3(1, 1, 1)}, tile{Vec3(0.5, 0.25, 0.1)}, beam{Vec3(3, 0.2, 0.2)};
const Capsule rod{0.25, 1};
const Cylinder drum{1, 1}, coin{0.5, 0.1}, pipe{0.25, 2};

INSTANTIATE_TEST_SUITE_P(
    All, Flat,
    ::testing::Values(
        // a face within a face: its corner that is farthest from both middles
        Case{"tile_on_cube", tile, cube, I, {0.25, 0.5, 1.6}, 0.5, {0.75, 0.75, 1}},
        // corners of both are shared, and crossings
        Case{"cube_on_cube", cube, cube, I, {0.5, 0.25, 2.5}, 0.5, {-0.5, 1, 1}},
        Case{"beam_over_cube", beam, cube, I, {0.25, 0.25, 1.5}, 0.3, {-1, 0.45, 1}},
        // an edge on a face, the body on its edge
        Case{"edge_on_face",
             cube,
             Box{Vec3(2, 3, 1)},
             quarter * across * eighth,
             {0.25, 0.5, 3},
             2 - std::sqrt(2.0),
             {1.25, 0.5, 1}},
        // parallel edges, seen from both corners
        Case{"parallel_edges", cube, cube, I, {2.5, 0.25, 2.5}, std::sqrt(0.5), {1, 1, 1}},
        Case{"rod_on_cube", rod, cube, across, {0.5, 0.25, 1.5}, 0.25, {-0.5, 0.25, 1}},
        Case{"rod_by_edge", rod, cube, I, {2, 2, 0.5}, std::sqrt(2.0) - 0.25, {1, 1, 1}},
        Case{"rods", rod, rod, I, {1, 0, 0.5}, 0.5, {0.25, 0, -0.5}},
        Case{"rod_by_drum", rod, drum, I, {2, 0, 0.5}, 0.75, {1, 0, 1}},
        Case{"drums_abreast", drum, drum, I, {3, 0, 0.5}, 1, {1, 0, 1}},
        Case{"coin_on_cube", coin, cube, I, {0.25, 0.25, 1.5}, 0.4, {0.75, 0.25, 1}},
        Case{"coin_on_drum", coin, drum, I, {0.25, 0, 1.5}, 0.4, {0.75, 0, 1}},
        Case{"pipe_on_cube", pipe, cube, across, {0.5, 0.25, 1.5}, 0.25, {-1, 0.25, 1}},
        Case{"prism_on_cube",
             prism(4, 0.5, 0.25),
             cube,
             eighth,
             {0.5, 0.5, 1.5},
             0.25,
             {0.5 + std::sqrt(0.125), 0.5 + std::sqrt(0.125), 1}},
        Case{"prism_on_prism",
             prism(6, 0.5, 0.25),
             prism(6, 2, 0.25),
             I,
             {0.5, 0, 1},
             0.5,
             {1, 0, 0.25}},
        Case{"octahedron_on_point", octahedron(0.5), cube, I, {0.5, 0.25, 2}, 0.5, {0.5, 0.25, 1}}),
    [](const auto& x) { return x.param.name; });

struct OnPlane {
  const char* name;
  Shape a;
  Mat3 R;
  Vec3 witness;  ///< in a's frame
};

void PrintTo(const OnPlane& x, std::ostream* out) { *out << x.name; }

class Resting : public ::testing::TestWithParam<OnPlane> {};

TEST_P(Resting, TouchesWhereDocumented) {
  const OnPlane& x = GetParam();
  Random random(7);
  for (int k = 0; k < 20; ++k) {
    const Pose X_WB = k == 0 ? Pose{} : random.pose(1);
    const Placed placed{x.a, HalfSpace{}, X_WB * Pose{x.R, Vec3(1, 2, 3)}, X_WB};
    const Gap g = placed.gap();
    EXPECT_LE((placed.X_WA.inverse() * g.p_WA - x.witness).norm(), 1e-14) << k;
    EXPECT_NEAR(placed.separation(g.n_W), g.phi, 8 * eps * placed.scale());
    EXPECT_TRUE(curvature(g).allFinite());
    EXPECT_LE(curvature(g).norm(), 10);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Resting,
    ::testing::Values(OnPlane{"box_on_face", cube, I, Vec3(1, 1, -1)},
                      OnPlane{"box_on_edge", cube, quarter * across * eighth, Vec3(-1, -1, 1)},
                      OnPlane{"cylinder_upright", drum, I, Vec3(1, 0, -1)},
                      OnPlane{"cylinder_lying", drum, quarter, Vec3(0, -1, 1)},
                      OnPlane{"capsule_lying", rod, quarter, Vec3(0, -0.25, 1)},
                      OnPlane{"ellipsoid", Ellipsoid{Vec3(1, 2, 3)}, I, Vec3(0, 0, -3)}),
    [](const auto& x) { return x.param.name; });

// Needles and plates, 1 : 1000, in any position.
TEST(ThinBodies, AreAsAccurate) {
  Random random(8);
  const auto thin = [&](double& x) { x = random.chance(0.5) ? 1 : 1e-3; };
  for (int k = 0; k < 4000; ++k) {
    Vec3 s, t;
    for (int i = 0; i < 3; ++i) thin(s[i]), thin(t[i]);
    const auto shape = [&](const Vec3& r) -> Shape {
      switch (random.index(5)) {
        case 0:
          return Capsule{r[0], r[1]};
        case 1:
          return Box{r};
        case 2:
          return Cylinder{r[0], r[1]};
        case 3:
          return Ellipsoid{r};
        default:
          return testing_scene::random_convex(r, random);
      }
    };
    Placed x{shape(s),
             shape(t),
             {random.rotation(), random.vector(1)},
             {random.rotation(), Vec3::Zero()}};
    const Gap far = x.gap();  // every other one just touches
    if (k % 2 == 0) {
      const double phi = random.uniform(-1, 1) * std::pow(10, -4.0 - random.index(12));
      x = x.moved_by((phi - far.phi) * far.n_W);
    }
    SCOPED_TRACE(shape_name(x.a) + " " + shape_name(x.b) + " " + std::to_string(k));
    const Gap g = x.gap();
    const double rounding = 16 * eps * x.scale();
    EXPECT_LE((g.p_WA - g.p_WB - g.phi * g.n_W).norm(), rounding);
    EXPECT_NEAR(x.separation(g.n_W), g.phi, rounding);
    EXPECT_TRUE(curvature(g).allFinite());
    for (int i = 0; i < 100; ++i) {
      const double size = std::pow(10, random.uniform(-9, 0));
      EXPECT_LE(x.separation((g.n_W + random.vector(size)).normalized()), g.phi + rounding);
    }
  }
}

// Symmetric through and through: every direction, or many, are equally good.
TEST(Gaps, AreSoundWhereBodiesCoincide) {
  for (const auto& names : gap_table()) {
    SCOPED_TRACE(names.first + " " + names.second);
    for (unsigned seed = 1; seed <= 40; ++seed) {
      Random random(seed), same(seed), other(100);
      Placed x{testing_scene::random_shape(names.first, random),
               testing_scene::random_shape(names.second, same),
               {},
               {}};
      if (seed % 4 == 1) x.X_WA.p = 1e-16 * random.direction();
      if (seed % 4 == 2) x.X_WA.p = 1e-9 * random.direction();
      if (seed % 4 == 3) x.X_WA.p = 0.1 * Vec3::Unit(random.index(3));
      expect_sound(x, x.gap(), other);
    }
  }
}

// The same bits for the same input, and from the same shapes at other addresses.
TEST(Gaps, AreDeterministic) {
  for (const auto& names : gap_table()) {
    Random random(9), again(9);
    for (int k = 0; k < 50; ++k) {
      const Gap g = testing_scene::random_placed(names, random).gap();
      const Gap h = testing_scene::random_placed(names, again).gap();
      EXPECT_EQ(g.n_W, h.n_W);
      EXPECT_EQ(g.p_WB, h.p_WB);
    }
  }
}

}  // namespace
}  // namespace saltus
