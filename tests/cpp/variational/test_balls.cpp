// Trees with free and ball joints: reference values, momenta, the shadow energy.
#include <gtest/gtest.h>

#include <cmath>

#include "golden_balls.hpp"
#include "numeric.hpp"
#include "saltus/rollout/simulate.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus {
namespace {

using test::relative_error;

// The file's inputs are decimals of 20 digits; 100 steps of Newton's method at the rounding floor
// add up to 1e-13 or so.
TEST(GoldenBalls, TrajectoriesAgreeToTwelveDigits) {
  const std::vector<test::GoldenBalls> systems = test::golden_balls();
  ASSERT_EQ(systems.size(), 3u);
  for (const test::GoldenBalls& system : systems) {
    State state = system.model.state(system.rows[0].q, system.rows[0].v);
    EXPECT_LT(relative_error(state.p, system.rows[0].p), 1e-14);
    Stepper stepper(system.model, {.h = 0.01});
    int step = 0;
    for (const test::GoldenRow& row : system.rows) {
      for (; step < row.step; ++step) stepper.step(state);
      EXPECT_LT((state.q - row.q).cwiseAbs().maxCoeff(), 1e-12) << row.step;
      EXPECT_LT((state.p - row.p).cwiseAbs().maxCoeff(), 1e-12) << row.step;
      EXPECT_LT(relative_error(system.model.velocity(state), row.v), 1e-12) << row.step;
      const double H = system.model.kinetic_energy(state) + system.model.potential_energy(state.q);
      EXPECT_NEAR(H, row.energy, 1e-12 * (1 + std::abs(row.energy)));
    }
  }
}

TEST(GoldenBalls, EverySolverAgrees) {
  for (const test::GoldenBalls& system : test::golden_balls()) {
    for (const TreeSolver solver : {TreeSolver::lu, TreeSolver::sweep}) {
      const Model model = ModelBuilder(*system.model->description).set_solver(solver).build();
      State state = model.state(system.rows[0].q, system.rows[0].v);
      Stepper stepper(model, {.h = 0.01});
      for (int step = 0; step < 100; ++step) stepper.step(state);
      EXPECT_LT((state.q - system.rows.back().q).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

/// Linear momentum, and angular momentum about the world's origin, of a free tree: its base's.
Eigen::Matrix<double, 6, 1> momenta_of(const Model& model, const State& state) {
  const VecX v = model.velocity(state);
  Kinematics kin(model->tree);
  set_configuration(model->tree, state.q, kin);
  set_velocity(model->tree, v, kin);
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (int i = 0; i < model->tree.joints(); ++i) {
    const BodyInertia& body = model->mass.body[static_cast<std::size_t>(i)];
    if (body.mass == 0) continue;
    const Pose X = kin.X_WJ(model->tree, i);
    const JointMotion& m = kin.joint[static_cast<std::size_t>(i)];
    const Vec3 w = angular(m.V), c = X * body.c_J;
    const Vec3 from_O = c - kin.origin[static_cast<std::size_t>(model->tree.root[i])];
    const Vec3 p = body.mass * (linear(m.V) + w.cross(from_O));
    sum.head<3>() += p;
    sum.tail<3>() += c.cross(p) + X.R * body.I_J * X.R.transpose() * w;
  }
  return sum;
}

/// A free body with an arm of a revolute, a ball, and a ball on that: 13 velocities.
Model floating_tree() {
  ModelBuilder builder("floating");
  builder.set_gravity(Vec3::Zero());
  const auto add = [&](const std::string& name, JointType type, const std::string& parent,
                       const Vec3& at) {
    BodyInertia body = solid_box(0.8, Vec3(0.1, 0.2, 0.15));
    body.c_J = Vec3(0.05, -0.1, 0.02);
    JointSpec joint;
    joint.name = name;
    joint.type = type;
    joint.parent = parent;
    joint.child = name + "_link";
    joint.X_PJ.p = at;
    joint.axis = Vec3(0.2, 1, -0.3);
    builder.add_link({joint.child, body}).add_joint(joint);
  };
  add("base", JointType::floating, "world", Vec3::Zero());
  add("elbow", JointType::revolute, "base_link", Vec3(0.3, 0.1, 0));
  add("hip", JointType::spherical, "base_link", Vec3(-0.3, 0, 0.2));
  add("ankle", JointType::spherical, "hip_link", Vec3(0, 0.1, -0.4));
  return builder.build();
}

TEST(FloatingTree, KeepsItsSixMomenta) {
  const Model model = floating_tree();
  ASSERT_EQ(model.n_v(), 13);
  std::mt19937_64 random(4);
  VecX v(13);
  for (int i = 0; i < 13; ++i) v[i] = std::sin(3.0 + 2 * i);
  State state = model.state(model.random_configuration(random), v);
  const auto start = momenta_of(model, state);
  Stepper stepper(model, {.h = 0.01});
  for (int k = 0; k < 250; ++k) stepper.step(state);
  // 250 Newton solves that stop at 1e-15 of the momenta
  EXPECT_LT((momenta_of(model, state) - start).norm(), 1e-12 * start.norm());
}

TEST(FloatingTree, ShadowEnergyIsKeptToFourthOrder) {
  const Model model = floating_tree();
  std::mt19937_64 random(5);
  VecX v(13);
  for (int i = 0; i < 13; ++i) v[i] = 2 * std::sin(1.0 + 2 * i);
  const State start = model.state(model.random_configuration(random), v);
  const auto wander = [&](double h) {
    const Trajectory run = simulate(model, start, 1.0, {.h = h});
    const VecX H = run.total();
    return std::pair((H.array() - H[0]).abs().maxCoeff(),
                     (run.shadow.array() - run.shadow[0]).abs().maxCoeff());
  };
  const auto [H1, S1] = wander(0.01);
  const auto [H2, S2] = wander(0.005);
  EXPECT_NEAR(std::log2(H1 / H2), 2, 0.2);
  EXPECT_NEAR(std::log2(S1 / S2), 4, 0.5);
  EXPECT_LT(S2, H2 / 20);
}

}  // namespace
}  // namespace saltus
