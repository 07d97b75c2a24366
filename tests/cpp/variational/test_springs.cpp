// Springs between points, dampers, compensation and functions in steps.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "kit/builders.hpp"
#include "saltus/model/check_derivatives.hpp"
#include "saltus/rollout/simulate.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus::test {
inline std::atomic<long> allocations{0};  // counted by count_allocations.hpp in test_no_allocation
}

namespace saltus {
namespace {

/// A free box on a spring and a damper, off its centre, and an arm of two joints that another ties
/// to it.
ModelBuilder sprung(double length, double damping) {
  ModelBuilder b("sprung");
  b.add_body({.name = "box", .shape = Box{{0.1, 0.2, 0.3}}, .mass = 2});
  b.add_link({"upper", {1, Vec3(0, 0, -0.25), Mat3(Vec3(0.02, 0.02, 0.001).asDiagonal())}});
  b.add_link({"lower", {0.5, Vec3(0, 0, -0.2), Mat3(Vec3(0.01, 0.01, 0.001).asDiagonal())}});
  JointSpec hip{"hip", JointType::revolute, "world", "upper"};
  hip.X_PJ.p = Vec3(1, 0, 1);
  hip.axis = Vec3::UnitY();
  JointSpec knee{"knee", JointType::revolute, "upper", "lower"};
  knee.X_PJ.p = Vec3(0, 0, -0.5);
  knee.axis = Vec3(1, 1, 0);
  b.add_joint(hip).add_joint(knee);
  b.add_spring({"rope", point_on("box", Vec3(0.1, 0.2, 0.3)), point_on("world", Vec3(0, 0, 2)), 60,
                length, damping});
  b.add_spring({"tie", point_on("lower", Vec3(0, 0, -0.4)), point_on("box", Vec3::Zero()), 30,
                length, damping});
  return b;
}

State start(const Model& model) {
  VecX v = VecX::LinSpaced(model.n_v(), -0.5, 1.0);
  return model.state(model.neutral(), v);
}

State after(const Model& model, double h, double duration, Stepper* reported = nullptr) {
  Stepper own(model, {.h = h});
  Stepper& stepper = reported != nullptr ? *reported : own;
  State state = start(model);
  for (int k = 0; k < std::lround(duration / h); ++k) stepper.step(state);
  return state;
}

TEST(Springs, StepsAreOfSecondOrder) {
  for (const double length : {0.0, 0.4}) {
    const Model model = sprung(length, 3).build();
    const State exact = after(model, 1.0 / 3200, 0.5);
    double before = 0;
    for (const double h : {0.01, 0.005, 0.0025}) {
      const State state = after(model, h, 0.5);
      const double error = model.difference(exact.q, state.q).norm();
      if (before > 0) {
        EXPECT_NEAR(before / error, 4, 0.5) << h;
      }
      before = error;
    }
  }
}

TEST(Springs, EnergyIsKeptAndTheDampersWorkIsWhatIsLost) {
  for (const double damping : {0.0, 2.0}) {
    const Model model = sprung(0.4, damping).build();
    const auto error = [&](double h) {
      SimulateOptions options;
      options.step.h = h;
      const Trajectory run = simulate(model, start(model), 2.0, options);
      if (damping > 0) {
        EXPECT_LT(run.work(run.work.rows() - 1, 0), -0.1);
      }
      return run.energy_error();
    };
    const double coarse = error(0.01), fine = error(0.005);
    EXPECT_LT(coarse, 2e-2);
    EXPECT_NEAR(coarse / fine, 4, 1) << damping;
  }
}

/// Without gravity and with a spring between two free bodies, momentum is kept to rounding.
TEST(Springs, MomentumIsKept) {
  ModelBuilder b("pair");
  b.set_gravity(Vec3::Zero());
  b.add_body({.name = "a", .shape = Box{{0.1, 0.2, 0.3}}, .mass = 2});
  b.add_body(
      {.name = "b", .shape = Box{{0.1, 0.1, 0.1}}, .mass = 1, .X = {Mat3::Identity(), {1, 0, 0}}});
  b.add_spring(
      {"spring", point_on("a", Vec3(0.1, 0, 0.3)), point_on("b", Vec3(0, 0.1, 0)), 50, 0.5, 1});
  const Model model = b.build();
  State state = model.state(model.neutral(), VecX::LinSpaced(12, -1, 1));
  const Vec3 linear = state.p.segment<3>(0) + state.p.segment<3>(6);
  const auto angular = [&] {
    return Vec3(state.p.segment<3>(3) + state.p.segment<3>(9) +
                Vec3(state.q.segment<3>(0)).cross(Vec3(state.p.segment<3>(0))) +
                Vec3(state.q.segment<3>(7) + Vec3::UnitX()).cross(Vec3(state.p.segment<3>(6))));
  };
  const Vec3 turning = angular();
  Stepper stepper(model, {.h = 0.01});
  for (int k = 0; k < 300; ++k) stepper.step(state);
  EXPECT_LT((state.p.segment<3>(0) + state.p.segment<3>(6) - linear).norm(), 1e-11);
  EXPECT_LT((angular() - turning).norm(), 1e-11);
}

TEST(Springs, NewtonsMethodIsQuadraticHoweverStiffTheyAre) {
  for (const double stiffness : {1e2, 1e4, 1e6}) {
    ModelBuilder b = sprung(0.4, 3);
    b.add_spring({"stiff", point_on("upper", Vec3(0.1, 0, -0.5)),
                  point_on("world", Vec3(1.3, 0, 0.2)), stiffness, std::sqrt(0.13),
                  stiffness / 100});  // at rest at first
    const Model model = b.build();
    Stepper stepper(model, {.h = 0.01});
    State state = start(model);
    for (int k = 0; k < 100; ++k) {
      stepper.step(state);
      EXPECT_LE(stepper.report().iterations, 8) << stiffness << " " << k;
      EXPECT_TRUE(stepper.report().fallbacks.empty());
    }
  }
}

TEST(Springs, AllocateNothingInAStep) {
  const Model model = sprung(0.4, 3).set_gravity_compensation("box", 0.5).build();
  for (const ImpactLaw law : {ImpactLaw::nodal_energy, ImpactLaw::shadow_energy}) {
    Stepper stepper(model, {.h = 0.01, .law = law});
    State state = start(model);
    for (int k = 0; k < 5; ++k) stepper.step(state);
    const long before = test::allocations;
    for (int k = 0; k < 50; ++k) stepper.step(state);
    EXPECT_EQ(test::allocations, before);
  }
}

TEST(Springs, GravityIsCompensatedInPart) {
  ModelBuilder b("falling");
  b.add_body({.name = "box", .shape = Box{{0.1, 0.2, 0.3}}, .mass = 2});
  b.set_gravity_compensation("box", 0.75);
  const Model model = b.build();
  State state = model.state();
  EXPECT_NEAR(model.potential_energy(model.state({{"box_z", 1}}).q), 0.25 * 2 * 9.81, 1e-13);
  EXPECT_NEAR(model.lagrangian(state.q, VecX::Zero(6)).L_q[2], -0.25 * 2 * 9.81, 1e-13);
  Stepper stepper(model, {.h = 0.01});
  for (int k = 0; k < 100; ++k) stepper.step(state);
  EXPECT_NEAR(state.p[2], -0.25 * 2 * 9.81, 1e-12);
}

/// A function that answers like a damped spring, with and without its partials, beside the real
/// one.
TEST(Functions, AreForcesOfSteps) {
  const Model real =
      test::arm().set_damping("elbow", 0.4).add_joint_spring("elbow", 20, 0.3).build();
  const auto with = [&](bool partials) {
    ModelBuilder b = test::arm();
    b.add_force({"spring",
                 [partials, n = real.n_v(), c = real.velocity_index("elbow"),
                  i = real.coordinate("elbow")](const ForceMoment& now, ForceAnswer& answer) {
                   answer.Q = VecX::Constant(1, -20 * (now.q[i] - 0.3) - 0.4 * now.v[c]);
                   if (!partials) return;
                   answer.Q_q = -20 * MatX::Identity(n, n).row(c);
                   answer.Q_v = -0.4 * MatX::Identity(n, n).row(c);
                 },
                 {"elbow"}});
    return b.build();
  };
  const auto run = [](const Model& model, int& iterations) {
    Stepper stepper(model, {.h = 0.01});
    State state = model.state({{"elbow", 1}}, {{"elbow", 2}});
    for (int k = 0; k < 100; ++k) {
      stepper.step(state);
      iterations += stepper.report().iterations;
    }
    return state;
  };
  int real_count = 0, full_count = 0, bare_count = 0;
  const State expected = run(real, real_count);
  const State full = run(with(true), full_count), bare = run(with(false), bare_count);
  EXPECT_LT((full.q - expected.q).norm(), 1e-11);
  EXPECT_LT((bare.q - expected.q).norm(), 1e-11);
  EXPECT_EQ(full_count, real_count);
  EXPECT_GT(bare_count, full_count);
  check_derivatives(with(true), "spring");
  EXPECT_THROW(check_derivatives(with(false), "spring"), ModelError);
}

TEST(Functions, BadAnswersAreNamedAndLeaveTheState) {
  const auto broken = [](const ForceFunction& function) {
    return test::arm().add_force({"wind", function, {"elbow"}}).build();
  };
  const auto refuse = [](const Model& model, const std::string& part) {
    Stepper stepper(model);
    State state = model.state();
    const State before = state;
    try {
      stepper.step(state);
      FAIL() << part;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.name, "wind");
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
    EXPECT_EQ(state, before);
  };
  refuse(broken([](const ForceMoment&, ForceAnswer& a) { a.Q = VecX::Zero(2); }), "2 numbers");
  refuse(broken([](const ForceMoment&, ForceAnswer& a) { a.Q = VecX::Constant(1, NAN); }),
         "Q[0] = nan");
  refuse(broken([](const ForceMoment&, ForceAnswer& a) {
           a.Q = VecX::Zero(1);
           a.Q_v = MatX::Zero(1, 7);
         }),
         "Q_v of shape (1, 7)");
}

TEST(Functions, AWrongDerivativeIsNamed) {
  const auto wrong = [](const ForceMoment& now, ForceAnswer& a) {
    a.Q = VecX::Constant(1, -now.v[0] * now.v[0]);
    a.Q_v = MatX::Zero(1, now.v.size());
    a.Q_v(0, 0) = -now.v[0];
  };
  const Model model = test::arm().add_force({"drag", wrong, {"elbow"}}).build();
  try {
    check_derivatives(model, "drag");
    FAIL();
  } catch (const ModelError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("Q_v[0, 0]"), std::string::npos) << text;
    EXPECT_NE(text.find("order"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace saltus
