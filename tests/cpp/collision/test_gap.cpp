// The contract of Gap, over every pair in the table: one test for all.
#include "saltus/collision/gap.hpp"

#include <gtest/gtest.h>

#include "collision/random_scene.hpp"

namespace saltus {
namespace {

using testing_scene::Random;
using testing_scene::random_shape;

using Names = std::pair<std::string, std::string>;

constexpr double eps = 2.3e-16;

// Signed functions that vanish on a shape's surface and are negative inside, written down anew: no
// distances off the surface.
double outside(const Sphere& s, const Vec3& p) { return p.norm() - s.radius; }
double outside(const HalfSpace&, const Vec3& p) { return p.z(); }
double outside(const Box& s, const Vec3& p) { return (p.cwiseAbs() - s.half).maxCoeff(); }
double outside(const Cylinder& s, const Vec3& p) {
  return std::max(std::hypot(p.x(), p.y()) - s.radius, std::abs(p.z()) - s.half_length);
}
double outside(const Capsule& s, const Vec3& p) {
  const double along = std::min(std::max(p.z(), -s.half_length), s.half_length);
  return (p - along * Vec3::UnitZ()).norm() - s.radius;
}
double outside(const Shape& shape, const Vec3& p) {
  return std::visit([&](const auto& s) { return outside(s, p); }, shape);
}

/// A point of the surface: from a point inside along any ray, by bisection.
Vec3 random_surface_point(const Shape& shape, Random& random) {
  if (std::holds_alternative<HalfSpace>(shape)) {
    return {random.uniform(-3, 3), random.uniform(-3, 3), 0};
  }
  const Vec3 from = 0.09 * random.direction(), ray = random.direction();
  double in = 0, out = 2;  // no random shape is larger
  for (int k = 0; k < 60; ++k) {
    const double middle = (in + out) / 2;
    (outside(shape, from + middle * ray) < 0 ? in : out) = middle;
  }
  return from + in * ray;
}

class AllPairs : public ::testing::TestWithParam<Names> {
 protected:
  Random random{7};

  struct Placed {
    Shape a, b;
    Pose X_WA, X_WB;
    Gap gap() const { return saltus::gap(a, X_WA, b, X_WB); }
    Gap moved_by(const Vec3& step) const {
      return saltus::gap(a, {X_WA.R, X_WA.p + step}, b, X_WB);
    }
    double scale() const { return 1 + X_WA.p.norm() + X_WB.p.norm(); }
  };

  /// a near b's surface, inside b, or far off; now and then all is far from the world's origin.
  Placed place() {
    Placed x{random_shape(GetParam().first, random),
             random_shape(GetParam().second, random),
             {},
             random.pose(random.chance(0.1) ? 1000 : 1)};
    x.X_WA = {random.rotation(), x.X_WB.p + random.vector(random.chance(0.2) ? 10 : 1)};
    return x;
  }
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
    // P is the centre of a and on the contact line
    EXPECT_EQ(g.center_W, x.X_WA.p);
    EXPECT_LE(g.n_W.cross(g.center_W - g.p_WA).norm(), rounding);
  }
}

TEST_P(AllPairs, NoPointOfTheSurfaceIsNearer) {
  for (int k = 0; k < 500; ++k) {
    const Placed x = place();
    const double d = x.gap().phi + std::get<Sphere>(x.a).radius;
    const Vec3 c_B = x.X_WB.inverse() * x.X_WA.p;
    const bool on_surface = std::abs(d) < 1e-12 * x.scale();  // rounding at 1 km
    EXPECT_TRUE(on_surface || (d < 0) == (outside(x.b, c_B) < 0));
    for (int point = 0; point < 20; ++point) {
      const Vec3 y = random_surface_point(x.b, random);
      EXPECT_LE(std::abs(d), (c_B - y).norm() + 1e-12 * x.scale());
    }
  }
}

TEST_P(AllPairs, ExchangeTurnsTheNormalRound) {
  for (int k = 0; k < 500; ++k) {
    const Placed x = place();
    const Gap g = x.gap(), h = gap(x.b, x.X_WB, x.a, x.X_WA);
    const double rounding = 64 * eps * x.scale();
    EXPECT_NEAR(g.phi, h.phi, rounding);
    // positions are rounded to `rounding`, a direction from b's centre or feature by that / length
    const double length = std::max(1e-3, std::abs(g.phi + std::get<Sphere>(x.a).radius));
    EXPECT_LE((g.n_W + h.n_W).norm(), rounding / length);
    EXPECT_LE((g.p_WA - h.p_WB).norm(), rounding / length);
    EXPECT_LE((g.p_WB - h.p_WA).norm(), rounding / length);
    EXPECT_LE((F_W(g) - F_W(h)).norm(), rounding / length * (1 + F_W(g).norm()));
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
    const double rounding = 1e-15 * x.scale();
    EXPECT_NEAR(g.phi, h.phi, rounding);
    const double curvature = 1 + F_W(g).norm();
    EXPECT_LE((X.R * g.n_W - h.n_W).norm(), rounding * curvature);
    EXPECT_LE((X * g.p_WB - h.p_WB).norm(), 2 * rounding * curvature);
    EXPECT_LE((X.R * F_W(g) * X.R.transpose() - F_W(h)).norm(),
              4 * rounding * curvature * curvature);
  }
}

// The certified advance along chords rests on this.
TEST_P(AllPairs, IsConvexInTheCentre) {
  for (int k = 0; k < 2000; ++k) {
    const Placed x = place();
    const Gap g = x.gap();
    const Vec3 step = random.vector(random.chance(0.5) ? 2 : 0.1);
    EXPECT_GE(x.moved_by(step).phi, g.phi + g.n_W.dot(step) - 16 * eps * x.scale());
    EXPECT_LE(std::abs(x.moved_by(step).phi - g.phi), step.norm() + 16 * eps * x.scale());
  }
}

TEST_P(AllPairs, NormalAndCurvatureAreTheDerivativesOfTheGap) {
  const double h = 1e-5;
  int used = 0;
  for (int k = 0; k < 500; ++k) {
    const Placed x = place();
    const Gap g = x.gap();
    Vec3 n;
    Mat3 F;
    double change = 0;  // of F over the stencil: large where it straddles two features
    for (int i = 0; i < 3; ++i) {
      const Gap up = x.moved_by(h * Vec3::Unit(i)), down = x.moved_by(-h * Vec3::Unit(i));
      n[i] = (up.phi - down.phi) / (2 * h);
      F.col(i) = (up.n_W - down.n_W) / (2 * h);
      change = std::max({change, (F_W(up) - F_W(g)).norm(), (F_W(g) - F_W(down)).norm()});
    }
    const double curvature = F_W(g).norm();
    if (x.scale() > 100 || curvature > 20 || change > 4 * h * (1 + curvature * curvature)) continue;
    ++used;
    // truncation h^2 F^2 of phi, h^2 F^3 of n; rounding of positions (1e-15 at 10 m) over h
    EXPECT_LE((n - g.n_W).norm(), 1e-9 * (1 + curvature * curvature));
    EXPECT_LE((F - F_W(g)).norm(), 1e-9 * (1 + curvature * curvature * curvature));
  }
  EXPECT_GT(used, 350);
}

INSTANTIATE_TEST_SUITE_P(Table, AllPairs, ::testing::ValuesIn(gap_table()),
                         [](const ::testing::TestParamInfo<Names>& names) {
                           return names.param.first + "_" + names.param.second;
                         });

TEST(GapTable, IsAsDocumented) {
  const std::vector<Names> expected = {{"sphere", "sphere"},
                                       {"sphere", "capsule"},
                                       {"sphere", "box"},
                                       {"sphere", "cylinder"},
                                       {"sphere", "half_space"}};
  EXPECT_EQ(gap_table(), expected);
}

TEST(GapTable, AgreesWithHasGapInBothOrders) {
  const std::vector<Shape> all = {Sphere{1}, Capsule{1, 1}, Box{Vec3::Ones()}, Cylinder{1, 1},
                                  HalfSpace{}};
  for (const Shape& a : all) {
    for (const Shape& b : all) {
      const bool one_is_sphere = shape_name(a) == "sphere" || shape_name(b) == "sphere";
      EXPECT_EQ(has_gap(a, b), one_is_sphere) << shape_name(a) << " " << shape_name(b);
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
