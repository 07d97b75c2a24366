// From the description to the tree: composed joints, names, fixed joints, mimic joints.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/builders.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

using test::arm;
using test::joint;
using test::relative_error;
using test::some_body;

constexpr double rounding = 1e-14;  // a few products of rotations

Model one_joint(const JointSpec& spec) {
  ModelBuilder builder("one");
  builder.add_link({"body", some_body()}).add_joint(spec);
  return builder.build();
}

std::vector<std::string> coordinate_names(const Model& model) {
  std::vector<std::string> names;
  for (const Coordinate& c : model->coordinates) names.push_back(c.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Coordinates, AreNamedAfterTheirJoint) {
  const std::pair<JointType, Names> expected[] = {
      {JointType::fixed, {}},
      {JointType::revolute, {"j"}},
      {JointType::continuous, {"j"}},
      {JointType::prismatic, {"j"}},
      {JointType::helical, {"j"}},
      {JointType::planar, {"j_x", "j_y", "j_yaw"}},
      {JointType::spherical, {"j_qx", "j_qy", "j_qz", "j_qw"}},
      {JointType::floating, {"j_x", "j_y", "j_z", "j_qx", "j_qy", "j_qz", "j_qw"}},
  };
  for (const auto& [type, names] : expected) {
    const Model model = one_joint(joint("j", type, "world", "body"));
    EXPECT_EQ(coordinate_names(model), names);
    EXPECT_EQ(model.n_q(), static_cast<int>(names.size()));
    for (const Coordinate& c : model->coordinates) {
      EXPECT_EQ(c.joint, "j");
      const char last = c.name.back();
      const bool slides = type == JointType::prismatic || last == 'x' || last == 'y' || last == 'z';
      const bool is_quaternion = c.name.find("_q") != std::string::npos;
      EXPECT_EQ(c.unit, is_quaternion ? Unit::one : slides ? Unit::metre : Unit::radian) << c.name;
    }
    ASSERT_EQ(model->joints.size(), 1u);
    EXPECT_EQ(model->joints[0].type, type);
    EXPECT_EQ(model->joints[0].parent, "world");
    EXPECT_EQ(model->joints[0].child, "body");
    EXPECT_EQ(model->joints[0].frames.size(), static_cast<std::size_t>(model.n_v()));
    EXPECT_EQ(model->joints[0].velocities.size(), static_cast<std::size_t>(model.n_v()));
    EXPECT_EQ(model->joints[0].coordinates.size(), names.size());
  }
}

TEST(Coordinates, VelocitiesHaveNamesOfTheirOwnWhereThereAreBalls) {
  const auto velocities = [](JointType type) {
    return one_joint(joint("j", type, "world", "body"))->velocity_names;
  };
  EXPECT_EQ(velocities(JointType::revolute), (Names{"j"}));
  EXPECT_EQ(velocities(JointType::planar), (Names{"j_x", "j_y", "j_yaw"}));
  EXPECT_EQ(velocities(JointType::spherical), (Names{"j_wx", "j_wy", "j_wz"}));
  EXPECT_EQ(velocities(JointType::floating),
            (Names{"j_vx", "j_vy", "j_vz", "j_wx", "j_wy", "j_wz"}));
}

TEST(Coordinates, CarryLimitsDampingAndFriction) {
  JointSpec spec = joint("j", JointType::revolute, "world", "body");
  spec.lower = -1, spec.upper = 2, spec.velocity = 3, spec.effort = 4;
  spec.damping = 5, spec.friction = 6;
  const Coordinate c = one_joint(spec)->coordinates[0];
  EXPECT_EQ(c.lower, -1);
  EXPECT_EQ(c.upper, 2);
  EXPECT_EQ(c.velocity, 3);
  EXPECT_EQ(c.effort, 4);
  EXPECT_EQ(c.damping, 5);
  EXPECT_EQ(c.friction, 6);
  EXPECT_EQ(one_joint(joint("j", JointType::revolute, "world", "body"))->coordinates[0].upper,
            std::numeric_limits<double>::infinity());
}

// A joint's child frame is placement times motion, whatever frames the tree has inside.
TEST(Joints, MoveTheirChildAsTheyShould) {
  const Pose X_PJ{rotation_from_rpy(0.4, -0.3, 1.1), {0.5, -1, 2}};
  const Vec3 axis = Vec3(1, 2, -2) / 3;
  const auto pose_of = [&](JointType type, const VecX& q) {
    JointSpec spec = joint("j", type, "world", "body", Vec3::Zero(), 7 * axis);  // any length
    spec.X_PJ = X_PJ;
    if (type == JointType::helical) spec.pitch = 0.3;
    const Model model = one_joint(spec);
    return model.X_WL(q, model.link("body"));
  };
  const auto expect = [&](const Pose& X, const Pose& X_JL) {
    EXPECT_LT(((X_PJ * X_JL).R - X.R).norm(), rounding);
    EXPECT_LT(((X_PJ * X_JL).p - X.p).norm(), rounding);
  };
  const VecX q = VecX::Constant(1, 0.8);
  const Mat3 turned = Eigen::AngleAxisd(0.8, axis).toRotationMatrix();
  expect(pose_of(JointType::fixed, VecX()), {});
  expect(pose_of(JointType::revolute, q), {turned, Vec3::Zero()});
  expect(pose_of(JointType::continuous, q), {turned, Vec3::Zero()});
  expect(pose_of(JointType::prismatic, q), {Mat3::Identity(), 0.8 * axis});
  expect(pose_of(JointType::helical, q), {turned, 0.3 * 0.8 * axis});
  const Mat3 R = rotation_from_rpy(0.3, 0.2, 0.1);
  VecX seven(7);
  seven << 1, 2, 3, Quaternion(R).coeffs();
  expect(pose_of(JointType::spherical, seven.tail(4)), {R, Vec3::Zero()});
  expect(pose_of(JointType::floating, seven), {R, {1, 2, 3}});
  // planar: x and y in the plane, yaw about its normal
  const Pose flat = X_PJ.inverse() * pose_of(JointType::planar, Vec3(3, 4, 0.8));
  EXPECT_LT((flat.R - turned).norm(), rounding);
  EXPECT_NEAR(flat.p.dot(axis), 0, rounding);
  EXPECT_NEAR(flat.p.norm(), 5, rounding);
}

// Coordinates along the world's axes, for the axis that everybody uses.
TEST(Joints, PlanarAboutZSlidesAlongXAndY) {
  const Model model =
      one_joint(joint("j", JointType::planar, "world", "body", Vec3::Zero(), Vec3::UnitZ()));
  EXPECT_EQ(model.X_WL(Vec3(3, 4, 0), model.link("body")).p, Vec3(3, 4, 0));
}

TEST(FixedJoints, AreFoldedIntoTheLinkTheyHoldTo) {
  const auto build = [](bool welded) {
    ModelBuilder builder("folded");
    const Pose X_AB{rotation_from_rpy(0.3, 0.2, -0.5), {0.4, 0.1, -0.3}};
    const BodyInertia a = some_body(2), b = some_body(0.7);
    builder.add_link({"a", welded ? weld(a, transform(X_AB, b)) : a});
    builder.add_joint(joint("j", JointType::revolute, "world", "a", {0, 0, 1}));
    if (!welded) {
      JointSpec mount = joint("mount", JointType::fixed, "a", "b");
      mount.X_PJ = X_AB;
      builder.add_link({"b", b}).add_joint(mount);
    }
    builder.add_link({"c", some_body()});
    JointSpec next = joint("k", JointType::prismatic, welded ? "a" : "b", "c");
    if (welded) next.X_PJ = X_AB;
    return builder.add_joint(next).build();
  };
  const Model folded = build(false), welded = build(true);
  EXPECT_EQ(folded->tree.joints(), 2);
  EXPECT_EQ(folded->links.size(), 4u);
  const Eigen::Vector2d q(0.7, -0.4), v(1.2, 0.6);
  const LagrangianPartials a = folded.lagrangian(q, v), b = welded.lagrangian(q, v);
  EXPECT_NEAR(a.value, b.value, 10 * rounding);
  EXPECT_LT(relative_error(a.L_vv, b.L_vv), rounding);
  EXPECT_LT(relative_error(a.L_qq, b.L_qq), rounding);
  EXPECT_EQ(folded->links[2].name, "b");
  EXPECT_EQ(folded->links[2].joint, folded->links[1].joint);
  EXPECT_EQ(folded->links[2].mass, 0.7);  // own mass, not that of the weld
  EXPECT_LT((folded.X_WL(q, 3).p - welded.X_WL(q, 2).p).norm(), rounding);
}

TEST(Order, IsDepthFirstInTheOrderOfDescription) {
  ModelBuilder builder("tree");
  // described from the tips, and links before their parents
  for (const std::string name : {"tip", "top", "a", "b"}) builder.add_link({name, some_body()});
  builder.add_joint(joint("to_tip", JointType::revolute, "a", "tip"));
  builder.add_joint(joint("to_top", JointType::revolute, "a", "top"));
  builder.add_joint(joint("to_a", JointType::revolute, "world", "a"));
  builder.add_joint(joint("to_b", JointType::revolute, "world", "b"));
  const Model model = builder.build();
  EXPECT_EQ(coordinate_names(model), (Names{"to_a", "to_tip", "to_top", "to_b"}));
  EXPECT_EQ(model->tree.parent, (std::vector<int>{-1, 0, 0, -1}));
  EXPECT_TRUE(model->tree.one_to_one);
  EXPECT_EQ(model.link("tip"), 1);
  EXPECT_EQ(model->links[1].joint, 1);
}

// s_finger = 2 s_wrist + 0.5, s_wrist = -3 s_elbow + 0.1: finger = -6 elbow + 0.7.
TEST(Mimic, ChainsAreFlattened) {
  ModelBuilder builder = arm().add_link({"hand", some_body()}).add_link({"tip", some_body()});
  JointSpec wrist = joint("wrist", JointType::revolute, "lower", "hand", {0, 0, -1});
  wrist.mimic = Mimic{"elbow", -3, 0.1};
  JointSpec finger = joint("finger", JointType::prismatic, "hand", "tip", {0, 0, -1});
  finger.mimic = Mimic{"wrist", 2, 0.5};
  builder.add_joint(finger).add_joint(wrist);  // whatever the order
  const Model model = builder.build();
  EXPECT_EQ(coordinate_names(model), (Names{"shoulder", "elbow"}));
  EXPECT_FALSE(model->tree.one_to_one);
  const Drive& drive = model->tree.drive[3];
  EXPECT_EQ(drive.velocity, 1);
  EXPECT_NEAR(drive.multiplier, -6, rounding);
  EXPECT_NEAR(drive.offset, 0.7, rounding);
  EXPECT_EQ(model->joints[3].name, "finger");
  EXPECT_EQ(model->joints[3].coordinates, (std::vector<int>{1}));
  const double elbow = 0.2;
  const Pose X = model.X_WL(Eigen::Vector2d(0, elbow), model.link("tip"));
  const Mat3 R = rotation_from_rpy(0, elbow - 3 * elbow + 0.1, 0);
  EXPECT_LT((X.R - R).norm(), rounding);
  const Vec3 p = Vec3(0, 0, 0.5) + rotation_from_rpy(0, elbow, 0) * Vec3(0, 0, -1) +
                 R * Vec3(0, -6 * elbow + 0.7, -1);
  EXPECT_LT((X.p - p).norm(), rounding);
}

// A four-bar drawn as a tree: the follower counter-turns, so its link keeps its direction. Its
// mass matrix is that of the plain sum of both.
TEST(Mimic, DynamicsGoThroughTheSharedCoordinate) {
  ModelBuilder builder("parallel");
  const double m = 2, l = 0.6;
  builder.add_link({"crank"}).add_link({"table", {m, {0.3, 0.2, 0.1}, Mat3::Identity()}});
  builder.add_joint(joint("turn", JointType::revolute, "world", "crank"));
  JointSpec counter = joint("counter", JointType::revolute, "crank", "table", {0, 0, -l});
  counter.mimic = Mimic{"turn", -1, 0};
  const Model model = builder.add_joint(counter).build();
  const double q = 0.4, v = 1.5;
  const LagrangianPartials L = model.lagrangian(VecX::Constant(1, q), VecX::Constant(1, v));
  // the table moves on a circle without turning: m l^2, and no inertia of its own
  EXPECT_NEAR(L.L_vv(0, 0), m * l * l, rounding);
  EXPECT_NEAR(L.L_q[0], -m * 9.81 * l * std::sin(q), rounding);
  EXPECT_NEAR(L.L_qq(0, 0), -m * 9.81 * l * std::cos(q), rounding);
  EXPECT_NEAR(L.L_vq(0, 0), 0, rounding);
}

}  // namespace
}  // namespace saltus
