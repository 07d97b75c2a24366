// Forces of joints by themselves: values against their formulas, slopes against differences.
#include <gtest/gtest.h>

#include "kit/random_trees.hpp"
#include "saltus/force/force_model.hpp"

namespace saltus {
namespace {

constexpr int n = 4;

/// Damping, a motor, servos, one over two coordinates; with limits of effort or without.
ForceModel some_forces(double effort, double joint_effort) {
  ForceModel f;
  f.damping = VecX::Constant(n, 0.3);
  f.effort = VecX::Constant(n, joint_effort);
  f.actuators = {{"motor", {{0, 0, 5}}, 1, 0, 0, 0, effort, -2, 2},
                 {"position", {{1, 1, 1}}, 40, 0.5, -40, -3, effort},
                 {"rate", {{2, 2, -2}}, 6, 0, 0, -6, effort},
                 {"belt", {{0, 0, 1}, {3, 3, -0.5}}, 10, 0, -10, -1, effort}};
  return f;
}

ForceInput some_input(test::Random& random) {
  ForceInput input;
  input.control = random.vector(4);
  input.qfrc = random.vector(n);
  return input;
}

/// dQ/dq and dQ/dv as matrices.
MatX slopes(const ForceValues& x, int which) {
  MatX out = (which == 0 ? x.Q_q : x.Q_v).asDiagonal();
  for (Eigen::Index r = 0; r < x.coupled.cols(); ++r) {
    out += x.slope[2 * r + which] * (x.coupled.col(r) * x.coupled.col(r).transpose());
  }
  return out;
}

TEST(Forces, AreTheirFormulas) {
  const ForceModel f = some_forces(1e9, 1e9);
  test::Random random(1);
  const VecX q = random.vector(n), v = random.vector(n);
  ForceInput input = some_input(random);
  input.control[0] = 7;  // beyond its range: 2
  const VecX& u = input.control;
  ForceValues x(f, n);
  set_forces(f, q, v, input, x);
  const double belt = 10 * u[3] - 10 * (q[0] - 0.5 * q[3]) - (v[0] - 0.5 * v[3]);
  VecX Q = input.qfrc - 0.3 * v;
  Q[0] += 5 * 2 + belt;
  Q[1] += 40 * (u[1] - q[1]) + 0.5 - 3 * v[1];
  Q[2] += -2 * (6 * u[2] - 6 * -2 * v[2]);
  Q[3] += -0.5 * belt;
  EXPECT_LE((x.Q - Q).norm(), 1e-13 * Q.norm());
  EXPECT_NEAR(x.rate[2], -2 * v[2], 1e-15);
}

TEST(Forces, SlopesAreThoseOfDifferences) {
  test::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const ForceModel f = some_forces(trial % 2 ? 8 : 1e9, trial % 3 ? 1e9 : 6);
    const VecX q = random.vector(n), v = random.vector(n);
    const ForceInput input = some_input(random);
    ForceValues x(f, n), a(f, n), b(f, n);
    set_forces(f, q, v, input, x);
    const MatX by_q = slopes(x, 0), by_v = slopes(x, 1);
    const double step = 1e-7;
    for (int c = 0; c < n; ++c) {
      const VecX d = step * VecX::Unit(n, c);
      for (int which = 0; which < 2; ++which) {
        set_forces(f, which ? q : q + d, which ? v + d : v, input, a);
        set_forces(f, which ? q : q - d, which ? v - d : v, input, b);
        const VecX difference = (a.Q - b.Q) / (2 * step);
        // where one of the two is at its limit the force has a kink between them
        const bool has_kink =
            (a.effort - x.effort).norm() > 0 && (slopes(a, which) != slopes(b, which));
        if (has_kink) continue;
        // 1e-6: rounding of forces of size 100 over a step of 1e-7
        EXPECT_LE((difference - (which ? by_v : by_q).col(c)).norm(), 1e-6) << trial << " " << c;
      }
    }
  }
}

TEST(Forces, EffortsHold) {
  test::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const ForceModel f = some_forces(2, 3);
    const VecX q = random.vector(n, 3), v = random.vector(n, 3);
    ForceInput input;
    input.control = random.vector(4, 5);
    ForceValues x(f, n);
    set_forces(f, q, v, input, x);
    for (int k = 0; k < 4; ++k) EXPECT_LE(std::abs(x.effort[k]), 2 * (1 + 1e-15));
    EXPECT_LE(std::abs(x.single[0]), 3 * (1 + 1e-15));  // 5 times the motor's, cut by the joint
  }
}

}  // namespace
}  // namespace saltus
