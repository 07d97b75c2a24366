// Cubic splines: knots, smoothness, ends, integral.
#include "saltus/lagrangian/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numeric.hpp"

namespace saltus {
namespace {

const std::vector<double> x{-1, -0.3, 0.1, 0.9, 2}, y{2, -1, 0.5, 0.7, -3};

TEST(Curve, GoesThroughItsKnotsAndIsTwiceDifferentiableThere) {
  for (const bool clamped : {false, true}) {
    const auto c = clamped ? make_curve(x, y, std::array{0.4, -2.0}) : make_curve(x, y);
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_NEAR(c(x[k]).f, y[k], 1e-14);
      const double h = 1e-9;
      EXPECT_NEAR(c(x[k] - h).slope, c(x[k] + h).slope, 1e-7) << k;
      const bool is_end = k == 0 || k + 1 == x.size();
      if (is_end && clamped) continue;
      EXPECT_NEAR(c(x[k] - h).second, c(x[k] + h).second, 1e-6) << k;
    }
    EXPECT_NEAR(c(-1).slope, clamped ? 0.4 : c(-3).slope, 1e-13);
    EXPECT_NEAR(c(2).slope, clamped ? -2 : c(5).slope, 1e-13);
    EXPECT_NEAR(c(5).f, y.back() + 3 * c.last_slope, 1e-13);
    EXPECT_NEAR(c(-3).f, y.front() - 2 * c.first_slope, 1e-13);
  }
}

TEST(Curve, DerivativesAndIntegralAreNumericOnes) {
  const Curve c = make_curve(x, y);
  EXPECT_EQ(c(-1).integral, 0);
  for (const double at : {-2.5, -0.8, -0.1, 0.5, 1.3, 1.95, 3.0}) {
    const double h = 0.01;  // within one piece, where differences of eighth order are exact
    EXPECT_NEAR(c(at).slope, test::derivative([&](double d) { return c(at + d).f; }, h), 1e-12);
    EXPECT_NEAR(c(at).second, test::derivative([&](double d) { return c(at + d).slope; }, h),
                1e-11);
    EXPECT_NEAR(c(at).f, test::derivative([&](double d) { return c(at + d).integral; }, h), 1e-12);
  }
}

/// A cubic polynomial with its own end slopes is itself.
TEST(Curve, IsExactForCubics) {
  const auto f = [](double s) { return 1 - 2 * s + 0.5 * s * s + 0.3 * s * s * s; };
  const auto slope = [](double s) { return -2 + s + 0.9 * s * s; };
  std::vector<double> values;
  for (const double each : x) values.push_back(f(each));
  const Curve c = make_curve(x, values, std::array{slope(-1), slope(2)});
  for (double s = -1; s < 2; s += 0.07) EXPECT_NEAR(c(s).f, f(s), 1e-14);
  const Curve line = make_curve({0, 2}, {1, 5});
  EXPECT_NEAR(line(7).f, 15, 1e-14);
  EXPECT_NEAR(line(2).integral, 6, 1e-14);
}

}  // namespace
}  // namespace saltus
