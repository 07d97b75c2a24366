// Bodies and floors in one call, who says what of a contact, and what is warned of.
#include <gtest/gtest.h>

#include <functional>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::between;
using test::expect_error;

TEST(AddBody, IsALinkAShapeAndAJoint) {
  const Pose X{rotation_from_rpy(0.1, 0.2, 0.3), Vec3(1, 2, 3)};
  const Box box{{0.1, 0.2, 0.3}};
  ModelBuilder one, three;
  one.add_body({.name = "cube", .shape = box, .mass = 2, .X = X});
  three.add_link({"cube", solid_box(2, box.half)}).add_shape("cube", box);
  three.add_joint(
      {.name = "cube", .type = JointType::floating, .parent = "world", .child = "cube", .X_PJ = X});
  const Model a = one.build(), b = three.build();
  EXPECT_EQ(a->joints[0].name, "cube");
  EXPECT_EQ(a->coordinates[0].name, "cube_x");
  EXPECT_EQ(a->shapes[0].name, "cube");
  const VecX q = a.state({{"cube_x", 0.1}, {"cube_y", 0.2}, {"cube_z", 0.3}}).q;
  EXPECT_EQ(a.mass_matrix(q), b.mass_matrix(q));
  EXPECT_EQ(a.X_WL(q, 1).R, b.X_WL(q, 1).R);
  EXPECT_EQ(a.X_WL(q, 1).p, b.X_WL(q, 1).p);
}

TEST(AddBody, HasOtherJointsParentsAndNames) {
  ModelBuilder builder;
  builder.add_body({.name = "arm",
                    .shape = Capsule{0.05, 0.2},
                    .density = 1000,
                    .X = {Mat3::Identity(), Vec3(0, 0, 1)},
                    .joint = JointType::revolute,
                    .joint_name = "elbow",
                    .parent = "cart",  // added later
                    .axis = Vec3::UnitY()});
  builder.add_body(
      {.name = "cart", .shape = Box{{1, 1, 1}}, .mass = 1, .joint = JointType::prismatic});
  builder.add_body({.name = "table", .shape = Box{{1, 1, 0.1}}, .joint = JointType::fixed});
  const Model model = builder.build();
  EXPECT_EQ(model->coordinates[0].name, "cart");
  EXPECT_EQ(model->coordinates[1].name, "elbow");
  EXPECT_DOUBLE_EQ(model->links[1].mass, 1000 * volume(Capsule{0.05, 0.2}));
  EXPECT_EQ(model->links[3].joint, -1);
  EXPECT_EQ(model->links[3].mass, 0);
}

TEST(AddBody, MistakesAreNamedAndNothingIsAdded) {
  ModelBuilder builder;
  builder.add_body({.name = "a", .shape = Sphere{1}, .mass = 1});
  builder.add_link({"b", {}});
  const auto refuse = [&](const BodySpec& body, const std::string& part) {
    expect_error([&] { builder.add_body(body); }, {part});
    EXPECT_EQ(builder.description().links.size(), 3u) << part;
    EXPECT_EQ(builder.description().joints.size(), 1u) << part;
    EXPECT_EQ(builder.description().shapes.size(), 1u) << part;
  };
  refuse({.name = "c", .shape = Sphere{1}}, "\"c\" has neither mass [kg] nor density");
  refuse({.name = "c", .shape = Sphere{1}, .mass = 1, .density = 1}, "a mass and a density");
  refuse({.name = "c", .shape = Sphere{1}, .mass = 0}, "mass 0; it is finite and positive");
  refuse({.name = "c", .shape = Sphere{1}, .density = -1}, "density -1");
  refuse({.name = "c", .shape = Sphere{-1}, .density = 1}, "sphere of size");
  refuse({.name = "c", .shape = Sphere{}, .mass = 1}, "sphere of size");
  refuse({.name = "c", .shape = HalfSpace{}, .mass = 1}, "add_floor");
  refuse({.name = "", .shape = Sphere{1}, .mass = 1}, "has no name");
  refuse({.name = "b", .shape = Sphere{1}, .mass = 1}, "two links are named \"b\"");
  refuse({.name = "c", .shape = Sphere{1}, .mass = 1, .joint_name = "a"},
         "two joints are named \"a\"");
  refuse({.name = "c", .shape = Sphere{1}, .mass = 1, .axis = Vec3::Zero()}, "zero axis");
  refuse({.name = "c", .shape = Sphere{1}, .mass = 1, .X = {2 * Mat3::Identity(), {0, 0, 0}}},
         "no rotation");
  builder.add_joint(test::joint("d", JointType::floating, "world", "b"));
  expect_error([&] { builder.add_body({.name = "d", .shape = Sphere{1}, .mass = 1}); },
               {"give it a joint_name"});
}

/// Balls a of steel and b of nothing.
ModelBuilder balls() { return test::two_balls().set_material("a", "steel"); }

TEST(AddFloor, TheFirstThatIsSaidHolds) {
  const auto floor = [](const std::optional<ContactProperties>& contact) {
    return balls().add_floor({.contact = contact});
  };
  const ContactProperties pair{0.1, 0.1}, own{0.2, 0.2}, all{0.3, 0.3};
  ModelBuilder builder = floor(own).set_contact("steel", "floor", pair).set_default_contact(all);
  EXPECT_EQ(between(builder.build(), "a ~ floor"), pair);
  EXPECT_EQ(between(builder.build(), "b ~ floor"), own);
  EXPECT_EQ(between(builder.build(), "a ~ b"), all);
  EXPECT_EQ(between(floor({}).set_default_contact(all).build(), "b ~ floor"), all);
  EXPECT_EQ(between(floor(own).build(), "a ~ floor"), own);
  EXPECT_EQ(between(floor(own).build(), "a ~ b"), (ContactProperties{1, 0}));
}

TEST(AddFloor, EachHasItsOwnProperties) {
  ModelBuilder builder = balls();
  builder.add_floor({.contact = {{0.1, 0.5}}, .material = "ice"});
  builder.add_floor({.name = "wall",
                     .normal = {2, 0, 0},
                     .offset = -6,
                     .contact = {{0.7, 0}},
                     .material = "ice"});
  builder.add_half_space("ceiling", {0, 0, -1}, -9);
  builder.set_material("world", "clay").set_contact("clay", "steel", {0.9, 0});
  const Model model = builder.build();
  EXPECT_EQ(between(model, "b ~ floor"), (ContactProperties{0.1, 0.5}));
  EXPECT_EQ(between(model, "b ~ wall"), (ContactProperties{0.7, 0}));
  EXPECT_EQ(between(model, "a ~ ceiling"), (ContactProperties{0.9, 0}));  // of the root's clay
  EXPECT_EQ(between(model, "a ~ floor"), (ContactProperties{0.1, 0.5}));  // not of it
  builder.set_contact("ice", "steel", {0, 0.05});
  EXPECT_EQ(between(builder.build(), "a ~ floor"), (ContactProperties{0, 0.05}));
  EXPECT_EQ(between(builder.build(), "a ~ wall"), (ContactProperties{0, 0.05}));
  EXPECT_NEAR(model.gaps(model.state().q).phi.maxCoeff(), 9 - 0.1, 1e-12);
}

TEST(Scene, AFloorsNormalIsOfAnyLength) {
  for (const double length : {1e-300, 1e-100, 1.0, 1e100, 1e300}) {
    ModelBuilder b("scene");
    b.add_floor({.normal = {0, 0, length}, .offset = 0.25 * length});
    b.add_body(
        {.name = "ball", .shape = Sphere{0.5}, .mass = 1, .X = {Mat3::Identity(), {0, 0, 3}}});
    const Model model = b.build();
    const Gaps gaps = model.gaps(model.neutral());
    EXPECT_NEAR(gaps.phi[0], 2.25, 1e-15) << length;
    EXPECT_EQ(gaps.normal(0, 2), 1);
  }
}

TEST(AddFloor, MistakesAreNamedAndNothingIsAdded) {
  ModelBuilder builder = balls().add_floor();
  const auto refuse = [&](const FloorSpec& floor, const std::string& part) {
    expect_error([&] { builder.add_floor(floor); }, {part});
    EXPECT_EQ(builder.description().shapes.size(), 3u) << part;
  };
  refuse({.offset = 1}, "two half-spaces are named \"floor\"");
  refuse({.name = "ground", .normal = {0, 0, 3}},
         "\"ground\" is the plane of half-space \"floor\"");
  refuse({.name = "wall", .normal = {0, 0, 0}}, "normal");
  refuse({.name = ""}, "no name");
  refuse({.name = "ice", .offset = 1, .contact = {{1.5, 0}}}, "restitution 1.5");
  refuse({.name = "ice", .offset = 1, .contact = {{0, -1}}}, "\"ice\"");
  expect_error([&] { builder.set_material("floor", "ice").build(); }, {"add_floor(material=...)"});
}

std::string warning_of(const ModelBuilder& builder) {
  const Model model = builder.build();
  return model->warnings.empty() ? "" : model->warnings.back();
}

TEST(Warnings, TellOfFreeBodiesOnFloorsThatNothingIsSaidOf) {
  EXPECT_EQ(warning_of(balls()), "");
  EXPECT_NE(warning_of(balls().add_floor()).find("\"a\" (and 1 more) meets \"floor\""),
            std::string::npos)
      << warning_of(balls().add_floor());
  ModelBuilder one;
  one.add_body({.name = "a", .shape = Sphere{0.1}, .mass = 1}).add_floor({.contact = {{1, 0}}});
  EXPECT_EQ(warning_of(one), "");
  EXPECT_EQ(warning_of(balls().add_floor().set_default_contact({1, 0})), "");
  ModelBuilder builder = balls().add_floor().set_contact("steel", "floor", {0, 0});
  EXPECT_NE(warning_of(builder).find("where \"b\" meets"), std::string::npos);
  EXPECT_EQ(warning_of(builder.add_exclusion("b", "world").add_exclusion("a", "b")), "");
  EXPECT_NE(warning_of(balls().add_half_space("hill", {0, 1, 1})).find("\"hill\""),
            std::string::npos);
}

// Boxes on a floor of wood are no billiard balls between themselves.
TEST(Warnings, TellOfBodiesThatOnlyTheirFloorIsSaidOf) {
  ModelBuilder builder = balls().add_floor({.contact = {{0, 0.5}}});
  EXPECT_NE(warning_of(builder).find("where \"a\" meets \"b\""), std::string::npos)
      << warning_of(builder);
  EXPECT_EQ(warning_of(builder.set_material("b", "wood").set_contact("steel", "wood", {0, 0})), "");
  ModelBuilder legs;  // what hangs on one body has the word of whoever described it
  legs.add_body({.name = "trunk", .shape = Sphere{0.1}, .mass = 1});
  for (const std::string name : {"left", "right"}) {
    legs.add_body({.name = name,
                   .shape = Sphere{0.1},
                   .mass = 1,
                   .joint = JointType::revolute,
                   .parent = "trunk"});
  }
  EXPECT_EQ(warning_of(legs.add_floor({.contact = {{0, 0.5}}})), "");
  EXPECT_EQ(warning_of(balls()), "");  // billiards
}

// A hinged arm is the paper's world; what a free body carries falls with it.
TEST(Warnings, TellOfWhatABodyCarriesButNotOfWhatHangs) {
  ModelBuilder builder;
  builder.add_body({.name = "arm", .shape = Sphere{0.1}, .mass = 1, .joint = JointType::revolute});
  builder.add_floor();
  EXPECT_EQ(warning_of(builder), "");
  builder.add_link({"trunk", solid_sphere(1, 1)});
  builder.add_joint(test::joint("free", JointType::floating, "world", "trunk"));
  EXPECT_EQ(warning_of(builder), "");  // it has no shape
  builder.add_body({.name = "foot",
                    .shape = Sphere{0.1},
                    .mass = 1,
                    .joint = JointType::revolute,
                    .parent = "trunk"});
  EXPECT_NE(warning_of(builder).find("where \"trunk\" meets"), std::string::npos);
}

TEST(Description, BuildsTheSameModelAgain) {
  ModelBuilder builder = balls();
  builder.add_floor({.contact = {{0.1, 0.5}}}).add_floor({.name = "wall", .normal = {1, 0, 0}});
  builder.add_body({.name = "c", .shape = Ellipsoid{{1, 2, 3}}, .density = 3});
  const Model model = builder.build(), again = ModelBuilder(*model->description).build();
  EXPECT_EQ(again->warnings, model->warnings);
  ASSERT_EQ(again->pairs.size(), model->pairs.size());
  for (int k = 0; k < model->pairs.size(); ++k) {
    EXPECT_EQ(again.pair_name(k), model.pair_name(k));
    EXPECT_EQ(again.contact_properties(k), model.contact_properties(k));
  }
}

}  // namespace
}  // namespace saltus
