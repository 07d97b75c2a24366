// The stepper: reference trajectories, impacts inside a step, what is conserved, what is refused.
#include "saltus/variational/stepper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "golden.hpp"
#include "kit/ask.hpp"
#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::beads_in_line;
using scenes::bouncing_ball;
using scenes::cradle;
using test::Golden;
using test::GoldenTrajectory;
using test::message_of;

void expect_golden(const Model& model, const GoldenTrajectory& golden) {
  Stepper stepper(model, {.h = golden.h});
  State state = golden.start;
  std::size_t next = 1;
  for (int k = 1; k <= golden.steps; ++k) {
    state = stepper.advance(state);
    if (next == golden.nodes.size() || golden.nodes[next].step != k) continue;
    const auto& node = golden.nodes[next++];
    // 200 steps of rounding, which the motion itself magnifies some hundred times
    EXPECT_LT((state.q - node.q).cwiseAbs().maxCoeff(), 1e-11) << "step " << k;
    EXPECT_LT((state.p - node.p).cwiseAbs().maxCoeff(), 1e-11) << "step " << k;
  }
  EXPECT_EQ(next, golden.nodes.size());
}

TEST(Stepper, TrajectoriesAgreeWithTheReferenceOf25Digits) {
  for (const Golden& golden : test::golden_systems()) {
    expect_golden(golden.model, golden.from_rest);
    expect_golden(golden.model, golden.from_state);
  }
}

TEST(Stepper, TwoImpactsInsideOneStepAreFoundAsTwo) {
  // No gravity: bead 0 meets bead 1 after 0.02 s, and bead 1 bead 2 after 0.06 s more.
  ModelBuilder b;
  b.set_gravity(Vec3::Zero());
  scenes::add_bead(b, "a", Vec3(0, 0, 0), Vec3::UnitX(), 1, 0.05);
  scenes::add_bead(b, "b", Vec3(0.12, 0, 0), Vec3::UnitX(), 1, 0.05);
  scenes::add_bead(b, "c", Vec3(0.28, 0, 0), Vec3::UnitX(), 1, 0.05);
  const Model model = b.build();
  Stepper stepper(model, {.h = 0.1});
  const State end = stepper.advance(model.state({}, {{"a", 1}}));
  const StepReport& report = stepper.report();
  ASSERT_EQ(report.impacts.size(), 2u);
  EXPECT_NEAR(report.impacts[0].t, 0.02, 1e-15);
  EXPECT_NEAR(report.impacts[1].t, 0.08, 1e-15);
  EXPECT_EQ(report.arcs, 3);
  EXPECT_NEAR(end.q[0], 0.02, 1e-15);
  EXPECT_NEAR(end.q[1], 0.06, 1e-15);
  EXPECT_NEAR(end.q[2], 0.02, 1e-15);
}

TEST(Stepper, ASmallFastSphereDoesNotPassThroughAThinOne) {
  for (const double offset : {0., 3e-4, 9e-4}) {
    ModelBuilder b;
    b.set_gravity(Vec3::Zero());
    scenes::add_bead(b, "bullet", Vec3(-0.5 - 1. / 3, offset, 0), Vec3::UnitX(), 1e-3, 5e-4);
    scenes::add_bead(b, "target", Vec3::Zero(), Vec3::UnitX(), 1, 5e-4);
    const Model model = b.build();
    Stepper stepper(model, {.h = 0.01});  // 10 m a step, against 1 mm
    stepper.advance(model.state({}, {{"bullet", 1000}}));
    EXPECT_EQ(stepper.report().impacts.size(), 1u) << "offset " << offset;
  }
}

TEST(Stepper, AnImpactAtTheVeryStartOrEndOfAStep) {
  const Model model = beads_in_line(2);
  Stepper stepper(model, {.h = 0.01});
  const State end = stepper.advance(model.state({}, {{"x_0", 1}}));  // touching, approaching
  ASSERT_EQ(stepper.report().impacts.size(), 1u);
  EXPECT_EQ(stepper.report().impacts[0].t, 0);
  EXPECT_NEAR(end.q[1], 0.01, 1e-16);
  State apart = model.state({{"x_0", -0.01}}, {{"x_0", 1}});
  apart = stepper.advance(apart);  // arrives when the step ends
  apart = stepper.advance(apart);
  EXPECT_NEAR(apart.q[0], 0, 1e-12);
  EXPECT_NEAR(apart.q[1], 0.01, 1e-12);
}

TEST(Stepper, TouchingBallsInLineComeOutSortedUnderBothLaws) {
  // Without gravity E_d is H, so that both laws are the reflections of the continuous problem.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> speed(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const int balls = 2 + trial % 7;
    const Model model = beads_in_line(balls);
    VecX v(balls);
    for (double& x : v) x = speed(random);
    int inversions = 0;
    for (int i = 0; i < balls; ++i) {
      for (int j = i + 1; j < balls; ++j) inversions += v[i] > v[j];
    }
    VecX sorted = v;
    std::sort(sorted.begin(), sorted.end());
    for (const ImpactLaw law : {ImpactLaw::nodal_energy, ImpactLaw::discrete_energy}) {
      Stepper stepper(model, {.h = 0.01, .law = law});
      const State end = stepper.advance(model.state(VecX::Zero(balls), v));
      EXPECT_LT((model.velocity(end) - sorted).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_EQ(stepper.report().impulses.size(), static_cast<std::size_t>(inversions));
      for (const Impact& impact : stepper.report().impacts) {
        EXPECT_EQ(impact.law, law);
        EXPECT_EQ(impact.t, 0);
      }
    }
  }
}

TEST(Stepper, ABallBouncesToItsHeightAndKeepsItsEnergy) {
  const Model model = bouncing_ball();
  const Trajectory run = simulate(model, model.state({{"height", 1.1}}), 100,
                                  {.step = {.h = 0.01}, .record_every = 1});
  // The midpoint rule is exact for free fall, so that only rounding is left: 110 bounces.
  EXPECT_LT(run.energy_error(), 1e-12);
  EXPECT_NEAR(run.impacts[0].t, std::sqrt(2 / 9.81), 1e-12);
  EXPECT_GT(run.impacts.size(), 100u);
  EXPECT_GE(run.q.minCoeff(), 0.1 - 1e-11);
}

TEST(Stepper, LowHopsWithinAStepAreAllFound) {
  const Model model = bouncing_ball();
  Stepper stepper(model, {.h = 0.01});
  // hops of 2 v / g = 2.04 ms: some five a step
  State state = model.state({{"height", 0.1}}, {{"height", 0.01}});
  int impacts = 0;
  for (int k = 0; k < 100; ++k) {
    state = stepper.advance(state);
    impacts += static_cast<int>(stepper.report().impacts.size());
  }
  EXPECT_EQ(impacts, static_cast<int>(1 / (2 * 0.01 / 9.81)));
  EXPECT_NEAR(0.5 * state.p[0] * state.p[0] + 9.81 * (state.q[0] - 0.1), 0.5e-4, 1e-12);
}

TEST(Stepper, ABallOnTheFloorStaysThere) {
  const Model model = bouncing_ball();
  Stepper stepper(model, {.h = 0.01});
  State state = model.state({{"height", 0.1}});
  for (int k = 0; k < 1000; ++k) state = stepper.advance(state);
  EXPECT_NEAR(state.q[0], 0.1, 1e-12);
  EXPECT_NEAR(state.p[0], 0, 1e-12);
  EXPECT_TRUE(stepper.report().impacts.empty());
  EXPECT_EQ(stepper.report().sustained, 1);
}

TEST(Stepper, MomentumOfASymmetryIsExact) {
  // Discs without gravity: the sum of p_x and of p_y is conserved through every collision. A wall
  // of none, so few impacts; three rows of head-on and oblique ones.
  const Model model = scenes::discs({Vec3(0, 0, 0), Vec3(1.2, 0.1, 0), Vec3(2.5, 0, 0)}, {1, 2, 3});
  State state = model.state({}, {{"x_0", 3}, {"y_1", 0.1}});
  Stepper stepper(model, {.h = 0.01});
  const auto total = [](const VecX& p, int axis) { return p[axis] + p[axis + 2] + p[axis + 4]; };
  const double x = total(state.p, 0), y = total(state.p, 1);
  int impacts = 0;
  for (int k = 0; k < 300; ++k) {
    state = stepper.advance(state);
    impacts += static_cast<int>(stepper.report().impacts.size());
  }
  EXPECT_GE(impacts, 2);
  EXPECT_NEAR(total(state.p, 0), x, 1e-14);
  EXPECT_NEAR(total(state.p, 1), y, 1e-14);
}

TEST(Stepper, AngularMomentumOfASpinningCradleIsExactOverAHundredThousandSteps) {
  // Two pendulums on a turntable about the vertical: its coordinate is cyclic, and the collisions
  // of the two bobs are internal.
  ModelBuilder b;
  b.add_link({"table", {1, Vec3::Zero(), Vec3(.1, .1, .2).asDiagonal()}});
  b.add_joint({.name = "turn",
               .type = JointType::continuous,
               .parent = "world",
               .child = "table",
               .axis = Vec3::UnitZ()});
  for (int i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i);
    scenes::add_pendulum(b, {.link = "bob_" + k,
                             .joint = "swing_" + k,
                             .pivot = {Mat3::Identity(), Vec3(0.2 * i - 0.1, 0, 0)},
                             .mass = 1. + i,
                             .parent = "table"});
  }
  const Model model = b.build();
  const State start = model.state({{"swing_0", 0.4}}, {{"turn", 1}});
  const Trajectory run = simulate(model, start, 1000, {.step = {.h = 0.01}, .record_every = 1000});
  EXPECT_GT(run.impacts.size(), 100u);
  const VecX p = run.p.col(model.coordinate("turn"));
  EXPECT_LT((p.array() - p[0]).abs().maxCoeff(), 1e-12 * std::abs(p[0]));
  EXPECT_LT(run.energy_error(), 1e-3);
}

TEST(Stepper, AFailedStepLeavesTheStateAsItWas) {
  const Model model = cradle({.balls = 3});
  Stepper stepper(model, {.h = 0.01, .max_iterations = 1});
  State state = model.state({{"swing_0", 2.5}}, {{"swing_0", 400}, {"sway_0", 300}});
  const State before = state;
  EXPECT_THROW(stepper.step(state), StepError);
  EXPECT_EQ(state, before);
  try {
    stepper.step(state);
  } catch (const StepError& e) {
    EXPECT_EQ(e.t, 0);
    EXPECT_GT(e.residual, 0);
    EXPECT_NE(std::string(e.what()).find("DEL residual"), std::string::npos);
  }
  EXPECT_EQ(state, before);
}

TEST(Stepper, BadStatesAndOptionsAreNamed) {
  const Model model = beads_in_line(3);
  Stepper stepper(model, {.h = 0.01});
  State state = model.state();
  State wrong = state;
  wrong.q.resize(2);
  EXPECT_EQ(message_of([&] { stepper.advance(wrong); }),
            "state.q has 2 entries; the model has 3 coordinates");
  wrong = state;
  wrong.p[1] = std::nan("");
  EXPECT_EQ(message_of([&] { stepper.advance(wrong); }), "state.p[1] = nan is not finite");
  const std::string overlap = message_of([&] { stepper.advance(model.state({{"x_0", 0.02}})); });
  EXPECT_NE(overlap.find("x_0 ~ x_1 by 0.02 m"), std::string::npos) << overlap;
  EXPECT_NE(message_of([&] { Stepper(model, {.h = -1}); }).find("h = -1"), std::string::npos);
  EXPECT_EQ(stepper.advance(state).q, state.q);  // still usable
}

TEST(Stepper, BouncingFasterThanTheBoundIsAStepErrorThatNamesThePair) {
  const Model model = bouncing_ball();
  Stepper stepper(model, {.h = 0.01, .max_impacts = 3});
  const State start = model.state({{"height", 0.1}}, {{"height", 0.005}});
  const std::string message = message_of<StepError>([&] { stepper.advance(start); });
  EXPECT_NE(message.find("more than 3 impacts"), std::string::npos) << message;
  EXPECT_NE(message.find("height ~ floor"), std::string::npos) << message;
}

TEST(Stepper, WithoutCollisionsBodiesPassThroughEachOther) {
  const Model model = beads_in_line(2);
  Stepper stepper(model, {.h = 0.5, .collisions = false});
  const State end = stepper.advance(model.state({}, {{"x_0", 1}}));
  EXPECT_NEAR(end.q[0], 0.5, 1e-15);
  EXPECT_EQ(end.q[1], 0);
}

}  // namespace
}  // namespace saltus
