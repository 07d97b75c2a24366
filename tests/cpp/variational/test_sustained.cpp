// Contacts that stay closed: held by a force that can only push.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

/// A ball of radius 0.1 that slides in x and z.
ModelBuilder ball_in_the_plane() {
  ModelBuilder b;
  scenes::add_slider(b, 0.1);
  return b;
}

TEST(Sustained, AStackOfTenBallsRestsForAMinute) {
  ModelBuilder b;
  std::map<std::string, double> q;
  for (int i = 0; i < 10; ++i) {
    const std::string name = "z_" + std::to_string(i);
    scenes::add_bead(b, name, Vec3::Zero(), Vec3::UnitZ(), 1, 0.1);
    q[name] = 0.1 + 0.2 * i;
  }
  b.add_half_space("floor", Vec3::UnitZ());
  const Model model = b.build();
  const Trajectory run = simulate(model, model.state(q), 60, {.h = 0.01});
  EXPECT_TRUE(run.impacts.empty());
  EXPECT_LT((run.q.rowwise() - run.q.row(0)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(run.energy_error(), 0);
}

// Ten balls zigzag between two walls 3 r apart: each leans on one wall and on its neighbours, 20
// contacts for 20 coordinates.
TEST(Sustained, TenBallsInATroughRestForAMinute) {
  const double r = 0.1;
  ModelBuilder b;
  std::map<std::string, double> q;
  for (int i = 0; i < 10; ++i) {
    const std::string k = std::to_string(i);
    scenes::add_slider(b, r, "_" + k);
    q["x_" + k] = (i % 2 == 0 ? -1 : 1) * r / 2;
    q["z_" + k] = r + i * std::sqrt(3.) * r;
  }
  b.add_half_space("floor", Vec3::UnitZ()).add_half_space("left", Vec3::UnitX(), -1.5 * r);
  b.add_half_space("right", -Vec3::UnitX(), -1.5 * r);
  const Model model = b.build();
  const Trajectory run = simulate(model, model.state(q), 60, {.h = 0.01});
  EXPECT_TRUE(run.impacts.empty());
  EXPECT_LT((run.q.rowwise() - run.q.row(0)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(run.kinetic.maxCoeff(), 1e-12);
  const VecX phi = model.gaps(run.q.row(run.q.rows() - 1).transpose()).phi;
  EXPECT_EQ((phi.array().abs() < 1e-9).count(), 20);
}

TEST(Sustained, ABallSlidesDownASlopeAsTheClosedFormSays) {
  ModelBuilder b = ball_in_the_plane();
  b.add_half_space("slope", Vec3(0.6, 0, 0.8));
  const Model model = b.build();
  const Trajectory run = simulate(model, model.state({{"x", 0.06}, {"z", 0.08}}), 1, {.h = 0.01});
  EXPECT_NEAR(run.q(100, 0) - 0.06, 0.5 * 9.81 * 0.6 * 0.8, 1e-12);  // midpoint: exact here
  EXPECT_NEAR(model.gaps(run.q.row(100).transpose()).phi[0], 0, 1e-12);
  EXPECT_LT(run.energy_error(), 1e-12);
  EXPECT_TRUE(run.impacts.empty());
}

TEST(Sustained, ABallLeavesATableAtItsEdge) {
  ModelBuilder b = ball_in_the_plane();
  b.add_body({.name = "table",
              .shape = Box{Vec3(1, 1, 0.5)},
              .X = {Mat3::Identity(), Vec3(0, 0, -0.5)},
              .joint = JointType::fixed});
  const Model model = b.build();
  const Trajectory run =
      simulate(model, model.state({{"x", 0}, {"z", 0.1}}, {{"x", 1}}), 2, {.h = 0.01});
  EXPECT_NEAR(run.q(100, 1), 0.1, 1e-12);  // x = 1: the edge
  EXPECT_LT(run.q(101, 1), 0.1 - 1e-6);
  // from then on it falls; the corner is steeper than the fall at this speed for no more than 1 cm
  EXPECT_NEAR(run.q(200, 1), 0.1 - 0.5 * 9.81, 0.05);
  EXPECT_LT(run.energy_error(), 1e-10);
}

TEST(Sustained, ABallLeavesADomeWhereItsWeightNoLongerPressesIt) {
  // Without friction at cos(angle) = 2/3 cos(start). Sampled at h, its height above the dome is
  // seen after a few steps: O(h) late.
  ModelBuilder b = ball_in_the_plane();
  b.add_body({.name = "dome", .shape = Sphere{0.9}, .joint = JointType::fixed});
  const Model model = b.build();
  const double start = 0.1;
  const auto leaves_at = [&](double h) {
    const Trajectory run =
        simulate(model, model.state({{"x", std::sin(start)}, {"z", std::cos(start)}}), 2, {.h = h});
    int k = 0;
    while (run.q.row(k).norm() < 1 + 1e-9) ++k;
    return run.q(k, 1) / run.q.row(k).norm();
  };
  const double exact = 2. / 3 * std::cos(start);
  const double coarse = std::abs(leaves_at(0.004) - exact);
  const double fine = std::abs(leaves_at(0.0005) - exact);
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, coarse / 3);
}

}  // namespace
}  // namespace saltus
