// Inertials, the root, and what else the file says of links.
#include <cmath>
#include <locale>

#include "urdf/urdf_text.hpp"

namespace saltus {
namespace {

using namespace test;

/// A body's inertia in the frame of a link that it carries.
BodyInertia in_link(const Model& model, const std::string& name) {
  const Link& link = model->links[model.link(name)];
  return transform(link.X_JL.inverse(), model->mass.body[link.joint]);
}

std::string inertial(const std::string& origin, const std::string& mass,
                     const std::string& inertia) {
  return "<inertial>" + origin + "<mass value=\"" + mass + "\"/><inertia " + inertia +
         "/></inertial>";
}

std::string free_body(const std::string& inertial) {
  return robot("<link name=\"base\"/>\n<link name=\"body\">" + inertial + "</link>" +
               joint("j", "floating", "base", "body"));
}

TEST(UrdfLinks, AllSixMomentsAreRead) {
  const std::string moments =
      "ixx=\"0.05\" ixy=\"0.001\" ixz=\"-0.002\" iyy=\"0.06\" iyz=\"0.003\" izz=\"0.07\"";
  const BodyInertia body =
      in_link(load(free_body(inertial("<origin xyz=\"0.1 -0.2 0.3\"/>", "1.5", moments))), "body");
  Mat3 expected;
  expected << 0.05, 0.001, -0.002, 0.001, 0.06, 0.003, -0.002, 0.003, 0.07;
  EXPECT_EQ(body.mass, 1.5);
  expect_near(body.c_J, {0.1, -0.2, 0.3});
  expect_near(body.I_J, expected, 1e-17);
}

// The moments are about the axes of the inertial frame: I_link = R I R^T.
TEST(UrdfLinks, TheInertialFrameMayBeTurned) {
  const std::string moments =
      "ixx=\"0.05\" ixy=\"0\" ixz=\"0\" iyy=\"0.06\" iyz=\"0\" izz=\"0.07\"";
  const BodyInertia body = in_link(
      load(free_body(inertial("<origin xyz=\"1 2 3\" rpy=\"0.3 -0.4 0.5\"/>", "1.5", moments))),
      "body");
  const Mat3 R = rotation_from_rpy(0.3, -0.4, 0.5);
  expect_near(body.I_J, R * Vec3(0.05, 0.06, 0.07).asDiagonal() * R.transpose(), 1e-16);
  expect_near(body.c_J, {1, 2, 3});

  // a right angle about z exchanges x and y
  const BodyInertia turned = in_link(
      load(free_body(inertial("<origin rpy=\"0 0 1.5707963267948966\"/>", "1", moments))), "body");
  expect_near(turned.I_J, Vec3(0.06, 0.05, 0.07).asDiagonal(), 1e-16);
}

// A pendulum's inertia about its pivot, by Steiner: I + m l^2.
TEST(UrdfLinks, MassMatrixOfAPendulum) {
  const std::string moments = "ixx=\"0.2\" ixy=\"0\" ixz=\"0\" iyy=\"0.3\" iyz=\"0\" izz=\"0.4\"";
  const Model model =
      load(robot("<link name=\"base\"/><link name=\"body\">" +
                 inertial("<origin xyz=\"0.5 0 -2\"/>", "3", moments) + "</link>" +
                 joint("j", "continuous", "base", "body", "<axis xyz=\"0 1 0\"/>")));
  EXPECT_DOUBLE_EQ(model.mass_matrix(VecX::Zero(1))(0, 0), 0.3 + 3 * (0.25 + 4));
  EXPECT_DOUBLE_EQ(model.potential_energy(VecX::Zero(1)), 3 * 9.81 * -2);
}

TEST(UrdfLinks, NoInertialIsNoMass) {
  const Model model =
      load(robot("<link name=\"base\"/><link name=\"gimbal\"/>" + ball_link("body", "") +
                 joint("a", "continuous", "base", "gimbal") +
                 joint("b", "continuous", "gimbal", "body", "<axis xyz=\"0 1 0\"/>")));
  EXPECT_EQ(model->links[model.link("gimbal")].mass, 0);
  EXPECT_EQ(model->links[model.link("body")].mass, 2);
}

TEST(UrdfLinks, TheRootIsFixedToTheWorldByDefault) {
  const Model model = load(
      robot(ball_link("pelvis") + ball_link("leg") + joint("hip", "continuous", "pelvis", "leg")));
  EXPECT_EQ(model.n_q(), 1);
  EXPECT_EQ(model->links[0].name, "pelvis");
  EXPECT_EQ(model->links[0].joint, -1);
}

TEST(UrdfLinks, TheRootMayFloat) {
  const std::string text =
      robot(ball_link("pelvis") + ball_link("leg") + joint("hip", "continuous", "pelvis", "leg"));
  const Model model = load(text, {.root_joint = JointType::floating});
  ASSERT_EQ(model.n_q(), 8);
  ASSERT_EQ(model.n_v(), 7);
  EXPECT_EQ(model->coordinates[0].name, "root_x");
  EXPECT_EQ(model->coordinates[7].name, "hip");
  EXPECT_EQ(model->links[0].name, "world");
  expect_near(pose_of(model, "pelvis", {{"root_z", 2}}).p, {0, 0, 2});
  EXPECT_DOUBLE_EQ(model.mass_matrix(model.neutral())(0, 0), 4);  // all of the mass
}

TEST(UrdfLinks, TheRootMayMoveOtherwise) {
  const std::string text = robot(ball_link("cart"));
  EXPECT_EQ(load(text, {.root_joint = JointType::spherical}).n_q(), 4);
  const Model flat = load(text, {.root_joint = JointType::planar});
  expect_near(pose_of(flat, "cart", {{"root_x", 1}, {"root_y", 2}}).p, {1, 2, 0});
  const Model lift = load(text, {.root_joint = JointType::prismatic});
  expect_near(pose_of(lift, "cart", {{"root", 2}}).p, {0, 0, 2});
}

TEST(UrdfLinks, TheSolverIsThatOfTheOptions) {
  const std::string text = one_joint("continuous");
  EXPECT_EQ(load(text).solvers()[0].solver, TreeSolver::lu);
  EXPECT_EQ(load(text, {.solver = TreeSolver::sweep}).solvers()[0].solver, TreeSolver::sweep);
}

TEST(UrdfLinks, NamesOfTheRootJointAreNew) {
  const std::string text =
      robot(ball_link("world") + ball_link("leg") + joint("root", "continuous", "world", "leg"));
  EXPECT_EQ(load(text)->links[0].name, "world");
  const Model model = load(text, {.root_joint = JointType::floating});
  EXPECT_EQ(model->links[0].name, "world_");
  EXPECT_EQ(model->coordinates[0].name, "root__x");
  EXPECT_EQ(model->coordinates[7].name, "root");
}

TEST(UrdfLinks, NameSourceAndGravity) {
  const std::string text = "\n  " + one_joint("continuous");
  const Model model = load(text, {.gravity = Vec3(0, -1.62, 0)});
  EXPECT_EQ(model->name, "r");
  EXPECT_EQ(model->source, text);
  EXPECT_EQ(model->mass.gravity, Vec3(0, -1.62, 0));
  EXPECT_EQ(load("<robot><link name=\"a\"/></robot>")->name, "model");
}

TEST(UrdfLinks, OtherProgramsElementsAreSkipped) {
  const std::string body = "<sensor/><drake:x/>";
  std::string text = one_joint("continuous", "<safety_controller k_velocity=\"x\"/>", body);
  text.insert(text.find("</robot>"), "<material/><gazebo><a/></gazebo><my:thing/><ros2_control/>");
  EXPECT_TRUE(load(text)->warnings.empty());
}

TEST(UrdfLinks, WhatUrdfDoesNotKnowIsNamed) {
  const Model model = load(
      one_joint("continuous", "\n<axis xzy=\"1\" xyz=\"0 0 1\"/>\n<spring/>", "\n<colision/>"));
  expect_warning(model,
                 {"URDF text:4: link \"body\"", "<colision>", "known are inertial, collision"});
  expect_warning(model, {"URDF text:6: <axis> of joint \"j\"", "xzy", "known are xyz"});
  expect_warning(model, {"URDF text:7: joint \"j\"", "<spring>", "known are origin, parent"});
  EXPECT_EQ(model->warnings.size(), 3u);
}

TEST(UrdfLinks, NumbersDoNotDependOnTheLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const Model model = load(one_joint("continuous", "<origin xyz=\"1234.5 -0.25\t1e-3\"/>"));
  std::locale::global(before);
  expect_near(pose_of(model, "body").p, {1234.5, -0.25, 1e-3}, 0);
}

TEST(UrdfLinks, NumbersKeepAllTheirDigits) {
  const Model model = load(
      one_joint("continuous", "<origin xyz=\"0.1 0.30000000000000004 1.7976931348623157e300\"/>"));
  EXPECT_EQ(pose_of(model, "body").p, Vec3(0.1, 0.30000000000000004, 1.7976931348623157e300));
}

}  // namespace
}  // namespace saltus
