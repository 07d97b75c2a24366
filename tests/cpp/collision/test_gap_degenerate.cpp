// Where the nearest feature is not unique, or the centre is on it: a documented choice, never NaN.
#include <gtest/gtest.h>

#include "collision/random_scene.hpp"

namespace saltus {
namespace {

using testing_scene::Random;

constexpr double eps = 2.3e-16;

struct Case {
  const char* name;
  Shape b;
  Vec3 c;    ///< centre of a in b's frame
  double d;  ///< its distance from b
  Vec3 n;    ///< the documented choice
  double F;  ///< norm of the curvature
};

void PrintTo(const Case& x, std::ostream* out) { *out << x.name; }

class Degenerate : public ::testing::TestWithParam<Case> {};

TEST_P(Degenerate, TakesTheDocumentedChoice) {
  const Case& x = GetParam();
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    // at the origin exactly degenerate; turned and moved it may fall to any neighbour's side, but
    // must stay sound
    const bool exact = k == 0;
    const Pose X_WB = exact ? Pose{} : random.pose(1);
    const Gap g = gap(Sphere{0.25}, {Mat3::Identity(), X_WB * x.c}, x.b, X_WB);
    EXPECT_NEAR(g.phi, x.d - 0.25, 8 * eps * (1 + x.c.norm()));
    EXPECT_NEAR(g.n_W.norm(), 1, 8 * eps);
    EXPECT_TRUE(F_W(g).allFinite());
    EXPECT_LE((g.p_WA - g.p_WB - g.phi * g.n_W).norm(), 16 * eps);
    if (!exact) continue;
    EXPECT_LE((g.n_W - x.n).norm(), 4 * eps) << g.n_W.transpose();
    EXPECT_NEAR(F_W(g).norm(), x.F, 4 * eps * x.F);
  }
}

const Vec3 X = Vec3::UnitX(), Y = Vec3::UnitY(), Z = Vec3::UnitZ(), O = Vec3::Zero();
const Box cube{Vec3(1, 1, 1)};
const Cylinder drum{1, 1}, pole{1, 3};

INSTANTIATE_TEST_SUITE_P(
    All, Degenerate,
    ::testing::Values(
        Case{"centres_coincide", Sphere{0.5}, O, -0.5, Z, 0},
        Case{"capsule_middle", Capsule{0.5, 1}, O, -0.5, X, 0},
        Case{"capsule_on_segment", Capsule{0.5, 1}, 0.7 * Z, -0.5, X, 0},
        Case{"capsule_end", Capsule{0.5, 1}, Z, -0.5, X, 0},
        Case{"capsule_without_length", Capsule{0.5, 0}, O, -0.5, X, 0},
        // over the end of the segment: of side and cap, the side
        Case{"capsule_side_or_cap", Capsule{0.5, 1}, Vec3(2, 0, 1), 1.5, X, 0.5},
        Case{"box_centre", cube, O, -1, X, 0},
        Case{"box_diagonal", cube, Vec3(-0.5, -0.5, 0.5), -0.5, -X, 0},
        Case{"box_two_faces", cube, Vec3(0.1, -0.5, 0.5), -0.5, -Y, 0},
        Case{"box_on_face", cube, Vec3(0.2, 0.3, -1), 0, -Z, 0},
        Case{"box_on_edge", cube, Vec3(0, 1, -1), 0, Y, 0},
        Case{"box_on_corner", cube, Vec3(-1, -1, -1), 0, -X, 0},
        Case{"box_face_or_edge", cube, Vec3(1, 2, 0), 1, Y, 0},
        Case{"drum_centre", drum, O, -1, Z, 0},
        Case{"drum_cap_or_side", drum, Vec3(0.5, 0, -0.5), -0.5, -Z, 0},
        Case{"pole_axis", pole, O, -1, X, 0}, Case{"pole_axis_by_cap", pole, -2.5 * Z, -0.5, -Z, 0},
        Case{"drum_on_rim", drum, Vec3(0, 1, 1), 0, Z, 0},
        Case{"drum_over_rim", drum, Vec3(0, 1, 2), 1, Z, 0},
        Case{"drum_beside_rim", drum, Vec3(0, 2, 1), 1, Y, 0.5},
        // by its first shortest axis; F = k/(1 + k d), k = 1/4 and 1/9 there
        Case{"ellipsoid_centre", Ellipsoid{Vec3(1, 2, 3)}, O, -1, X, std::hypot(1.0 / 3, 1.0 / 8)},
        Case{"ellipsoid_pole", Ellipsoid{Vec3(1, 2, 3)}, 3 * Z, 0, Z, std::hypot(3.0, 0.75)},
        Case{"half_space_face", HalfSpace{}, Vec3(1, 2, 0), 0, Z, 0},
        Case{"half_space_deep", HalfSpace{}, Vec3(1, 2, -5), -5, Z, 0}),
    [](const auto& x) { return x.param.name; });

// The squares of such offsets have few digits or none.
TEST(NearlyDegenerate, TinyOffsetsAreSound) {
  const Convex tetrahedron = test::hull_of({O, X, Y, Z});
  const std::vector<Shape> shapes = {Sphere{1},
                                     Capsule{1, 1},
                                     cube,
                                     drum,
                                     pole,
                                     Ellipsoid{Vec3(1, 1, 1)},
                                     Ellipsoid{Vec3(1, 1, 2)},
                                     Ellipsoid{Vec3(2, 3, 1)},
                                     tetrahedron};
  const std::vector<Vec3> places = {
      O, Z, Vec3(1, 1, 1), Vec3(0, 1, 1), Vec3(0, 1, 3), Vec3(0, 0, -1)};
  Random random(4);
  for (const double size : {1e-300, 1e-170, 1e-161, 1e-155, 1e-139, 1e-100, 1e-20, 5e-324}) {
    for (const Shape& shape : shapes) {
      for (const Vec3& place : places) {
        const Vec3 c = place + size * random.direction();
        const Gap g = gap(Sphere{0.25}, {Mat3::Identity(), c}, shape, {});
        EXPECT_NEAR(g.n_W.norm(), 1, 8 * eps) << shape_name(shape) << " " << c.transpose();
        EXPECT_TRUE(F_W(g).allFinite());
        EXPECT_LE((g.p_WA - g.p_WB - g.phi * g.n_W).norm(), 16 * eps);
      }
    }
  }
}

TEST(NearlyDegenerate, IsDeterministic) {
  for (const Shape& shape : {Shape(Sphere{1}), Shape(Capsule{1, 1}), Shape(cube), Shape(drum)}) {
    const Gap g = gap(Sphere{0.25}, {}, shape, {}), h = gap(Sphere{0.25}, {}, shape, {});
    EXPECT_EQ(g.n_W, h.n_W);
    EXPECT_EQ(g.p_WB, h.p_WB);
  }
}

// F of the rim, by hand: at 45 degrees, d = sqrt(2) from the rim of a drum of radius 1, rho = 2.
TEST(Curvature, OfARim) {
  const Gap g = gap(Sphere{0.25}, {Mat3::Identity(), Vec3(2, 0, 2)}, drum, {});
  const double d = std::sqrt(2.0);
  EXPECT_NEAR(F_W(g)(1, 1), 1 / (2 * d), 4 * eps);  // n.w / rho
  const Vec3 m(1 / d, 0, -1 / d);
  EXPECT_NEAR(m.dot(F_W(g) * m), 1 / d, 4 * eps);
  EXPECT_NEAR((F_W(g) * g.n_W).norm(), 0, 4 * eps);
}

}  // namespace
}  // namespace saltus
