// Tops that fly and tops on a point: closed forms, conserved quantities, what a step refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"
#include "saltus/rollout/simulate.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus {
namespace {

using scenes::spinning;
using scenes::top;

// theory, O4: the band of a midpoint rule, and no trend in it.
TEST(FreeTop, KeepsEnergyInABandAndMomentaToTheLastBit) {
  const Model model = top();
  State state = spinning(model, Vec3(0.3, 5, -0.2), Vec3(1, -2, 0.5));
  const State start = state;
  const double H = model.kinetic_energy(state);
  Stepper stepper(model, {.h = 0.01});
  double band = 0, early = 0, late = 0;
  constexpr int steps = 100'000;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const double error = model.kinetic_energy(state) / H - 1;
    band = std::max(band, std::abs(error));
    (k < steps / 2 ? early : late) += error / (steps / 2);
  }
  EXPECT_EQ(state.p, start.p);
  EXPECT_LT(band, 7e-5);
  EXPECT_LT(std::abs(late - early), 1e-7);
  EXPECT_NEAR(state.q.tail<4>().norm(), 1, 1e-15);
}

/// Period of the flips of a body that spins about its middle axis: 4 K(m) / rate, by the Jacobi
/// elliptic functions of Euler's equations (moments A < B < C, energy E, momentum L).
double flip_period(const Vec3& I, const Vec3& w) {
  const double E2 = w.dot(I.cwiseProduct(w)), L2 = I.cwiseProduct(w).squaredNorm();
  const double A = I.x(), B = I.y(), C = I.z();
  // L2 > 2 E B: the vector circles axis C
  const bool about_C = L2 > E2 * B;
  const double rate = std::sqrt(about_C ? (C - B) * (L2 - E2 * A) / (A * B * C)
                                        : (B - A) * (E2 * C - L2) / (A * B * C));
  const double m = about_C ? (B - A) * (E2 * C - L2) / ((C - B) * (L2 - E2 * A))
                           : (C - B) * (L2 - E2 * A) / ((B - A) * (E2 * C - L2));
  return 4 * std::comp_ellint_1(std::sqrt(m)) / rate;
}

// A racket thrown about its middle axis flips at the period that Jacobi's functions give.
TEST(FreeTop, ARacketFlipsOnTime) {
  const Vec3 I(1, 2, 3), w(0.003, 3, 0.001);
  const Model model = top(I);
  State state = spinning(model, w);
  const double h = 0.002;
  Stepper stepper(model, {.h = h});
  std::vector<double> crossings;  // of the body's middle axis rate through 0
  double before = 0;
  while (crossings.size() < 5) {
    ASSERT_LT(state.t, 200);
    const Quaternion R(Eigen::Map<const Quaternion>(state.q.data() + 3));
    const double middle = (R.conjugate() * Vec3(state.p.tail<3>())).y() / I.y();
    if (before * middle < 0) {
      crossings.push_back(state.t - h * middle / (middle - before));
    }
    before = middle;
    stepper.step(state);
  }
  const double period = crossings[4] - crossings[2];
  // order 2: (h w)^2 = 4e-5 of the rate, and the logarithm of 1/0.001 in the period
  EXPECT_NEAR(period, flip_period(I, w), 1e-4 * period);
}

// Order 2: the end of a tumble against one with steps of 1/16.
TEST(FreeTop, ConvergesWithOrderTwo) {
  const Model model = top();
  const auto end = [&](double h) {
    State state = spinning(model, Vec3(0.3, 5, -0.2));
    Stepper stepper(model, {.h = h});
    for (int k = 0; k < std::lround(2 / h); ++k) stepper.step(state);
    return state;
  };
  const State exact = end(0.00125 / 4);
  const double coarse = model.difference(exact.q, end(0.01).q).norm();
  const double fine = model.difference(exact.q, end(0.005).q).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.02);
}

/// A symmetric top on a ball, its centre of mass 0.1 m up its axis.
Model heavy_top(double m, double l, double A, double C) {
  BodyInertia body{m, Vec3(0, 0, l), Mat3::Zero()};
  body.I_J.diagonal() << A - m * l * l, A - m * l * l, C;
  ModelBuilder b("heavy_top");
  b.add_link({"top", body});
  b.add_joint({.name = "tip", .type = JointType::spherical, .parent = "world", .child = "top"});
  return b.build();
}

// Steady precession at tilt theta: C w3 O - (A - C... ) the two roots of
// (A - C) cos(theta) O^2 - C s O + m g l = 0 with s the spin relative to the precessing frame.
TEST(HeavyTop, PrecessesSteadily) {
  const double m = 1, l = 0.1, A = 0.02, C = 0.002, theta = 1.0, spin = 150, g = 9.81;
  const double a = (A - C) * std::cos(theta), b = -C * spin, c = m * g * l;
  const double O = (-b - std::sqrt(b * b - 4 * a * c)) / (2 * a);  // the slow one
  const Model model = heavy_top(m, l, A, C);
  const Quaternion tilt(Eigen::AngleAxisd(theta, Vec3::UnitY()));
  VecX q = tilt.coeffs();
  const Vec3 w = O * Vec3::UnitZ() + spin * (tilt * Vec3::UnitZ());
  State state = model.state(q, w);
  const double vertical = state.p.z(), h = 5e-4;
  Stepper stepper(model, {.h = h});
  constexpr int steps = 4000;
  double azimuth = 0, before = 0, worst = 0;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const Vec3 axis = Eigen::Map<const Quaternion>(state.q.data()) * Vec3::UnitZ();
    const double now = std::atan2(axis.y(), axis.x());
    azimuth += std::remainder(now - before, 2 * M_PI);
    before = now;
    worst = std::max(worst, std::abs(std::acos(axis.z()) - theta));
  }
  // steps of h w = 0.075 rad: errors of its square over 12
  EXPECT_NEAR(azimuth / (steps * h), O, 1e-3 * O);
  EXPECT_LT(worst, 2e-3);
  EXPECT_NEAR(state.p.z(), vertical, 1e-13);  // gravity's torque has no vertical part
}

// A wheel on the end of a level axle, at the attitude where yaw and roll would be one: it goes
// round at m g l / (C spin), and the axle stays level but for the nutation that keeps C spin.
TEST(HeavyTop, AGyroscopeWithALevelAxlePrecesses) {
  const double m = 1, l = 0.1, A = 0.02, C = 0.004, spin = 300, g = 9.81, h = 2e-4;
  const double O = m * g * l / (C * spin);
  const Model model = heavy_top(m, l, A, C);
  const Quaternion level(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitY()));  // the axle is x
  State state = model.state(VecX(level.coeffs()), VecX(Vec3(spin, 0, O)));
  Stepper stepper(model, {.h = h});
  constexpr int steps = 10'000;
  double azimuth = 0, before = 0, dip = 0;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const Vec3 axle = Eigen::Map<const Quaternion>(state.q.data()) * Vec3::UnitZ();
    const double now = std::atan2(axle.y(), axle.x());
    azimuth += std::remainder(now - before, 2 * M_PI);
    before = now;
    dip = std::max(dip, std::abs(axle.z()));
  }
  EXPECT_NEAR(azimuth / (steps * h), O, 1e-3 * O);  // steps of h w = 0.06 rad: its square over 12
  EXPECT_LT(dip, 1e-3);
}

// A coin that is tossed with little tilt wobbles twice as fast as it spins: its axis goes round at
// L / A, and the angle to L stays.
TEST(FreeTop, ACoinWobblesTwiceAsFastAsItSpins) {
  const Model coin = top(Vec3(1, 1, 2));
  const double tilt = 0.05, spin = 10, h = 1e-3;
  const Vec3 w(0, spin * std::sin(tilt), spin * std::cos(tilt));  // about the axis and across it
  State state = spinning(coin, w, Vec3(0.5, 0, 3));
  const Vec3 L = state.p.tail<3>();
  Stepper stepper(coin, {.h = h});
  const auto across = [&](const State& x) {  // the axis, less its part along L
    const Vec3 axis = Eigen::Map<const Quaternion>(x.q.data() + 3) * Vec3::UnitZ();
    return Vec3(axis - axis.dot(L) / L.squaredNorm() * L);
  };
  const double width = across(state).norm();
  Vec3 before = across(state);
  double wobbled = 0, drift = 0;
  constexpr int steps = 5000;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const Vec3 now = across(state);
    wobbled += std::atan2(L.normalized().dot(before.cross(now)), before.dot(now));
    drift = std::max(drift, std::abs(now.norm() - width));
    before = now;
  }
  EXPECT_NEAR(wobbled / (steps * h), L.norm() / 1.0, 1e-4 * L.norm());  // (h w)^2 / 12 = 1e-5
  EXPECT_NEAR(wobbled / (steps * h) / (2 * spin), 1, 0.01);
  EXPECT_LT(drift, 1e-6);
}

TEST(HeavyTop, KeepsEnergyInABandOverAHundredThousandSteps) {
  const Model model = heavy_top(1, 0.1, 0.02, 0.004);
  const Quaternion tilt(Eigen::AngleAxisd(0.5, Vec3::UnitX()));
  State state = model.state(VecX(tilt.coeffs()), VecX(tilt * Vec3(0, 0, 30)));
  const double H = model.kinetic_energy(state) + model.potential_energy(state.q);
  const double vertical = state.p.z(), T = model.kinetic_energy(state);
  Stepper stepper(model, {.h = 0.01});
  double band = 0, early = 0, late = 0;
  constexpr int steps = 100'000;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const double now = model.kinetic_energy(state) + model.potential_energy(state.q);
    band = std::max(band, std::abs(now - H) / T);
    (k < steps / 2 ? early : late) += (now - H) / T / (steps / 2);
  }
  EXPECT_LT(band, 1e-2);                    // h w = 0.3 rad a step: (h w)^2 / 12
  EXPECT_LT(std::abs(late - early), 1e-5);  // no trend
  EXPECT_NEAR(state.p.z(), vertical, 1e-12);
}

// What one arc cannot follow is refused in words, and the state stays as it was.
TEST(FreeTop, TurnsOfAWholeTurnAnArcAreToldByName) {
  const Model model = top(Vec3(1, 1, 1));
  State state = spinning(model, Vec3(0, 0, 650));
  const State before = state;
  Stepper stepper(model, {.h = 0.01, .max_halvings = 0});
  try {
    stepper.step(state);
    FAIL() << "turned by 6.5 rad in an arc";
  } catch (const StepError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("joint \"base\" turns by 6.5 rad"), std::string::npos) << text;
  }
  EXPECT_EQ(state, before);
  State fine = spinning(model, Vec3(0, 0, 600));  // 6 rad a step is less than a turn
  EXPECT_NO_THROW(stepper.step(fine));
  Stepper in_halves(model, {.h = 0.01});
  EXPECT_NO_THROW(in_halves.step(state));
  ASSERT_EQ(in_halves.report().fallbacks.size(), 1u);
  EXPECT_EQ(in_halves.report().fallbacks[0].tau, 0.005);
}

TEST(FreeTop, TumblesByMoreThanARadianAStep) {
  const Model model = top();
  State state = spinning(model, Vec3(100, 120, -60));  // 1.7 rad a step
  const double H = model.kinetic_energy(state);
  Stepper stepper(model, {.h = 0.01});
  for (int k = 0; k < 5000; ++k) {
    stepper.step(state);
    ASSERT_LT(std::abs(model.kinetic_energy(state) / H - 1), 0.1) << k;  // theory, O3: 2.5e-2
  }
}

TEST(Compensated, IsRefusedWhereThereAreBalls) {
  try {
    Stepper(top(), {.law = ImpactLaw::compensated});
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.name, "base");
  }
}

TEST(Quaternions, AreCheckedAndNormalised) {
  const Model model = top();
  VecX q = model.neutral();
  q[6] = 1 + 5e-7;
  EXPECT_NEAR(model.state(q, VecX::Zero(6)).q[6], 1, 1e-15);
  q[6] = 0.9;
  EXPECT_THROW(model.state(q, VecX::Zero(6)), ModelError);
  q[6] = 0;
  EXPECT_THROW(model.normalized(q), ModelError);
  EXPECT_THROW(model.state({{"base_qw", 0.5}}, {}), ModelError);
  State unnormalised = model.state();
  unnormalised.q[3] = 2;
  Stepper stepper(model);
  EXPECT_THROW(stepper.step(unnormalised), ModelError);
}

}  // namespace
}  // namespace saltus
