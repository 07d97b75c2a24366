// What each law conserves, how well, and a law of one's own.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;

/// Two pendulums of masses 1 and 2 that touch at rest.
Model unequal_pendulums() { return cradle({.balls = 2, .masses = {1, 2}, .sways = false}); }

struct Errors {
  double total = 0, shadow = 0;  ///< [J] the greatest there were
  double jump = 0;               ///< [J] root mean square of the shadow energy's at impacts
};

Errors errors_of(ImpactLaw law, double h, int impacts) {
  const Model model = unequal_pendulums();
  Stepper stepper(model, {.h = h, .law = law});
  State state = model.state({{"swing_0", 0.3}});
  const Energies start = energies(model, state, h);
  Energies before = start;
  Errors out;
  for (int count = 0; count < impacts;) {
    stepper.step(state);
    const Energies now = energies(model, state, h);
    const double total = now.kinetic + now.potential - start.kinetic - start.potential;
    out.total = std::max(out.total, std::abs(total));
    out.shadow = std::max(out.shadow, std::abs(now.shadow - start.shadow));
    if (!stepper.report().impacts.empty()) {
      ++count;
      out.jump += std::pow(now.shadow - before.shadow, 2) / impacts;
    }
    before = now;
  }
  out.jump = std::sqrt(out.jump);
  return out;
}

// The paper's law wanders, 1e-3 and more; nodal_energy stays in the band of H (kappa h^2 / 24).
TEST(Laws, LongRunsKeepTheEnergy) {
  const double h = 0.01;
  const int impacts = 2000;
  const Errors paper = errors_of(ImpactLaw::discrete_energy, h, impacts);
  const Errors nodal = errors_of(ImpactLaw::nodal_energy, h, impacts);
  const Errors shadow = errors_of(ImpactLaw::shadow_energy, h, impacts);
  const Errors compensated = errors_of(ImpactLaw::compensated, h, impacts);
  EXPECT_GT(paper.total, 5e-4);
  EXPECT_LT(nodal.total, 2e-6);
  EXPECT_LT(shadow.total, paper.total / 100);
  EXPECT_LT(compensated.total, paper.total / 500);
  EXPECT_LT(shadow.shadow, 1e-9);       // measured 2.6e-10: what smooth steps leave, O(h^4)
  EXPECT_LT(compensated.shadow, 1e-6);  // measured 4e-7: jumps of 3e-9, O(h^4), that add up
}

TEST(Laws, CompensatedImpactsAreOfFourthOrder) {
  const int impacts = 300;
  const double coarse = errors_of(ImpactLaw::compensated, 0.02, impacts).jump;
  const double fine = errors_of(ImpactLaw::compensated, 0.005, impacts).jump;
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4), 4, 0.4);
}

// Arms that hang on each other: Newton's matrix leaves kappa out, which costs few iterations.
TEST(Laws, CompensatedArcsOfADoublePendulumConvergeFast) {
  ModelBuilder b("double pendulum");
  for (int i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i);
    scenes::add_pendulum(b, {.link = "arm_" + k,
                             .joint = "turn_" + k,
                             .pivot = {Mat3::Identity(), Vec3(0, 0, -0.5 * i)},
                             .length = 0.5,
                             .parent = i == 0 ? "world" : "arm_0"});
  }
  b.add_half_space("left", Vec3::UnitX(), -0.2).add_half_space("right", -Vec3::UnitX(), -0.2);
  const Model model = b.build();
  const State start = model.state({}, {{"turn_0", 1.5}, {"turn_1", -1}});
  const Trajectory run = simulate(model, start, 20, {.h = 0.01, .law = ImpactLaw::compensated});
  EXPECT_GT(run.impacts.size(), 50u);
  EXPECT_LT(run.iterations, 6 * run.t.size());
  EXPECT_LT((run.shadow.array() - run.shadow[0]).abs().maxCoeff(), 1e-4);
}

// One free fall is a parabola, kappa = m g^2: all energies but the paper's differ by constants.
TEST(Laws, RestitutionTakesTheSameFromEachEnergy) {
  const Model model = scenes::bouncing_ball({0.8, 0});
  for (const ImpactLaw law :
       {ImpactLaw::nodal_energy, ImpactLaw::shadow_energy, ImpactLaw::compensated}) {
    const Trajectory run =
        simulate(model, model.state({{"height", 1.1}}), 1, {.h = 0.04, .law = law});
    ASSERT_EQ(run.impacts.size(), 1u);
    EXPECT_FALSE(run.impacts[0].fallback);
    const double fall = 9.81;  // [J] of 1 m
    EXPECT_NEAR(run.total()[run.t.size() - 1], 0.981 + 0.64 * fall, 1e-12) << law_name(law);
  }
}

// The emblem under every law: balls that should rest do, to the order of the law's own error.
TEST(Laws, BallsOfACradleRest) {
  const Model model = cradle({.balls = 3, .sways = false});
  for (const auto& [law, most] :
       {std::pair{ImpactLaw::nodal_energy, 1e-12}, std::pair{ImpactLaw::shadow_energy, 1e-4},
        std::pair{ImpactLaw::compensated, 1e-4}}) {
    const Trajectory run =
        simulate(model, model.state({{"swing_0", 0.3}}), 20, {.h = 0.01, .law = law});
    EXPECT_LT(run.q.col(1).cwiseAbs().maxCoeff(), most) << law_name(law);
    EXPECT_LT(run.energy_error(), 1e-5) << law_name(law);
  }
}

/// p+ of a head-on reflection, for one contact.
VecX reflect(const ImpactProblem& problem) {
  const VecX column = problem.M.llt().solve(problem.N.row(0).transpose());
  const double G = problem.N.row(0).dot(column);
  return problem.p - 2 * problem.u[0] / G * problem.N.row(0).transpose();
}

StepOptions with_law(ImpactFunction function) {
  StepOptions options{.h = 0.01};
  options.law = ImpactLaw::custom;
  options.custom = std::move(function);
  return options;
}

TEST(CustomLaw, AReflectionIsTheDefaultLaw) {
  const Model model = unequal_pendulums();
  Stepper own(model, with_law(reflect)), standard(model, {.h = 0.01});
  State a = model.state({{"swing_0", 0.3}}), b = a;
  int impacts = 0;
  for (int k = 0; k < 300; ++k) {
    own.step(a);
    standard.step(b);
    ASSERT_LT((a.q - b.q).norm() + (a.p - b.p).norm(), 1e-11) << k;
    ASSERT_EQ(own.report().impacts.size(), standard.report().impacts.size());
    for (std::size_t i = 0; i < own.report().impulses.size(); ++i, ++impacts) {
      EXPECT_EQ(own.report().impacts[i].law, ImpactLaw::custom);
      EXPECT_NEAR(own.report().impulses[i].lambda, standard.report().impulses[i].lambda, 1e-11);
    }
  }
  EXPECT_GT(impacts, 2);
}

TEST(CustomLaw, ABadAnswerIsRefusedAndTheStateKept) {
  const Model model = unequal_pendulums();
  const auto message = [&](ImpactFunction function) -> std::string {
    Stepper stepper(model, with_law(std::move(function)));
    State state = model.state({{"swing_0", 0.3}});
    try {
      for (int k = 0; k < 100; ++k) {
        const State before = state;
        try {
          stepper.step(state);
        } catch (...) {
          EXPECT_TRUE(state == before);
          throw;
        }
      }
    } catch (const StepError& error) {
      return error.what();
    }
    return "none";
  };
  const auto expect = [&](ImpactFunction function, const std::string& part) {
    const std::string text = message(std::move(function));
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect([](const ImpactProblem&) { return VecX::Zero(3).eval(); }, "returned 3 momenta");
  expect([](const ImpactProblem& x) { return (x.p * NAN).eval(); }, "not finite");
  expect([](const ImpactProblem& x) { return x.p; }, "leaves ball_0 ~ ball_1 approaching");
}

// An elastic contact that the law leaves closing by rounding rests; nothing settles.
TEST(CustomLaw, WhatIsLeftOfAnApproachIsRest) {
  const Model model = scenes::bouncing_ball();
  Stepper stepper(model, with_law([](const ImpactProblem& x) { return (1e-8 * x.p).eval(); }));
  State state = model.state({{"height", 0.2}});
  for (int k = 0; k < 100; ++k) {
    stepper.step(state);
    ASSERT_TRUE(stepper.report().settlings.empty()) << k;
  }
  EXPECT_NEAR(state.q[0], 0.1, 1e-9);
}

TEST(CustomLaw, OptionsThatContradictAreRefused) {
  const Model model = unequal_pendulums();
  StepOptions options{.law = ImpactLaw::custom};
  EXPECT_THROW(Stepper(model, options), ModelError);
  options = {};
  options.custom = reflect;
  EXPECT_THROW(Stepper(model, options), ModelError);
}

}  // namespace
}  // namespace saltus
