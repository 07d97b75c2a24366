// Which pairs of shapes are watched, and what they are called.
#include <gtest/gtest.h>

#include <set>

#include <algorithm>

#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::arm;
using test::joint;
using test::some_body;
using test::two_balls;

using Names = std::vector<std::string>;

Names pair_names(const Model& model) {
  Names names;
  for (int i = 0; i < model->pairs.size(); ++i) {
    names.push_back(model.pair_name(static_cast<int>(i)));
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A chain of links a, b, c, d with a ball on each, joined by joints of one type.
ModelBuilder beads(JointType type) {
  ModelBuilder builder("beads");
  std::string last = "world";
  for (const std::string name : {"a", "b", "c", "d"}) {
    builder.add_link({name, some_body()}).add_shape(name, Sphere{0.1});
    builder.add_joint(joint("to_" + name, type, last, name, {0, 0, -1}));
    last = name;
  }
  return builder;
}

TEST(Pairs, NeighboursAreNotWatched) {
  const Names apart{"a ~ c", "a ~ d", "b ~ d"};
  EXPECT_EQ(pair_names(beads(JointType::revolute).build()), apart);
  EXPECT_EQ(pair_names(beads(JointType::prismatic).build()), apart);
  EXPECT_EQ(pair_names(beads(JointType::spherical).build()), apart);
}

TEST(Pairs, FreeAndPlanarJointsMakeNoNeighbours) {
  const Names all{"a ~ b", "a ~ c", "a ~ d", "b ~ c", "b ~ d", "c ~ d"};
  EXPECT_EQ(pair_names(beads(JointType::planar).build()), all);
  EXPECT_EQ(pair_names(beads(JointType::floating).build()), all);
  EXPECT_EQ(pair_names(two_balls().build()), (Names{"a ~ b"}));
}

TEST(Pairs, WeldedLinksAreOneBody) {
  EXPECT_EQ(pair_names(beads(JointType::fixed).build()), Names{});
  // a ball welded to `lower` is a neighbour of `upper`, and no pair with `lower` itself
  ModelBuilder builder = arm().add_link({"hand", some_body()}).add_link({"post"});
  builder.add_joint(joint("mount", JointType::fixed, "lower", "hand"));
  builder.add_joint(joint("stand", JointType::fixed, "world", "post"));
  for (const std::string name : {"upper", "lower", "hand", "post"}) {
    builder.add_shape(name, Sphere{0.1});
  }
  // the post is the world: a neighbour of `upper`, not of what hangs on it
  EXPECT_EQ(pair_names(builder.build()), (Names{"hand ~ post", "lower ~ post"}));
}

TEST(Pairs, SiblingsAreWatched) {
  ModelBuilder builder("siblings");
  for (const std::string name : {"a", "b"}) {
    builder.add_link({name, some_body()}).add_shape(name, Sphere{0.1});
    builder.add_joint(joint("swing_" + name, JointType::revolute, "world", name));
  }
  EXPECT_EQ(pair_names(builder.build()), (Names{"a ~ b"}));
}

// A floor is there to be fallen on, by whatever joint a body is held to the world.
TEST(Pairs, HalfSpacesAreWatchedByAll) {
  ModelBuilder builder = arm().add_half_space("floor", Vec3::UnitZ());
  builder.add_half_space("wall", Vec3::UnitX(), -3);
  builder.add_shape("upper", Sphere{0.1}).add_shape("lower", Sphere{0.1});
  builder.add_shape("world", Sphere{0.1}, {Mat3::Identity(), {5, 0, 0}});
  const Names expected{"lower ~ floor", "lower ~ wall", "lower ~ world", "upper ~ floor",
                       "upper ~ wall"};
  EXPECT_EQ(pair_names(builder.build()), expected);
}

TEST(Pairs, ExclusionsHoldInEitherOrder) {
  ModelBuilder builder = beads(JointType::revolute);
  builder.add_exclusion("c", "a").add_exclusion("b", "d");
  EXPECT_EQ(pair_names(builder.build()), (Names{"a ~ d"}));
  ModelBuilder floor = two_balls().add_half_space("floor", Vec3::UnitZ());
  floor.add_exclusion("world", "a");
  EXPECT_EQ(pair_names(floor.build()), (Names{"a ~ b", "b ~ floor"}));
}

TEST(Pairs, ShapesAreNumberedWithinTheirLink) {
  ModelBuilder builder = two_balls();
  builder.add_shape("a", Sphere{0.05}, {Mat3::Identity(), {0.3, 0, 0}});
  builder.add_shape("a", Sphere{0.05}, {Mat3::Identity(), {0.6, 0, 0}});
  const Model model = builder.build();
  EXPECT_EQ(pair_names(model), (Names{"a ~ b", "b ~ a#2", "b ~ a#3"}));
  EXPECT_EQ(model->shapes[0].name, "a");
  EXPECT_EQ(model->shapes[0].link, model.link("a"));
  EXPECT_EQ(model->shapes[3].name, "a#3");
}

// a is the sphere where only one is; the chain leads from b to a.
TEST(Pairs, TheSphereComesFirst) {
  ModelBuilder builder("mixed");
  builder.add_link({"ball", solid_sphere(1, 0.1)}).add_link({"crate", some_body()});
  builder.add_shape("crate", Box{{1, 2, 3}}).add_shape("ball", Sphere{0.25});
  builder.add_joint(joint("slide", JointType::prismatic, "world", "crate"));
  builder.add_joint(joint("free", JointType::floating, "world", "ball"));
  const Model model = builder.build();
  ASSERT_EQ(model->pairs.size(), 1);
  const Pair pair = model.pair(0);
  EXPECT_EQ(model.pair_name(0), "ball ~ crate");
  EXPECT_EQ(model->shapes[static_cast<std::size_t>(pair.a)].name, "ball");
  EXPECT_EQ(pair.chain.size(), 7u);
  EXPECT_EQ(pair.chain.front().joint, 0);  // the crate's, nearest to b
  EXPECT_EQ(pair.chain.front().sign, -1);
  EXPECT_EQ(pair.chain.back().sign, 1);
  EXPECT_DOUBLE_EQ(pair.touch, 1e-10 * 0.25);  // of the smaller shape
}

// Boxes touch by corners and crossing edges, each with a name of its own.
TEST(Pairs, OfBoxesAreTheirParts) {
  ModelBuilder builder("crates");
  for (const std::string name : {"a", "b"}) {
    builder.add_link({name, some_body()});
    builder.add_joint(joint("free_" + name, JointType::floating, "world", name));
    builder.add_shape(name, Box{{1, 1, 1}});
  }
  const Model model = builder.build();
  ASSERT_EQ(model->pairs.size(), 8 + 8 + 144);
  EXPECT_EQ(model.pair_name(0), "a[+++] ~ b");
  EXPECT_EQ(model.pair_name(8), "b[+++] ~ a");
  EXPECT_EQ(model.pair_name(16), "a[x++] ~ b[x++]");
  EXPECT_EQ(model.pair(8).b, 0);
  const Names names = pair_names(model);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_TRUE(model->warnings.empty());
  EXPECT_THROW(model.pair(160), ModelError);
  EXPECT_THROW(model.pair(-1), ModelError);
}

TEST(Pairs, AreCountedByKind) {
  ModelBuilder builder = two_balls();
  builder.add_half_space("floor", Vec3::UnitZ());
  const std::map<std::pair<std::string, std::string>, int> expected = {
      {{"half_space", "sphere"}, 2}, {{"sphere", "sphere"}, 1}};
  EXPECT_EQ(builder.build().pair_kinds(), expected);
}

TEST(HalfSpace, LiesBelowItsPlane) {
  ModelBuilder builder = two_balls();
  builder.add_half_space("slope", Vec3(0, 3, 4), 10);  // (0, .6, .8).x = 2
  const Model model = builder.build();
  VecX q = model.neutral();
  q.head(3) = Vec3(7, 0.6, 0.8) * 3;  // 3 along the normal
  q.segment(7, 3) = Vec3(0, 9, 0);
  const Gaps gaps = model.gaps(q);
  const auto gap_of = [&](const std::string& name) {
    const auto found = std::find(gaps.names.begin(), gaps.names.end(), name);
    EXPECT_NE(found, gaps.names.end()) << name;
    return gaps.phi[found - gaps.names.begin()];
  };
  EXPECT_NEAR(gap_of("a ~ slope"), 3 - 2 - 0.1, 1e-14);        // rounding of numbers up to 21
  EXPECT_NEAR(gap_of("b ~ slope"), 0.6 * 9 - 2 - 0.1, 1e-14);  // the same
}

// The frame of a shape is given in its link's, whatever frame the joint has inside.
TEST(Shapes, MoveWithTheirLink) {
  const Pose X_LG{rotation_from_rpy(0.3, 1.1, -0.4), {0.2, -0.1, 0.4}};
  ModelBuilder builder = arm().add_link({"hand", some_body()});
  JointSpec mount = joint("mount", JointType::fixed, "lower", "hand", {0.1, 0.2, -0.3});
  mount.X_PJ.R = rotation_from_rpy(0.7, 0.2, 0.5);
  builder.add_joint(mount).add_shape("hand", Box{{1, 2, 3}}, X_LG);
  const Model model = builder.build();
  const VecX q = Eigen::Vector2d(0.4, -0.9);
  Kinematics kin(model->tree);
  set_configuration(model->tree, q, kin);
  const PlacedShape& shape = model->shapes[0];
  const Pose X_WG = kin.X_WJ(model->tree, shape.joint) * shape.X_JG;
  const Pose expected = model.X_WL(q, model.link("hand")) * X_LG;
  EXPECT_LT((X_WG.R - expected.R).norm(), 1e-14);  // rounding of a few products
  EXPECT_LT((X_WG.p - expected.p).norm(), 1e-14);
}

TEST(Pairs, CanBeLeftOut) {
  const Model model = two_balls().add_half_space("floor", Vec3::UnitZ()).build();
  EXPECT_EQ(model->pairs.size(), 3);
  const Model without = model.without_collisions();
  EXPECT_TRUE(without->pairs.empty());
  EXPECT_EQ(without->shapes.size(), model->shapes.size());
  EXPECT_EQ(without.n_q(), model.n_q());
  EXPECT_EQ(model->pairs.size(), 3);  // the first is as it was
}

}  // namespace
}  // namespace saltus
