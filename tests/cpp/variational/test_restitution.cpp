// Impacts that lose energy: rebound, plastic, and the infinitely many bounces before rest.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::bouncing_ball;

constexpr double g = 9.81;

/// A pendulum that leans on a wall: at rest at the angle `lean` from the vertical.
Model leaning_pendulum(double restitution, double lean) {
  ModelBuilder b("pendulum");
  scenes::add_pendulum(b, {.link = "bob", .joint = "swing"});
  // the angle grows towards -x; the wall is in the way back to the vertical
  b.add_half_space("wall", Vec3(-1, 0, 0), std::sin(lean) - 0.05);
  b.set_default_contact({restitution, 0});
  return b.build();
}

/// When the first pair settles; NaN if none does within `duration`.
double settling_time(const Model& model, State state, double duration, double h) {
  Stepper stepper(model, {.h = h});
  while (state.t < duration) {
    stepper.step(state);
    if (!stepper.report().settlings.empty()) return stepper.report().settlings[0].t;
  }
  return NAN;
}

TEST(Restitution, AReboundHasThatPartOfTheRate) {
  for (const double e : {0.0, 0.3, 0.8, 1.0}) {
    const Model model = bouncing_ball({e, 0});
    Stepper stepper(model, {.h = 0.1});
    // without a height to fall from: hits at t = 0
    const State after = stepper.advance(model.state({{"height", 0.1}}, {{"height", -5}}));
    ASSERT_EQ(stepper.report().impacts.size(), 1u);
    EXPECT_NEAR(stepper.report().impulses[0].lambda, 5 * (1 + e), 1e-12);
    EXPECT_NEAR(after.p[0], e == 0 ? 0 : 5 * e - g * 0.1, 1e-12) << e;
  }
}

// A parabola is exact under the midpoint rule, so the sum of the bounces is, for any h.
TEST(Restitution, ABouncingBallComesToRestWhenItShould) {
  const Model model = bouncing_ball({0.5, 0});
  const double expected = 3 * std::sqrt(2 / g);
  EXPECT_NEAR(expected, 1.354571, 5e-7);
  for (const double h : {0.04, 0.01, 0.0025}) {
    const State start = model.state({{"height", 1.1}});
    EXPECT_NEAR(settling_time(model, start, 2, h), expected, 1e-9) << h;
    const Trajectory run = simulate(model, start, 10, {.h = h});
    for (Eigen::Index row = run.t.size() / 5; row < run.t.size(); ++row) {
      ASSERT_NEAR(run.q(row, 0), 0.1, 1e-12);
      ASSERT_NEAR(run.p(row, 0), 0, 1e-12);
    }
    EXPECT_LT(run.impacts.size(), 30u);
  }
}

// Bounces are many where e is near 1: each is an impact until the rest of them fits into a step.
TEST(Restitution, ALivelyBallComesToRestToo) {
  const Model model = bouncing_ball({0.95, 0});
  const double expected = std::sqrt(2 / g) * 1.95 / 0.05;
  EXPECT_NEAR(settling_time(model, model.state({{"height", 1.1}}), 20, 0.01), expected, 1e-8);
}

// The pendulum's swing is not exact: its times have the order of the midpoint rule.
TEST(Restitution, TimeOfRestConvergesWithOrderTwo) {
  const Model model = leaning_pendulum(0.5, 0.4);
  const State start = model.state({{"swing", 0.7}});
  const double best = settling_time(model, start, 20, 0.04 / 256);
  const double coarse = settling_time(model, start, 20, 0.04) - best;
  const double fine = settling_time(model, start, 20, 0.01) - best;
  ASSERT_TRUE(std::isfinite(best));
  EXPECT_NEAR(std::log(std::abs(coarse / fine)) / std::log(4), 2, 0.5);
}

TEST(Restitution, ACradleOfSteelEndsSwingingTogether) {
  const Model model = scenes::cradle({.balls = 3, .sways = false, .contact = {0.95, 0}});
  const Trajectory run = simulate(model, model.state({{"swing_0", 0.3}}), 300, {.h = 0.01});
  const Eigen::Index n = run.t.size();
  double apart = 0, swing = 0;
  for (Eigen::Index row = n - 500; row < n; ++row) {
    apart = std::max(apart, run.q.row(row).maxCoeff() - run.q.row(row).minCoeff());
    swing = std::max(swing, run.q.row(row).cwiseAbs().maxCoeff());
  }
  // momentum is conserved: the amplitude of three together is a third of that of one
  EXPECT_NEAR(swing, 0.1, 0.01);
  EXPECT_LT(apart, 1e-3);
  const VecX energy = run.total();
  for (Eigen::Index row = 1; row < n; ++row) {  // energy never grows, but for h^2's band
    ASSERT_LT(energy[row], energy[row - 1] + 1e-5);
  }
}

TEST(Restitution, PlasticBallsGoOnTogether) {
  const Model model = scenes::beads_in_line(3, 0.2, {0, 0});
  const Trajectory run = simulate(model, model.state({}, {{"x_0", 3}}), 1, {.h = 0.01});
  const Eigen::Index end = run.t.size() - 1;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(run.v(end, i), 1, 1e-12);
  EXPECT_EQ(run.impacts.size(), 2u);
}

}  // namespace
}  // namespace saltus
