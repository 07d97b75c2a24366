// One contact with friction by itself: W and u at random, and the law as friction.hpp and
// coulomb.hpp state it: compression, expansion by Poisson, friction by maximal dissipation in each.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "variational/law/coulomb.hpp"

namespace saltus {
namespace {

/// u in the range of W = R M^-1 R^T.
struct OneContact {
  Mat3 W;
  Vec3 u;
  double friction = 0, restitution = 0;
};

/// @param coordinates fewer than 3 make W singular; @param friction at most
OneContact random_contact(int coordinates, double friction, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  const MatX R = MatX::NullaryExpr(3, coordinates, [&] { return normal(random); });
  const VecX v = VecX::NullaryExpr(coordinates, [&] { return normal(random); });
  const VecX inverse =
      VecX::NullaryExpr(coordinates, [&] { return std::pow(10, 2 * unit(random) - 1); });
  OneContact c;
  c.W = R * inverse.asDiagonal() * R.transpose();
  c.u = R * v;
  if (c.u[0] > 0) c.u = -c.u;
  c.friction = friction * unit(random);
  c.restitution = unit(random);
  return c;
}

/// The largest rate there is: tolerances are parts of it.
double rate_scale(const OneContact& c, const Vec3& p) { return c.u.norm() + c.W.norm() * p.norm(); }

/// Rounding of sums of a few rates of this size, and of the roots that make them.
constexpr double rounding = 1e-13;

double energy_change(const Mat3& W, const Vec3& u, const Vec3& p) {
  return u.dot(p) + p.dot(W * p) / 2;
}

/// beta in its disc, and against what slides: of all in the disc it dissipates most.
void expect_coulomb(const Vec2& beta, const Vec2& slides, double radius, double scale) {
  EXPECT_LE(beta.norm(), radius * (1 + 1e-15));  // one norm and one product
  EXPECT_LE(radius * slides.norm() + beta.dot(slides), rounding * scale * radius);
}

TEST(OneContact, CompressionEndsTheApproachByCoulombsLaw) {
  std::mt19937 random(1);
  int sticks = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const OneContact c = random_contact(3 + trial % 4, trial % 3, random);
    const Vec3 p = stop_contact(c.W, c.u, c.friction), after = c.u + c.W * p;
    const double scale = rate_scale(c, p);
    EXPECT_GE(p[0], 0);
    EXPECT_NEAR(after[0], 0, rounding * scale) << trial;
    expect_coulomb(p.tail<2>(), after.tail<2>(), c.friction * p[0], scale);
    sticks += after.tail<2>().norm() < rounding * scale;
  }
  EXPECT_GT(sticks, 300);  // both kinds are there
  EXPECT_LT(sticks, 2700);
}

TEST(OneContact, ExpansionGivesThePartEOfTheNormalImpulse) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 3000; ++trial) {
    const OneContact c = random_contact(3 + trial % 4, trial % 3, random);
    const Vec3 first = stop_contact(c.W, c.u, c.friction);
    const Vec3 p = collide_contact(c.W, c.u, c.friction, c.restitution), more = p - first;
    const Vec3 after = c.u + c.W * p;
    EXPECT_NEAR(p[0], (1 + c.restitution) * first[0], 1e-15 * p[0]);  // one product, one sum
    const double radius = c.friction * c.restitution * first[0];
    // p - first rounds by 1e-16 of p, which a small e makes much of the radius
    EXPECT_LE(more.tail<2>().norm(), radius + 1e-15 * p.norm()) << trial;
    EXPECT_LE(radius * after.tail<2>().norm() + more.tail<2>().dot(after.tail<2>()),
              rounding * rate_scale(c, p) * p.norm())
        << trial;
  }
}

/// Also where W is singular, friction is large, and normal and tangents are coupled.
TEST(OneContact, NeitherPhaseGainsEnergy) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 4000; ++trial) {
    const OneContact c = random_contact(1 + trial % 5, trial % 4 * 3.0, random);
    const Vec3 first = stop_contact(c.W, c.u, c.friction);
    const Vec3 p = collide_contact(c.W, c.u, c.friction, c.restitution);
    const double tolerance = rounding * rate_scale(c, p) * p.norm();
    EXPECT_LE(energy_change(c.W, c.u, first), tolerance) << trial;
    EXPECT_LE(energy_change(c.W, c.u, p), tolerance) << trial;
  }
}

/// The friction impulse of the compression against others that the same normal impulse allows.
TEST(OneContact, NoOtherFrictionDissipatesMore) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const OneContact c = random_contact(3 + trial % 4, 1.5, random);
    const Vec3 p = stop_contact(c.W, c.u, c.friction);
    const double least = energy_change(c.W, c.u, p);
    for (int other = 0; other < 30; ++other) {
      const Vec2 any = Vec2(unit(random), unit(random));
      Vec3 q = p;
      q.tail<2>() = c.friction * p[0] * any / std::max(any.norm(), 1.0);
      EXPECT_GE(energy_change(c.W, c.u, q), least - rounding * rate_scale(c, p) * p.norm());
    }
  }
}

/// Newton's law of restitution holds where normal and tangents are not coupled, or nothing rubs.
TEST(OneContact, WithoutCouplingOrFrictionTheRateAfterIsNewtons) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    OneContact c = random_contact(3 + trial % 4, trial % 2 == 0 ? 0 : 1, random);
    if (trial % 2 == 1) c.W.block<2, 1>(1, 0).setZero(), c.W.block<1, 2>(0, 1).setZero();
    const Vec3 p = collide_contact(c.W, c.u, c.friction, c.restitution);
    EXPECT_NEAR((c.u + c.W * p)[0], -c.restitution * c.u[0], rounding * rate_scale(c, p)) << trial;
    if (trial % 2 == 0) {
      EXPECT_EQ(p.tail<2>(), Vec2::Zero());
    }
  }
}

/// Planar motion that slides the same way to the end: lambda = -u_n / (W_nn - mu W_nt s).
TEST(OneContact, SlidingInAPlaneHasItsClosedForm) {
  std::mt19937 random(6);
  int slides = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    OneContact c = random_contact(4, 0.5, random);
    c.W.row(2).setZero(), c.W.col(2).setZero(), c.u[2] = 0;
    const double sign = std::copysign(1.0, c.u[1]);
    const double lambda = -c.u[0] / (c.W(0, 0) - c.friction * c.W(0, 1) * sign);
    const Vec3 expected(lambda, -c.friction * lambda * sign, 0);
    if (lambda < 0 || (c.u + c.W * expected)[1] * sign < 0) continue;  // it stops, or turns
    const Vec3 p = stop_contact(c.W, c.u, c.friction);
    EXPECT_LE((p - expected).norm(), 1e-11 * expected.norm()) << trial;  // the divisor may be small
    ++slides;
  }
  EXPECT_GT(slides, 300);
}

TEST(OneContact, TangentsAndUnitsAreAConvention) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0, 6);
  for (int trial = 0; trial < 500; ++trial) {
    const OneContact c = random_contact(3 + trial % 4, 1, random);
    const Vec3 p = collide_contact(c.W, c.u, c.friction, c.restitution);
    Mat3 turn = Mat3::Identity();
    turn.bottomRightCorner<2, 2>() = Eigen::Rotation2Dd(angle(random)).toRotationMatrix();
    const double grams = 1000;
    const Mat3 W = turn * c.W * turn.transpose() / grams;
    const Vec3 turned = collide_contact(W, turn * c.u, c.friction, c.restitution);
    // rates round alike, impulses by the condition of W (1e3 and more) worse
    EXPECT_LE((W * (turned - grams * turn * p)).norm(), 1e-10 * rate_scale(c, p)) << trial;
  }
}

TEST(OneContact, WhatSeparatesTakesNoImpulse) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    OneContact c = random_contact(3, 1, random);
    c.u = -c.u;
    EXPECT_EQ(stop_contact(c.W, c.u, c.friction), Vec3::Zero());
    c.u[0] = 0;
    EXPECT_EQ(stop_contact(c.W, c.u, c.friction), Vec3::Zero());
  }
}

}  // namespace
}  // namespace saltus
