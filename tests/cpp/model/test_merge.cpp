// One description put into another.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::between;
using test::expect_error;

/// base - swing - arm - follow - hand, of rubber; hand follows arm, and is in a group.
ModelBuilder robot() {
  ModelBuilder builder("robot", "base");
  builder.add_body({.name = "arm",
                    .shape = Capsule{0.05, 0.2},
                    .mass = 2,
                    .X = {Mat3::Identity(), Vec3(0, 0, 0.5)},
                    .joint = JointType::revolute,
                    .joint_name = "swing",
                    .axis = Vec3::UnitY()});
  builder.add_link({"hand", solid_sphere(0.5, 0.1)}).add_shape("hand", Sphere{0.1});
  JointSpec follow = test::joint("follow", JointType::revolute, "arm", "hand", {0, 0, 0.3});
  follow.mimic = Mimic{"swing", -0.5, 0.1};
  builder.add_joint(follow).set_group("hand", "hands").add_group_exclusion("hands", "hands");
  return builder.set_material("hand", "rubber");
}

/// A ball that flies above a floor.
ModelBuilder ball(const std::optional<ContactProperties>& floor = {}) {
  ModelBuilder builder("ball");
  builder.add_body({.name = "ball", .shape = Sphere{0.1}, .mass = 1});
  return builder.add_floor({.contact = floor});
}

std::vector<std::string> names(const Model& model) {
  std::vector<std::string> out;
  for (const Link& link : model->links) out.push_back(link.name);
  for (const JointInfo& joint : model->joints) out.push_back(joint.name);
  return out;
}

TEST(Add, TwoRobotsStandInOneWorld) {
  const Pose X{rotation_from_rpy(0.1, 0.2, 0.3), Vec3(1, 2, 3)};
  ModelBuilder world("both");
  world.add(robot().description(), {.prefix = "a_"});
  world.add(robot().description(), {.prefix = "b_", .X = X});
  const Model model = world.build(), alone = robot().build();
  EXPECT_EQ(names(model), (std::vector<std::string>{"world", "a_base", "a_arm", "a_hand", "b_base",
                                                    "b_arm", "b_hand", "a_base", "a_swing",
                                                    "a_follow", "b_base", "b_swing", "b_follow"}));
  ASSERT_EQ(model.n_q(), 2);  // the mimics follow joints of their own robots
  const VecX q = Eigen::Vector2d(0.4, -0.7);
  for (const std::string link : {"arm", "hand"}) {
    const Pose a = alone.X_WL(q.head(1), alone.link(link)),
               b = X * alone.X_WL(q.tail(1), alone.link(link));
    EXPECT_LT((model.X_WL(q, model.link("a_" + link)).p - a.p).norm(), 1e-15);
    EXPECT_LT((model.X_WL(q, model.link("b_" + link)).p - b.p).norm(), 1e-14);
    EXPECT_LT((model.X_WL(q, model.link("b_" + link)).R - b.R).norm(), 1e-14);
  }
  const double m = alone.mass_matrix(q.head(1))(0, 0);
  EXPECT_NEAR(model.mass_matrix(q)(0, 0), m, 1e-14 * m);
  EXPECT_EQ(model.mass_matrix(q)(0, 1), 0);
  EXPECT_NO_THROW(between(model, "a_hand ~ b_hand"));  // a group is one robot's
  EXPECT_EQ(model->pairs.count(0, 3), 1);              // a_arm and b_hand
}

TEST(Add, ARobotRidesOnABody) {
  ModelBuilder world = ball();
  const Pose X{Mat3::Identity(), Vec3(0, 0, 0.1)};
  ModelDescription other = robot().description();
  other.links[0].inertia = solid_box(4, {0.1, 0.1, 0.1});  // the base, which counts here
  world.add(other, {.parent = "ball", .X = X}).set_default_contact({0, 0});
  const Model model = world.build();
  const VecX q = model.state().q;
  EXPECT_DOUBLE_EQ(model.mass_matrix(q)(0, 0), 1 + 2 + 0.5 + 4);
  EXPECT_NEAR(model.X_WL(q, model.link("arm")).p.z(), 0.6, 1e-15);
  expect_error([&] { world.add(ball().description(), {.prefix = "b_", .parent = "ball"}); },
               {"half-space \"b_floor\"", "would move with link \"ball\""});
  expect_error([&] { world.add(robot().description(), {.prefix = "b_", .parent = "bal"}); },
               {"\"bal\", which does not exist; links are world, ball"});
}

TEST(Add, EqualFloorsBecomeOne) {
  const ContactProperties own{0, 0.5};
  ModelBuilder world = ball(own).set_default_contact({0, 0.2});
  world.add(ball().description(), {.prefix = "b_"});
  const Model model = world.build();
  EXPECT_EQ(between(model, "b_ball ~ floor"), own);
  EXPECT_EQ(model->pairs.size(), 3);
  EXPECT_TRUE(model->warnings.empty());
  // the same plane, seen from a root that is turned and lifted
  ModelBuilder turned("turned");
  turned.add_body({.name = "ball", .shape = Sphere{0.1}, .mass = 1});
  turned.add_half_space("ground", {0, -1, 0}, -2);
  const Pose X{rotation_from_rpy(-0.5 * std::acos(-1), 0, 0), Vec3(5, 6, 2)};
  world.add(turned.description(), {.prefix = "c_", .X = X});
  EXPECT_EQ(world.build()->pairs.size(), 6);
  // another plane
  world.add(turned.description(), {.prefix = "d_"});
  EXPECT_NO_THROW(between(world.build(), "ball ~ d_ground"));
  EXPECT_NO_THROW(between(world.build(), "d_ball ~ floor"));
}

TEST(Add, WhatOnlyOneSaysHoldsForBoth) {
  ModelBuilder world = ball();
  world.add(ball({{0, 0.5}}).set_default_contact({0, 0.2}).description(), {.prefix = "b_"});
  EXPECT_EQ(between(world.build(), "ball ~ floor"), (ContactProperties{0, 0.5}));
  EXPECT_EQ(between(world.build(), "ball ~ b_ball"), (ContactProperties{0, 0.2}));
}

TEST(Add, ContradictionsNameBothValues) {
  const auto same = [](ModelBuilder world, const ModelBuilder& other, const AddSpec& how,
                       const std::vector<std::string>& parts) {
    const std::size_t links = world.description().links.size();
    const std::size_t contacts = world.description().materials.contact.size();
    expect_error([&] { world.add(other.description(), how); }, parts);
    EXPECT_EQ(world.description().links.size(), links);
    EXPECT_EQ(world.description().materials.contact.size(), contacts);
  };
  const AddSpec how{.prefix = "b_"};
  same(ball().set_default_contact({0, 0.5}), robot().set_default_contact({1, 0}), how,
       {"default contact", "restitution 0 and friction 0.5", "restitution 1 and friction 0"});
  same(ball({{0, 0.5}}), ball({{0.3, 0}}), how,
       {"half-space \"floor\"", "restitution 0 and friction 0.5", "restitution 0.3"});
  same(ball({{0, 0.5}}), ball().set_default_contact({0.3, 0}), how, {"half-space \"floor\""});
  const auto rubber = [](double e) { return robot().set_contact("rubber", "rubber", {e, 0}); };
  same(rubber(0.1), rubber(0.2), how, {"\"rubber\" and \"rubber\"", "0.1", "0.2", "own_materials"});
  same(robot(), robot().set_adjacent_links(AdjacentLinks::watched), how,
       {"excluded in \"robot\" and watched", "set_adjacent_links"});
}

TEST(Add, NamesThatBothHaveGetAPrefixProposed) {
  ModelBuilder world = robot();
  expect_error([&] { world.add(robot().description()); },
               {"both", "link \"arm\"", "for example \"robot_\""});
  world.add(robot().description(), {.prefix = "robot_"});
  expect_error([&] { world.add(robot().description()); }, {"for example \"robot_2_\""});
  expect_error([&] { world.add(robot().description(), {.prefix = "robot_"}); },
               {"link \"robot_arm\"", "for example \"robot_robot_\""});
  ModelBuilder a("a", "x"), b("b", "y");
  a.add_half_space("wall", {1, 0, 0}).add_link({"l", {}}).set_group("l", "g");
  b.add_half_space("wall", {1, 0, 0}, 1);
  expect_error([&] { a.add(b.description()); }, {"half-space \"wall\""});
  ModelBuilder c("c", "z");
  c.set_group("z", "g");
  expect_error([&] { a.add(c.description()); }, {"group \"g\""});
}

TEST(Add, MaterialsAreSharedUnlessKeptApart) {
  const auto rubber = [](double e) {
    return ball().set_material("ball", "rubber").set_contact("rubber", "floor", {e, 0});
  };
  ModelBuilder world = rubber(0.1);
  world.add(rubber(0.1).description(), {.prefix = "b_"});
  EXPECT_EQ(between(world.build(), "b_ball ~ floor").restitution, 0.1);
  world.add(rubber(0.2).description(), {.prefix = "c_", .own_materials = true});
  EXPECT_EQ(between(world.build(), "ball ~ floor").restitution, 0.1);
  EXPECT_EQ(between(world.build(), "c_ball ~ floor").restitution, 0.2);  // the floor is one, now
}

TEST(Add, FiltersAndHalfSpacesOfTheRootGoAlong) {
  ModelBuilder other = ball({{0, 0.5}});
  other.add_floor({.name = "wall", .normal = {1, 0, 0}, .offset = -1});
  other.add_body({.name = "ghost", .shape = Sphere{0.1}, .mass = 1});
  other.add_exclusion("ghost", "world").add_body_exclusion("ghost", "ball");
  ModelBuilder world("world", "ground");
  world.add(other.description(), {.prefix = "a_", .X = {Mat3::Identity(), Vec3(0, 0, -1)}});
  const Model model = world.build();
  ASSERT_EQ(model->pairs.size(), 2);
  EXPECT_EQ(between(model, "a_ball ~ a_floor"), (ContactProperties{0, 0.5}));
  EXPECT_NO_THROW(between(model, "a_ball ~ a_wall"));
  EXPECT_NEAR(model.gaps(model.state().q).phi[0], -0.1, 1e-15);  // both moved
}

TEST(Add, TheGravityOfTheWorldHoldsAndAWarningSaysSo) {
  ModelBuilder world("world", "ground");
  world.add(robot().set_gravity({0, 0, -1.62}).description());
  const Model model = world.build();
  EXPECT_EQ(model->mass.gravity.z(), -9.81);
  ASSERT_EQ(model->warnings.size(), 1u);
  EXPECT_NE(model->warnings[0].find("\"robot\" is (0 0 -1.62) and not used"), std::string::npos)
      << model->warnings[0];
}

TEST(Add, ABuilderMayBePutIntoItself) {
  ModelBuilder world = robot();
  world.add(world.description(), {.prefix = "b_"}).add(world.description(), {.prefix = "c_"});
  EXPECT_EQ(world.build().n_q(), 4);
  EXPECT_NO_THROW(world.build().link("c_b_hand"));
}

}  // namespace
}  // namespace saltus
