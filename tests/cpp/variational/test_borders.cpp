// Bodies that slide over the border of what they lie on: the load goes over from corners to the
// edges that cross there, or to what lies beside, and nobody feels it.
#include <gtest/gtest.h>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::energy;

constexpr double still = 1e-12;  ///< rounding is 1e-17 a step, contacts are exact to 1e-13

/// Tops at z = 0, from x to x + length, 2 m wide.
struct Table {
  double x, length;
};
const Table one = {-1, 2}, next = {1, 2};

/// From the first table's border on; both ends of a body that is twice as long come to seams at
/// once.
std::vector<Table> planks() {
  std::vector<Table> all = {{-1.2, 2}};
  for (int k = 0; k < 6; ++k) all.push_back({0.8 + 0.2 * k, 0.2});
  return all;
}

struct Scene {
  std::vector<Table> tables;
  bool rod = false;  ///< a capsule along x, else a box
  bool can = false;  ///< a cylinder that stands
  double friction = 0;
  double yaw = 0;    ///< [rad]
  double at = 0.5;   ///< [m] x of the body's centre; its ends are 0.2 m from there
  double speed = 1;  ///< [m/s]
};

Model slide(const Scene& s) {
  ModelBuilder b("borders");
  b.set_default_contact({1, s.friction});
  for (const Table& t : s.tables) {
    b.add_shape("world", Box{{t.length / 2, 1, 0.5}},
                {Mat3::Identity(), {t.x + t.length / 2, 0, -0.5}});
  }
  const Vec3 half(0.2, 0.1, 0.1);
  b.add_link({"body", solid_box(1, half)});
  b.add_joint({.name = "x",
               .type = JointType::floating,
               .parent = "world",
               .child = "body",
               .X_PJ = {Mat3::Identity(), {s.at, 0, s.rod ? 0.05 : 0.1}}});
  const Mat3 lying = rotation_from_rpy(0, 0.5 * 3.14159265358979323846, 0);
  const Mat3 turned = rotation_from_rpy(0, 0, s.yaw);
  if (s.rod) {
    b.add_shape("body", Capsule{0.05, 0.2}, {turned * lying, Vec3::Zero()});
  } else if (s.can) {
    b.add_shape("body", Cylinder{0.1, 0.1}, {turned, Vec3::Zero()});
  } else {
    b.add_shape("body", Box{half}, {turned, Vec3::Zero()});
  }
  return b.build();
}

struct Slid {
  State end;
  double off_level = 0;  ///< [m | rad] the most of z, roll, pitch
  double gained = 0;     ///< [J] the most that energy differed
  int impacts = 0;
};

Slid go(const Model& model, double speed, double yaw_rate, double h, int steps) {
  State state = model.state({}, {{"x_vx", speed}, {"x_wz", yaw_rate}});
  const double before = energy(model, state);
  Stepper stepper(model, {.h = h});
  Slid out;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    out.impacts += static_cast<int>(stepper.report().impacts.size());
    // up and down, and its axis z from the vertical
    const Vec3 up = Eigen::Map<const Quaternion>(state.q.data() + 3) * Vec3::UnitZ();
    out.off_level = std::max({out.off_level, std::abs(state.q[2]), std::hypot(up.x(), up.y())});
    out.gained = std::max(out.gained, std::abs(energy(model, state) - before));
  }
  out.end = state;
  return out;
}

/// On and on as on an endless plane.
void expect_straight_on(const Scene& scene, double yaw_rate, double h, int steps) {
  const Model model = slide(scene);
  const Slid r = go(model, scene.speed, yaw_rate, h, steps);
  EXPECT_EQ(r.impacts, 0);
  EXPECT_LE(r.off_level, still);
  EXPECT_LE(r.gained, still);
  EXPECT_NEAR(r.end.q[model.coordinate("x_x")], scene.speed * h * steps, still);
  EXPECT_NEAR(r.end.q[model.coordinate("x_y")], 0, still);
  EXPECT_NEAR(scenes::moved(model, r.end.q, "x_wz"), yaw_rate * h * steps, still);
}

// Until its centre is 0.02 m before the border. At h = 0.005 and 0.0025 a step ends where its front
// is just over the border.
TEST(Borders, ABoxSlidesOverTheEdgeOfATable) {
  for (const double h : {0.005, 0.0025, 0.003}) {
    const int steps = static_cast<int>(0.48 / h);
    expect_straight_on({.tables = {one}}, 0, h, steps);
    expect_straight_on({.tables = {one}, .yaw = 0.3}, 0, h, steps);
    expect_straight_on({.tables = {one}, .yaw = 0.2}, -2, h, steps);
  }
}

TEST(Borders, ARodSlidesOverTheEdgeOfATable) {
  for (const double h : {0.005, 0.0025, 0.003}) {
    const int steps = static_cast<int>(0.48 / h);
    expect_straight_on({.tables = {one}, .rod = true}, 0, h, steps);
    expect_straight_on({.tables = {one}, .rod = true, .yaw = 0.3}, 0, h, steps);
  }
}

TEST(Borders, WhatHangsOverTheEdgeSlidesBackOntoTheTable) {
  for (const bool rod : {false, true}) {
    expect_straight_on({.tables = {one}, .rod = rod, .at = 0.9, .speed = -1}, 0, 0.005, 60);
  }
}

// Corners that come to the seam meet the upright face of the second table, which its top hides.
TEST(Borders, ABoxSlidesOverTheSeamOfTwoTables) {
  for (const double h : {0.005, 0.003}) {
    const int steps = static_cast<int>(1.4 / h);
    expect_straight_on({.tables = {one, next}}, 0, h, steps);
    expect_straight_on({.tables = {one, next}, .yaw = 0.3}, 0, h, steps);
    expect_straight_on({.tables = {one, next}, .yaw = 0.3}, 1, h, steps);
  }
}

TEST(Borders, ARodSlidesOverTheSeamOfTwoTables) {
  for (const double h : {0.005, 0.003}) {
    const int steps = static_cast<int>(1.4 / h);
    expect_straight_on({.tables = {one, next}, .rod = true}, 0, h, steps);
    expect_straight_on({.tables = {one, next}, .rod = true, .yaw = 0.3}, 0, h, steps);
  }
}

// A step ends where the middle of the round end is over the seam to the last bit or nearly: it is
// held by both tables, and the next step has to let it follow neither border.
TEST(Borders, ARodsEndStopsOverTheSeam) {
  for (const double at : {0.4, 0.5, 0.6, 0.7, 0.8, 0.75}) {
    for (const double h : {0.005, 0.01}) {
      const int steps = static_cast<int>(0.5 / h);
      expect_straight_on({.tables = {one, next}, .rod = true, .at = at}, 0, h, steps);
    }
  }
}

TEST(Borders, ABoxSlidesOverPlanks) {
  for (const double h : {0.005, 0.003}) {
    const int steps = static_cast<int>(1 / h);
    expect_straight_on({.tables = planks()}, 0, h, steps);
    expect_straight_on({.tables = planks(), .yaw = 0.3}, 1, h, steps);
  }
}

// It tips about the border while it slides, on crossing edges: no impact, and the energy of the
// midpoint rule, which is off by O(h^2).
TEST(Borders, WhatTipsOverTheEdgeKeepsItsEnergyToSecondOrder) {
  for (const bool rod : {false, true}) {
    const Model model = slide({.tables = {one}, .rod = rod});
    const Slid coarse = go(model, 1, 0, 0.01, 60), fine = go(model, 1, 0, 0.005, 120);
    EXPECT_EQ(coarse.impacts + fine.impacts, 0);
    EXPECT_GT(scenes::moved(model, fine.end.q, "x_wy"), 0.05);
    EXPECT_LE(coarse.gained, 4 * 0.01 * 0.01);
    EXPECT_NEAR(coarse.gained / fine.gained, 4, 0.1);
    EXPECT_NEAR(scenes::moved(model, coarse.end.q, "x_wy"),
                scenes::moved(model, fine.end.q, "x_wy"), 1e-3);
  }
}

// Its end comes to the edge that bears its axis, leaves it at a tangent, and falls: no impact.
TEST(Borders, ARodTipsAndLeavesTheEdge) {
  const Model model = slide({.tables = {one}, .rod = true});
  for (const double h : {0.01, 0.006, 0.003}) {
    const Slid r = go(model, 1, 0, h, static_cast<int>(0.9 / h));
    EXPECT_EQ(r.impacts, 0);
    EXPECT_LE(r.gained, 5 * h * h);
    EXPECT_GT(r.end.q[model.coordinate("x_x")], 0.85);
  }
}

// All corners and edges slide alike, whoever bears the load: x = v t - mu g t^2 / 2. The rim of a
// can goes over from its points to its crossings with the border.
TEST(Borders, FrictionIsTheSameOnBothSidesOfTheEdge) {
  const double mu = 0.1, h = 0.005;
  const Scene box = {.tables = {one}, .friction = mu};
  const Scene can = {.tables = {one}, .can = true, .friction = mu, .at = 0.55};
  for (const Scene& scene : {box, can}) {
    const Model model = slide(scene);
    const Slid r = go(model, 1.2, 0, h, 80);
    const double t = 80 * h;
    EXPECT_EQ(r.impacts, 0);
    EXPECT_LE(r.off_level, still);
    EXPECT_NEAR(r.end.q[model.coordinate("x_x")], 1.2 * t - mu * 9.81 * t * t / 2, still);
  }
}

TEST(Borders, FrictionIsTheSameOnBothSidesOfASeam) {
  const double mu = 0.1, h = 0.005;
  const Model model = slide({.tables = {one, next}, .friction = mu});
  const Slid r = go(model, 1.5, 0, h, 140);
  const double t = 140 * h;
  EXPECT_EQ(r.impacts, 0);
  EXPECT_LE(r.off_level, still);
  EXPECT_NEAR(r.end.q[model.coordinate("x_x")], 1.5 * t - mu * 9.81 * t * t / 2, still);
}

TEST(Borders, BoxesWithFrictionTipOverTheEdge) {
  for (const double mu : {0.1, 0.3}) {
    const Model model = slide({.tables = {one}, .friction = mu});
    const State start = model.state({}, {{"x_vx", 2}});
    const Slid r = go(model, 2, 0, 0.005, 140);
    EXPECT_EQ(r.impacts, 0);
    EXPECT_GT(scenes::moved(model, r.end.q, "x_wy"), 0.5);
    EXPECT_LE(energy(model, r.end), energy(model, start));
  }
}

}  // namespace
}  // namespace saltus
