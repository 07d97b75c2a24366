// Functions of a turn against power series of matrices and numeric derivatives.
#include "saltus/spatial/rotation.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "kit/random_trees.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

using test::Random;

/// sum of [f]^k / (k + 1)!, or / k! for the exponential: thirty terms are exact up to |f| = 6.
Mat3 power_series(const Vec3& f, int shift) {
  Mat3 sum = Mat3::Zero(), power = Mat3::Identity();
  double factorial = 1;
  for (int k = 0; k < 60; ++k) {
    if (k > 0 || shift > 0) factorial *= k + shift > 0 ? k + shift : 1;
    sum += power / factorial;
    power = power * cross_matrix(f);
  }
  return sum;
}

/// Turns from 1e-12 rad, over the border between series and closed forms (0.3), to nearly 2 pi.
std::vector<Vec3> turns() {
  std::vector<Vec3> out;
  Random random(1);
  for (const double angle :
       {0.0, 1e-12, 1e-5, 1e-2, 0.1, 0.299, 0.301, 0.599, 0.601, 1.0, 3.0, 3.2, 6.2}) {
    for (int k = 0; k < 5; ++k) out.push_back(angle * random.unit());
  }
  return out;
}

TEST(Rotation, ExponentialIsThePowerSeries) {
  for (const Vec3& f : turns()) {
    const Quaternion q = quaternion_exp(f);
    EXPECT_NEAR(q.norm(), 1, 4e-16);
    // the series of a turn of 6 rad sums terms of 60: 1e-14
    EXPECT_LT((q.toRotationMatrix() - power_series(f, 0)).norm(), 2e-14) << f.norm();
  }
}

TEST(Rotation, LogarithmIsItsInverse) {
  for (const Vec3& f : turns()) {
    const Quaternion q = quaternion_exp(f);
    const Vec3 log = quaternion_log(q);
    EXPECT_LE(log.norm(), std::numbers::pi * (1 + 1e-15));
    // turns by more than pi come back the other way round
    const Vec3 same =
        f.norm() > std::numbers::pi ? Vec3(f * (1 - 2 * std::numbers::pi / f.norm())) : f;
    EXPECT_LT((log - same).norm(), 4e-15) << f.norm();
    EXPECT_EQ(quaternion_log(Quaternion(-q.coeffs())), log);
  }
}

TEST(Rotation, JacobianIsThePowerSeries) {
  for (const Vec3& f : turns()) {
    EXPECT_LT((left_jacobian(f) - power_series(f, 1)).norm(), 2e-14) << f.norm();
  }
}

// d exp(f) exp(f)^-1 = [J(f) df]
TEST(Rotation, JacobianIsTheDerivativeOfTheExponential) {
  for (const Vec3& f : turns()) {
    const Mat3 J = left_jacobian(f), inverse = power_series(-f, 0);
    for (int k = 0; k < 3; ++k) {
      const auto R = [&](double h) { return power_series(f + h * Vec3::Unit(k), 0); };
      // rounding of the series over the step
      EXPECT_LT((test::derivative(R) * inverse - cross_matrix(J.col(k))).norm(), 1e-11) << f.norm();
    }
  }
}

TEST(Rotation, DerivativeOfTheJacobian) {
  Random random(2);
  for (const Vec3& f : turns()) {
    const Vec3 x = random.vec3(3);
    const Mat3 D = left_jacobian_derivative(f, x);
    const auto J_x = [&](const VecX& g) { return VecX(power_series(g, 1) * x); };
    // beyond 0.3 the closed form of c' has lost eps / t^4; the numeric one eps / h
    EXPECT_LT((D - test::jacobian(J_x, f)).norm(), 2e-12) << f.norm();
  }
}

TEST(Rotation, ArcCoefficientsAreContinuousAndExact) {
  for (const Vec3& f : turns()) {
    const double t = f.norm();
    if (t < 0.1) continue;
    const ArcCoefficients k = arc_coefficients(f);
    EXPECT_NEAR(k.c1, (t / 2 / std::sin(t / 2) - 1) / t / t, 1e-15 + 1e-15 / t / t);
    // near its pole at 2 pi tan loses a digit
    EXPECT_NEAR(k.c2, std::tan(t / 4) / t, 1e-13 * (1 + k.c2));
  }
  EXPECT_EQ(arc_coefficients(Vec3::Zero()).c1, 1.0 / 24);
  EXPECT_EQ(arc_coefficients(Vec3::Zero()).c2, 0.25);
}

}  // namespace
}  // namespace saltus
