// Free and ball joints in motion: reference values, conserved quantities, closed forms.
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

/// A body that flies, moments 1 : 2 : 3, no gravity.
Model top(const Vec3& moments = Vec3(1, 2, 3)) {
  BodyInertia body{1, Vec3::Zero(), Mat3::Zero()};
  body.I_J.diagonal() = moments;
  JointSpec joint;
  joint.name = "base";
  joint.type = JointType::floating;
  joint.parent = "world";
  joint.child = "top";
  return ModelBuilder("top")
      .set_gravity(Vec3::Zero())
      .add_link({"top", body})
      .add_joint(joint)
      .build();
}

State spinning(const Model& model, const Vec3& w, const Vec3& v = Vec3::Zero()) {
  VecX rates(6);
  rates << v, w;
  return model.state(model.neutral(), rates);
}

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
  JointSpec joint;
  joint.name = "tip";
  joint.type = JointType::spherical;
  joint.parent = "world";
  joint.child = "top";
  return ModelBuilder("heavy_top").add_link({"top", body}).add_joint(joint).build();
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
  EXPECT_LT(band, 1e-2);                     // h w = 0.3 rad a step: (h w)^2 / 12
  EXPECT_LT(std::abs(late - early), 1e-5);   // no trend
  EXPECT_NEAR(state.p.z(), vertical, 1e-12);
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

// What one arc cannot follow is refused in words, and the state stays as it was.
TEST(FreeTop, TurnsOfAWholeTurnAnArcAreToldByName) {
  const Model model = top(Vec3(1, 1, 1));
  State state = spinning(model, Vec3(0, 0, 650));
  const State before = state;
  Stepper stepper(model, {.h = 0.01});
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
