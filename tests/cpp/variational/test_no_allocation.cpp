// A step after the first allocates nothing, impacts included.
#include <gtest/gtest.h>

#include <utility>

#include "count_allocations.hpp"
#include "kit/driven_arm.hpp"
#include "kit/scenes.hpp"
#include "saltus/model/close_loops.hpp"

namespace saltus {
namespace {

using scenes::cradle;
using test::allocations;

/// Allocations and impacts of 300 steps, once 60 have been made.
std::pair<long, int> count(const Model& model, State state, const StepOptions& options) {
  Stepper stepper(model, options);
  for (int k = 0; k < 60; ++k) stepper.step(state);
  const long before = allocations;
  int impacts = 0;
  for (int k = 0; k < 300; ++k) {
    stepper.step(state);
    impacts += static_cast<int>(stepper.report().impacts.size());
  }
  return {allocations - before, impacts};
}

TEST(Stepper, AStepAfterTheFirstAllocatesNothing) {
  const Model model = cradle({.balls = 5});
  const State start = model.state({{"swing_0", 0.3}, {"swing_1", 0.3}, {"sway_0", 0.05}});
  for (const ImpactLaw law : {ImpactLaw::nodal_energy, ImpactLaw::discrete_energy,
                              ImpactLaw::shadow_energy, ImpactLaw::compensated}) {
    const auto [allocated, impacts] = count(model, start, {.h = 0.01, .law = law});
    EXPECT_EQ(allocated, 0) << law_name(law);
    EXPECT_GT(impacts, 2);
  }
}

TEST(Stepper, ABallThatBouncesAndComesToRestAllocatesNothing) {
  const Model model = scenes::bouncing_ball({0.5, 0});
  const auto [allocated, impacts] = count(model, model.state({{"height", 1.1}}), {.h = 0.005});
  EXPECT_EQ(allocated, 0);
  EXPECT_GT(impacts, 2);
}

TEST(Stepper, ABallThatBouncesSlidesAndRollsAllocatesNothing) {
  const Model model = scenes::rolling_ball(0.1, {0.6, 0.3});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state({{"z", 0.3}}, {{"x", 1}, {"turn", -40}});
  stepper.step(state);
  const long before = allocations;
  for (int k = 0; k < 500; ++k) stepper.step(state);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(stepper.report().sustained, 1);
}

TEST(Stepper, ABoxThatSlidesToRestAllocatesNothing) {
  const Model model = scenes::boxes_on_slope(1, Vec3(0.2, 0.15, 0.1), 0.1, {0, 0.5});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state({}, {{model->velocity_names[0], 1}});
  for (int k = 0; k < 3; ++k) stepper.step(state);
  const long before = allocations;
  for (int k = 0; k < 300; ++k) stepper.step(state);
  EXPECT_EQ(allocations, before);
}

/// Crank, rod and a slider that a loop holds on its line, before a wall.
Model slider_crank() {
  ModelBuilder b("slider-crank");
  const auto add_rod = [&](const std::string& name, const std::string& on, double x) {
    b.add_link({name, {1, Vec3(0.5, 0, 0), Vec3(0, 0.1, 0.1).asDiagonal()}});
    b.add_joint({.name = name,
                 .parent = on,
                 .child = name,
                 .X_PJ = {Mat3::Identity(), Vec3(x, 0, 0)},
                 .axis = Vec3::UnitY()});
  };
  add_rod("crank", "world", 0);
  add_rod("rod", "crank", 0.3);
  b.add_shape("rod", Sphere{0.05}, {Mat3::Identity(), Vec3(1, 0, 0)});
  b.add_half_space("wall", -Vec3::UnitX(), -1.25);
  b.set_default_contact({0.8, 0.3});
  b.add_loop("guide", LoopType::on_plane, {"rod", {Mat3::Identity(), Vec3(1, 0, 0)}}, {"world"});
  return b.build();
}

TEST(Stepper, ALoopThatHitsAWallAllocatesNothing) {
  const Model model = slider_crank();
  const VecX q = close_loops(model, Eigen::Vector2d(1.8, -2.1), {0});
  const VecX v = consistent_velocity(model, q, Eigen::Vector2d(5, 0), {0});
  const auto [allocated, impacts] = count(model, model.state(q, v), {.h = 0.01});
  EXPECT_EQ(allocated, 0);
  EXPECT_GT(impacts, 1);
}

TEST(Stepper, ATowerThatStandsAllocatesNothing) {
  const Model model = scenes::boxes_on_slope(10, Vec3(0.2, 0.15, 0.1), 0, {0, 0.5});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state();
  for (int k = 0; k < 2; ++k) stepper.step(state);
  const long before = allocations;
  for (int k = 0; k < 100; ++k) stepper.step(state);
  EXPECT_EQ(allocations, before);
}

TEST(Stepper, ADrivenArmAtItsLimitsAllocatesNothing) {
  for (const double friction : {0.0, 0.5}) {
    const Model model = test::driven_arm(friction);
    Stepper stepper(model, {.h = 0.005});
    State state = model.state({{"shoulder", 0.9}}, {{"shoulder", 3}});
    ForceInput input;
    input.control = VecX::Constant(3, 0.4);
    input.qfrc = VecX::Constant(2, 0.1);
    input.wrenches.push_back({1, Vec3(0, 0, 0.2), Vec3(1, 0, -2), Vec3::Zero(), false});
    for (int k = 0; k < 60; ++k) stepper.step(state, input);
    const long before = allocations;
    for (int k = 0; k < 300; ++k) {
      input.control[0] = k % 100 < 50 ? 0.6 : -0.6;
      stepper.step(state, input);
    }
    EXPECT_EQ(allocations, before) << friction;
  }
}

}  // namespace
}  // namespace saltus
