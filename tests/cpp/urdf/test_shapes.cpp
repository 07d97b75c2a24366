// Collision shapes: those of URDF, capsules both ways, half-spaces, exclusions.
#include <gtest/gtest.h>

#include "urdf/urdf_text.hpp"

namespace saltus {
namespace {

using namespace test;

std::string collision(const std::string& shape, const std::string& origin = "") {
  return "<collision>" + origin + "<geometry>" + shape + "</geometry></collision>";
}

/// `body` on a vertical slide, with this in its link, and this block.
std::string on_a_slide(const std::string& in_body, const std::string& block = "") {
  return robot("<link name=\"base\"/>\n" + ball_link("body", in_body) +
               joint("j", "prismatic", "base", "body",
                     "<axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"9\"/>") +
               block);
}

Pose in_link(const Model& model, const PlacedShape& shape) {
  return model->links[shape.link].X_JL.inverse() * shape.X_JG;
}

TEST(UrdfShapes, SphereBoxCylinderCapsule) {
  const Model model = load(
      on_a_slide(collision("<sphere radius=\"0.1\"/>", "<origin xyz=\"1 2 3\"/>") +
                 collision("<box size=\"0.2 0.4 0.6\"/>", "<origin rpy=\"0.1 0.2 0.3\"/>") +
                 collision("<cylinder radius=\"0.3\" length=\"0.8\"/>") +
                 collision("<capsule radius=\"0.2\" length=\"0.5\"/>", "<origin xyz=\"0 0 1\"/>")));
  ASSERT_EQ(model->shapes.size(), 4u);
  EXPECT_EQ(std::get<Sphere>(model->shapes[0].shape).radius, 0.1);
  EXPECT_EQ(std::get<Box>(model->shapes[1].shape).half, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(std::get<Cylinder>(model->shapes[2].shape).radius, 0.3);
  EXPECT_EQ(std::get<Cylinder>(model->shapes[2].shape).half_length, 0.4);
  EXPECT_EQ(std::get<Capsule>(model->shapes[3].shape).radius, 0.2);
  EXPECT_EQ(std::get<Capsule>(model->shapes[3].shape).half_length, 0.25);
  expect_near(in_link(model, model->shapes[0]).p, {1, 2, 3});
  expect_near(in_link(model, model->shapes[1]).R, rotation_from_rpy(0.1, 0.2, 0.3), 4e-16);
  expect_near(in_link(model, model->shapes[3]).p, {0, 0, 1});
}

TEST(UrdfShapes, SeveralOnALinkAreNumbered) {
  const std::string ball = collision("<sphere radius=\"0.1\"/>");
  const Model model = load(on_a_slide(ball + ball + ball));
  ASSERT_EQ(model->shapes.size(), 3u);
  EXPECT_EQ(model->shapes[0].name, "body");
  EXPECT_EQ(model->shapes[1].name, "body#2");
  EXPECT_EQ(model->shapes[2].name, "body#3");
}

TEST(UrdfShapes, CapsulesInGeometryAndInTheBlockAreTheSame) {
  const std::string origin = "<origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/>";
  const Model native =
      load(on_a_slide(collision("<capsule radius=\"0.2\" length=\"0.5\"/>", origin)));
  const Model block =
      load(on_a_slide("", "<saltus><capsule link=\"body\" radius=\"0.2\" length=\"0.5\">" + origin +
                              "</capsule></saltus>"));
  ASSERT_EQ(native->shapes.size(), 1u);
  ASSERT_EQ(block->shapes.size(), 1u);
  for (const Model& model : {native, block}) {
    const PlacedShape& shape = model->shapes[0];
    EXPECT_EQ(shape.name, "body");
    EXPECT_EQ(std::get<Capsule>(shape.shape).radius, 0.2);
    EXPECT_EQ(std::get<Capsule>(shape.shape).half_length, 0.25);
    expect_near(in_link(model, shape).p, {1, 2, 3});
    expect_near(in_link(model, shape).R, rotation_from_rpy(0.1, 0.2, 0.3), 4e-16);
  }
}

TEST(UrdfShapes, WhatIsNoShapeIsAWarning) {
  const Model model = load(on_a_slide("\n" + collision("<ellipsoid radii=\"1 2 3\"/>") +
                                      collision("<sphere radius=\"0.1\"/>") + "\n<collision/>\n" +
                                      collision("<mesh filename=\"nowhere/a.stl\"/>") +
                                      collision("<box size=\"1 1 1\"/>")));
  ASSERT_EQ(model->shapes.size(), 2u);
  EXPECT_EQ(shape_name(model->shapes[1].shape), "box");
  expect_warning(model, {"URDF text:4: <geometry> of link \"body\"", "<ellipsoid>",
                         "known are sphere, box, cylinder, capsule, mesh"});
  expect_warning(model, {"URDF text:5: link \"body\" has a <collision> without a shape"});
  expect_warning(model, {"URDF text:6: link \"body\"", "mesh, \"nowhere/a.stl\"", "not found"});
  EXPECT_EQ(model->warnings.size(), 3u);
}

TEST(UrdfExtension, HalfSpaceIsSolidBelowItsPlane) {
  const std::string ball = collision("<sphere radius=\"0.1\"/>");
  const Model model =
      load(on_a_slide(ball,
                      "<saltus><half_space name=\"floor\" normal=\"0 0 2\" offset=\"0.5\"/>"
                      "<half_space name=\"ceiling\" normal=\"0 0 -1\" offset=\"-4\"/></saltus>"));
  const Gaps gaps = model.gaps(model.state({{"j", 1.0}}).q);
  ASSERT_EQ(gaps.names, (std::vector<std::string>{"body ~ floor", "body ~ ceiling"}));
  EXPECT_DOUBLE_EQ(gaps.phi[0], 1 - 0.1 - 0.25);  // plane 2 z = 0.5
  EXPECT_DOUBLE_EQ(gaps.phi[1], 4 - 0.1 - 1);
}

TEST(UrdfExtension, HalfSpaceHasDefaults) {
  const Model model =
      load(on_a_slide(collision("<sphere radius=\"0.1\"/>"), "<saltus><half_space/></saltus>"));
  const Gaps gaps = model.gaps(model.state({{"j", 1.0}}).q);
  ASSERT_EQ(gaps.names, std::vector<std::string>{"body ~ half_space"});
  EXPECT_DOUBLE_EQ(gaps.phi[0], 0.9);
}

TEST(UrdfExtension, HalfSpacesStayWithTheWorldUnderAFloatingRoot) {
  const std::string text = robot(ball_link("ball", collision("<sphere radius=\"0.1\"/>")) +
                                 "<saltus><half_space name=\"floor\"/></saltus>");
  EXPECT_EQ(load(text)->pairs.size(), 0);  // both are fixed to the world
  const Model model = load(text, {.root_joint = JointType::floating});
  EXPECT_DOUBLE_EQ(model.gaps(model.state({{"root_z", 3.0}}).q).phi[0], 2.9);
}

TEST(UrdfExtension, ExcludedLinksHaveNoPair) {
  const std::string ball = collision("<sphere radius=\"0.1\"/>");
  const std::string links =
      "<link name=\"base\"/>" + ball_link("a", ball) + ball_link("b", ball) + ball_link("c", ball);
  const std::string joints = joint("ja", "floating", "base", "a") +
                             joint("jb", "floating", "base", "b") +
                             joint("jc", "floating", "base", "c");
  EXPECT_EQ(load(robot(links + joints))->pairs.size(), 3);
  const Model model =
      load(robot(links + joints + "<saltus><exclude link1=\"c\" link2=\"a\"/></saltus>"));
  EXPECT_EQ(model.gaps(model.neutral()).names, (std::vector<std::string>{"a ~ b", "b ~ c"}));
}

TEST(UrdfExtension, SeveralBlocksAddUp) {
  const Model model =
      load(on_a_slide("",
                      "<saltus/><saltus><half_space name=\"a\"/></saltus><saltus><half_space "
                      "name=\"b\"/></saltus>"));
  EXPECT_EQ(model->shapes.size(), 2u);
}

}  // namespace
}  // namespace saltus
