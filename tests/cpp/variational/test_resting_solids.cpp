// Cylinders and convex solids that lie on other solids: always the same contacts, no drift.
#include <gtest/gtest.h>

#include <set>

#include "kit/hulls.hpp"
#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::touching;
using Names = std::set<std::string>;

constexpr double quarter = 0.5 * 3.14159265358979323846;
constexpr double still = 1e-11;  // 500 steps of rounding

/// A body at rest in the world, or (mass > 0) a free one.
struct Body {
  std::string name;
  Shape shape;
  Vec3 at;
  Mat3 R = Mat3::Identity();
  Vec3 half = Vec3::Zero();  ///< [m] of the box that its inertia is taken from; 0: at rest
};

Model scene(const std::vector<Body>& bodies) {
  ModelBuilder b("scene");
  for (const Body& body : bodies) {
    const bool rests = body.half.isZero(0);
    if (rests) {
      b.add_link({body.name});
    } else {
      b.add_link({body.name, solid_box(1, body.half)});
    }
    b.add_joint({.name = body.name,
                 .type = rests ? JointType::fixed : JointType::floating,
                 .parent = "world",
                 .child = body.name,
                 .X_PJ = {body.R, body.at}});
    b.add_shape(body.name, body.shape);
  }
  return b.build();
}

/// Rests for 5 s on the contacts named, and neither drifts nor sinks.
void expect_rest(const Model& model, const Names& names) {
  State state = model.state();
  const VecX q = state.q;
  Stepper stepper(model, {.h = 0.01});
  EXPECT_EQ(touching(model, state.q), names);
  for (int k = 0; k < 500; ++k) {
    stepper.step(state);
    EXPECT_TRUE(stepper.report().impacts.empty()) << "t = " << state.t;
    if (k % 50 != 0) continue;
    EXPECT_EQ(touching(model, state.q), names) << "t = " << state.t;
    EXPECT_GT(model.gaps(state.q).phi.minCoeff(), -1e-9);
  }
  EXPECT_LE((state.q - q).cwiseAbs().maxCoeff(), still);
}

Convex hull_of(const Vec3& half) { return test::hull_of(test::corners(half)); }

const Cylinder can{0.05, 0.1};
const Vec3 about_can(0.05, 0.05, 0.1);
const Mat3 lying = rotation_from_rpy(quarter, 0, 0) * rotation_from_rpy(0, 0, 0.3);  // along y

Body table(const Vec3& half) { return {"table", Box{half}, {0, 0, -half.z()}}; }

TEST(RestingSolids, ACanLiesOnATableOnItsTwoRims) {
  const Body lies{"can", can, {0.1, 0, 0.05}, lying, about_can};
  expect_rest(scene({table({0.5, 0.5, 0.1}), lies}), {"can[rim+] ~ table", "can[rim-] ~ table"});
}

TEST(RestingSolids, ACanLiesOnAMeshLikewise) {
  const Vec3 half(0.5, 0.5, 0.1);
  const Body lies{"can", can, {0.1, 0, 0.05}, lying, about_can};
  expect_rest(scene({{"table", hull_of(half), {0, 0, -0.1}}, lies}),
              {"can[rim+] ~ table", "can[rim-] ~ table"});
}

TEST(RestingSolids, ACanLiesAcrossANarrowBlock) {
  const Body lies{"can", can, {0, 0.01, 0.05}, lying, about_can};
  expect_rest(scene({table({0.2, 0.04, 0.1}), lies}),
              {"table[x++] ~ can[axis]", "table[x-+] ~ can[axis]"});
}

// One end is beyond the border: that rim on one side, the border on the other.
TEST(RestingSolids, ACanLiesPartlyBeyondTheBorder) {
  const Body lies{"can", can, {0, 0.15, 0.05}, lying, about_can};
  const Model model = scene({table({0.2, 0.2, 0.1}), lies});
  expect_rest(model, {"can[rim+] ~ table", "table[x++] ~ can[axis]"});
}

TEST(RestingSolids, ACanStandsOnATable) {
  const Body stands{"can", can, {0.1, 0, 0.1}, rotation_from_rpy(0, 0, 0.3), about_can};
  expect_rest(scene({table({0.5, 0.5, 0.1}), stands}),
              {"can[-0] ~ table", "can[-90] ~ table", "can[-180] ~ table", "can[-270] ~ table"});
}

// Its centre is 0.01 m from the border; two of its points are over air, and the border holds it.
TEST(RestingSolids, ACanStandsPartlyBeyondTheBorder) {
  const Body stands{"can", can, {0.19, 0, 0.1}, rotation_from_rpy(0, 0, quarter / 2), about_can};
  expect_rest(
      scene({table({0.2, 0.2, 0.1}), stands}),
      {"can[-90] ~ table", "can[-180] ~ table", "can[in] ~ table[+y+]", "can[out] ~ table[+y+]"});
}

TEST(RestingSolids, ACanStandsOnACan) {
  const Body low{"low", can, {0, 0, -0.1}},
      high{"high", can, {0, 0, 0.1}, Mat3::Identity(), about_can};
  const Model flush = scene({low, high});
  EXPECT_EQ(touching(flush, flush.state().q).size(), 8u);
  expect_rest(flush, touching(flush, flush.state().q));
  Body askew = high;
  askew.at.x() = 0.04;
  askew.R = rotation_from_rpy(0, 0, quarter / 2);
  expect_rest(scene({low, askew}), {"high[-90] ~ low", "high[-180] ~ low", "low[+0] ~ high",
                                    "low[left] ~ high[left]", "low[right] ~ high[right]"});
}

// In the groove between two logs at rest: on each by its two rims or theirs.
TEST(RestingSolids, ALogLiesInTheGrooveOfTwo) {
  const Cylinder log{0.05, 0.3};
  const double x = 0.05, z = std::sqrt(0.01 - 0.0025);
  const Body left{"left", log, {-x, 0, 0}, lying}, right{"right", log, {x, 0, 0}, lying};
  const Body top{"top", log, {0, 0.1, z}, lying, {0.05, 0.05, 0.3}};
  expect_rest(scene({left, right, top}),
              {"top[rim+] ~ left", "left[rim-] ~ top", "top[rim+] ~ right", "right[rim-] ~ top"});
}

TEST(RestingSolids, AMeshPlankAcrossAMeshPlank) {
  const Vec3 along(0.5, 0.05, 0.02), across(0.05, 0.5, 0.02);
  const Body low{"low", hull_of(along), {0, 0, -0.02}};
  const Body high{"high", hull_of(across), {0.1, 0, 0.02}, Mat3::Identity(), across};
  const Model model = scene({low, high});
  const Names names = touching(model, model.state().q);
  EXPECT_EQ(names.size(), 4u);
  for (const std::string& name : names) EXPECT_EQ(name.find("low[e"), 0u) << name;
  expect_rest(model, names);
}

TEST(RestingSolids, AMeshPlankAcrossABoxAndARod) {
  const Vec3 across(0.05, 0.5, 0.02);
  const Body high{"high", hull_of(across), {0.1, 0, 0.02}, Mat3::Identity(), across};
  const Model on_box = scene({{"low", Box{{0.5, 0.05, 0.02}}, {0, 0, -0.02}}, high});
  EXPECT_EQ(touching(on_box, on_box.state().q).size(), 4u);
  expect_rest(on_box, touching(on_box, on_box.state().q));
  // two rods, or it would roll
  const Mat3 along_x = rotation_from_rpy(0, quarter, 0);
  const Model on_rods = scene({{"front", Capsule{0.02, 0.5}, {0, 0.1, -0.02}, along_x},
                               {"back", Capsule{0.02, 0.5}, {0, -0.1, -0.02}, along_x},
                               high});
  EXPECT_EQ(touching(on_rods, on_rods.state().q).size(), 4u);
  expect_rest(on_rods, touching(on_rods, on_rods.state().q));
}

// No friction: what it has it keeps, and it stays on its rims.
TEST(RestingSolids, ACanRollsAlongATable) {
  const Body lies{"can", can, {-0.5, 0, 0.05}, rotation_from_rpy(quarter, 0, 0), about_can};
  const Model model = scene({table({2, 0.5, 0.1}), lies});
  // the joint's frame is the can's: its z axis is along -y
  State state = model.state({}, {{"can_vx", 0.5}, {"can_wz", 3}});
  const double energy = model.kinetic_energy(state);
  Stepper stepper(model, {.h = 0.01});
  for (int k = 0; k < 200; ++k) stepper.step(state);
  EXPECT_NEAR(state.q[model.coordinate("can_x")], 1, 1e-10);
  EXPECT_NEAR(scenes::moved(model, state.q, "can_wz"), scenes::within_a_turn(6), 1e-9);
  EXPECT_NEAR(model.kinetic_energy(state), energy, 1e-10);
  EXPECT_EQ(touching(model, state.q), (Names{"can[rim+] ~ table", "can[rim-] ~ table"}));
}

}  // namespace
}  // namespace saltus
