// Driven steps: controls and forces in C++, limits and dry friction.
#include <gtest/gtest.h>

#include "kit/driven_arm.hpp"
#include "saltus/rollout/simulate.hpp"

namespace saltus {
namespace {

using test::driven_arm;

TEST(Driven, PoliciesDriveRuns) {
  const Model model = driven_arm(0);
  SimulateOptions options;
  options.step.h = 0.01;
  options.policy = [](const Moment& now, ForceInput& input) {
    input.control = VecX::Constant(3, 0.1 * now.state.t);
  };
  options.control_every = 5;
  const Trajectory run = simulate(model, model.state(), 0.2, options);
  EXPECT_EQ(run.control.rows(), 21);
  EXPECT_NEAR(run.control(7, 0), 0.1 * 0.05, 1e-15);  // asked at step 5
  EXPECT_NEAR(run.control(20, 0), 0.1 * 0.15, 1e-15);
  // the balance of energy: O(h^2) of the midpoint rule
  EXPECT_LE(run.energy_error(), 1e-2);
  const Trajectory constant = [&] {
    SimulateOptions same = options;
    same.policy = constant_control(VecX::Constant(3, 0.3));
    return simulate(model, model.state(), 0.2, same);
  }();
  EXPECT_EQ(constant.control.row(3), VecX::Constant(3, 0.3).transpose());
}

TEST(Driven, InputsThatDoNotFitAreNamed) {
  const Model model = driven_arm(0);
  Stepper stepper(model);
  State state = model.state();
  const State before = state;
  ForceInput input;
  input.control = VecX::Zero(2);
  EXPECT_THROW(stepper.step(state, input), ModelError);
  input.control = VecX::Constant(3, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(stepper.step(state, input), ModelError);
  input = {};
  input.wrenches.push_back({7});
  EXPECT_THROW(stepper.step(state, input), ModelError);
  EXPECT_EQ(state.q, before.q);
}

TEST(Driven, AFailedStepIsMadeAgainWithTheSameInput) {
  const Model model = driven_arm(0.5);
  Stepper a(model), b(model);
  State x = model.state({{"elbow", 0.95}}, {{"elbow", 8}}), y = x;
  ForceInput input;
  input.control = VecX::Constant(3, 0.9);
  a.step(x, input);
  EXPECT_THROW(b.step(y, ForceInput{VecX::Zero(1), {}, {}}), ModelError);
  b.step(y, input);
  EXPECT_EQ(x.q, y.q);
  EXPECT_EQ(x.p, y.p);
}

}  // namespace
}  // namespace saltus
