// Many steps in a row: what is recorded, where it stops, what is refused.
#include "saltus/rollout/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;

Model double_pendulum() {
  ModelBuilder b("double pendulum");
  for (int i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i);
    BodyInertia rod{1, Vec3(0, 0, -0.5), Vec3(1. / 12, 1. / 12, 1e-3).asDiagonal()};
    b.add_link({"rod_" + k, rod});
    b.add_joint({.name = "angle_" + k,
                 .parent = i == 0 ? "world" : "rod_0",
                 .child = "rod_" + k,
                 .X_PJ = {Mat3::Identity(), Vec3(0, 0, -i)},
                 .axis = Vec3::UnitY()});
  }
  return b.build();
}

TEST(Simulate, RecordsWhatTheStepperDoes) {
  const Model model = cradle({.balls = 3});
  const State start = model.state({{"swing_0", 0.3}});
  const Trajectory run = simulate(model, start, 1, {.h = 0.01});
  ASSERT_EQ(run.t.size(), 101);
  EXPECT_TRUE(run.complete);
  Stepper stepper(model, {.h = 0.01});
  State state = start;
  for (int k = 1; k <= 100; ++k) {
    state = stepper.advance(state);
    EXPECT_EQ(run.q.row(k).transpose(), state.q);
    EXPECT_EQ(run.p.row(k).transpose(), state.p);
    EXPECT_DOUBLE_EQ(run.t[k], 0.01 * k);
  }
  EXPECT_LT((run.v.row(100).transpose() - model.velocity(state)).norm(), 1e-14);
  EXPECT_NEAR(run.kinetic[100], model.kinetic_energy(state), 1e-15);
  EXPECT_DOUBLE_EQ(run.potential[100], model.potential_energy(state.q));
  ASSERT_EQ(run.impacts.size(), 1u);
  EXPECT_EQ(run.impacts[0].count, 2);
}

TEST(Simulate, RecordsEveryNthStepAndTheImpactsOfAll) {
  const Model model = cradle({.balls = 3});
  const State start = model.state({{"swing_0", 0.3}});
  const Trajectory all = simulate(model, start, 3, {.h = 0.01});
  const Trajectory tenth = simulate(model, start, 3, {.step = {.h = 0.01}, .record_every = 10});
  ASSERT_EQ(tenth.t.size(), 31);
  for (int k = 0; k <= 30; ++k) EXPECT_EQ(tenth.q.row(k), all.q.row(10 * k));
  ASSERT_EQ(tenth.impacts.size(), all.impacts.size());
  EXPECT_EQ(tenth.impacts.back().first, all.impacts.back().first);
}

TEST(Simulate, TheLastStepIsARowEvenWhereItIsNotTheNth) {
  const Model model = cradle({.balls = 2});
  const State start = model.state({{"swing_0", 0.3}});
  const Trajectory run = simulate(model, start, 1, {.step = {.h = 0.01}, .record_every = 7});
  ASSERT_EQ(run.t.size(), 16);
  EXPECT_DOUBLE_EQ(run.t[14], 0.98);
  EXPECT_DOUBLE_EQ(run.t[15], 1);
}

TEST(Simulate, TheShadowEnergyIsWhatAFixedStepConserves) {
  // Double pendulum at h = 0.01: H wanders by 1e-4 of the swing, the shadow by h^4.
  const Model model = double_pendulum();
  const auto spread = [&](double h) {
    const Trajectory run =
        simulate(model, model.state({{"angle_0", 1.5}, {"angle_1", -0.5}}), 10, {.h = h});
    const double scale = run.kinetic.maxCoeff();
    const VecX H = run.total();
    return std::pair{(H.maxCoeff() - H.minCoeff()) / scale,
                     (run.shadow.maxCoeff() - run.shadow.minCoeff()) / scale};
  };
  const auto [H, shadow] = spread(0.01);
  EXPECT_GT(H, 1e-5);
  EXPECT_LT(shadow, H / 100);
  const double order = std::log2(shadow / spread(0.005).second);
  EXPECT_NEAR(order, 4, 0.4);  // chaos shifts the extremes a little
}

TEST(Simulate, ProgressCanStopTheRunAndKeepsWhatIsDone) {
  const Model model = cradle({.balls = 3});
  double last = -1;
  int calls = 0;
  SimulateOptions options{.step = {.h = 1e-5}, .record_every = 1000};
  options.progress = [&](double done) {
    EXPECT_GE(done, last);
    last = done;
    return ++calls < 2;
  };
  const Trajectory run = simulate(model, model.state({{"swing_0", 0.3}}), 1000, options);
  EXPECT_FALSE(run.complete);
  EXPECT_EQ(calls, 2);
  EXPECT_GE(run.t.size(), 1);
  EXPECT_EQ(run.q.rows(), run.t.size());
}

TEST(Simulate, ControlsOfAWrongSizeAreNamed) {
  ModelBuilder builder(*double_pendulum()->description);
  const Model model = builder.add_motor("push", "angle_0").build();
  const Policy wrong = [](const Moment&, ForceInput& input) { input.control = VecX::Zero(3); };
  EXPECT_THROW(simulate(model, model.state(), .1, {.policy = wrong}), ModelError);
}

TEST(Simulate, BadDurationsAndStepsAreNamed) {
  const Model model = cradle({.balls = 2});
  const State start = model.state();
  const auto message = [&](double duration, double h) -> std::string {
    try {
      simulate(model, start, duration, {.h = h});
    } catch (const ModelError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message(1, 0).find("h = 0"), std::string::npos);
  EXPECT_NE(message(-1, 0.1).find("duration = -1"), std::string::npos);
  EXPECT_NE(message(std::nan(""), 0.1).find("duration = nan"), std::string::npos);
  EXPECT_NE(message(1e6, 1e-6).find("record_every"), std::string::npos) << message(1e6, 1e-6);
  EXPECT_NE(message(1, 0.3).find("the nearest is 0.9"), std::string::npos) << message(1, 0.3);
}

TEST(Simulate, OptionsOfTheStepAreUsedWhicheverWayTheyAreGiven) {
  const Model model = cradle({.balls = 3});
  const State start = model.state({{"swing_0", 0.3}});
  const StepOptions step{.h = 0.02, .law = ImpactLaw::discrete_energy, .max_halvings = 3};
  const Trajectory alone = simulate(model, start, 1, step);
  EXPECT_EQ(alone.options.h, 0.02);
  EXPECT_EQ(alone.options.law, ImpactLaw::discrete_energy);
  EXPECT_EQ(alone.options.max_halvings, 3);
  EXPECT_EQ(alone.impacts.size(), 1u);
  EXPECT_EQ(simulate(model, start, 1, {.step = step}).q, alone.q);
  const Trajectory through = simulate(model, start, 1, {.h = 0.02, .collisions = false});
  EXPECT_TRUE(through.impacts.empty());
  EXPECT_THROW(simulate(model, start, 1, {.h = 0.02, .max_impacts = 0}), ModelError);
}

}  // namespace
}  // namespace saltus
