// Mistakes that show when the whole description is there: in check() and in build().
#include <gtest/gtest.h>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::arm;
using test::joint;
using test::some_body;

/// Both check() and build() refuse.
void expect_refusal(const ModelBuilder& builder, const std::string& element,
                    const std::string& name, const std::vector<std::string>& mentions) {
  EXPECT_THROW(builder.check(), ModelError);
  test::expect_error([&] { builder.build(); }, element, name, mentions);
}

TEST(BuildErrors, UnknownLinks) {
  ModelBuilder parent = arm(), child = arm(), shape = arm(), exclusion = arm();
  parent.add_link({"hand", some_body()});
  parent.add_joint(joint("wrist", JointType::revolute, "lowr", "hand"));
  expect_refusal(parent, "joint", "wrist",
                 {"\"wrist\"", "parent link \"lowr\"", "world, upper, lower, hand"});
  child.add_joint(joint("wrist", JointType::revolute, "lower", "hnd"));
  expect_refusal(child, "joint", "wrist", {"child link \"hnd\"", "world, upper, lower"});
  shape.add_shape("lowr", Sphere{1});
  expect_refusal(shape, "link", "lowr", {"sphere", "\"lowr\"", "world, upper, lower"});
  exclusion.add_exclusion("upper", "lowr");
  expect_refusal(exclusion, "link", "lowr", {"exclusion", "\"lowr\"", "world, upper, lower"});
  ModelBuilder other = arm().add_exclusion("uppr", "lower");
  expect_refusal(other, "link", "uppr", {"exclusion", "\"uppr\""});
}

TEST(BuildErrors, LinksThatHangWrongly) {
  ModelBuilder two_parents = arm();
  two_parents.add_joint(joint("other", JointType::revolute, "world", "lower"));
  expect_refusal(two_parents, "joint", "other",
                 {"\"lower\"", "two joints", "\"elbow\"", "\"other\""});
  ModelBuilder root_is_child = arm();
  root_is_child.add_joint(joint("back", JointType::revolute, "lower", "world"));
  expect_refusal(root_is_child, "link", "world", {"root", "\"world\"", "\"back\""});
  ModelBuilder two_roots = arm().add_link({"hand", some_body()});
  expect_refusal(two_roots, "link", "hand", {"two roots", "\"hand\"", "\"world\""});
  ModelBuilder cycle = arm();
  cycle.add_link({"p", some_body()}).add_link({"q", some_body()});
  cycle.add_joint(joint("pq", JointType::revolute, "p", "q"));
  cycle.add_joint(joint("qp", JointType::revolute, "q", "p"));
  expect_refusal(cycle, "link", "p", {"cycle", "p, q", "\"world\""});
  ModelBuilder loop = arm().add_link({"p", some_body()});
  loop.add_joint(joint("pp", JointType::revolute, "p", "p"));
  expect_refusal(loop, "link", "p", {"cycle"});
}

ModelBuilder arm_with_mimic(const std::string& target, JointType type = JointType::revolute) {
  ModelBuilder builder = arm().add_link({"hand", some_body()});
  JointSpec wrist = joint("wrist", type, "lower", "hand");
  wrist.mimic = Mimic{target, 2, 0};
  builder.add_joint(wrist);
  return builder;
}

TEST(BuildErrors, Mimic) {
  expect_refusal(arm_with_mimic("elbw"), "joint", "wrist",
                 {"\"wrist\"", "\"elbw\"", "shoulder, elbow, wrist"});
  expect_refusal(arm_with_mimic("wrist"), "joint", "wrist", {"cycle"});
  expect_refusal(arm_with_mimic("elbow", JointType::planar), "joint", "wrist",
                 {"only joints of one coordinate"});
  expect_refusal(arm_with_mimic("elbow", JointType::fixed), "joint", "wrist",
                 {"only joints of one coordinate"});
  ModelBuilder of_fixed = arm_with_mimic("welded").add_link({"tip", some_body()});
  of_fixed.add_joint(joint("welded", JointType::fixed, "hand", "tip"));
  expect_refusal(of_fixed, "joint", "wrist", {"\"welded\"", "not one coordinate"});
  ModelBuilder ring = arm_with_mimic("finger").add_link({"tip", some_body()});
  JointSpec finger = joint("finger", JointType::revolute, "hand", "tip");
  finger.mimic = Mimic{"wrist", 1, 0};
  ring.add_joint(finger);
  expect_refusal(ring, "joint", "wrist", {"cycle"});
}

TEST(BuildErrors, CoordinatesOfOneName) {
  ModelBuilder builder = arm().add_link({"hand", some_body()}).add_link({"tip", some_body()});
  builder.add_joint(joint("free", JointType::floating, "world", "hand"));
  builder.add_joint(joint("free_x", JointType::prismatic, "hand", "tip"));
  expect_refusal(builder, "joint", "free_x", {"two coordinates", "\"free_x\""});
}

/// A massless chain of two joints, with `tip` at its end.
ModelBuilder chain(const BodyInertia& tip, const JointSpec& first, const JointSpec& second) {
  ModelBuilder builder("chain");
  builder.add_link({"middle"}).add_link({"tip", tip}).add_joint(first).add_joint(second);
  return builder;
}

TEST(BuildErrors, JointsThatMoveNoMass) {
  ModelBuilder leaf = arm().add_link({"hand"});
  leaf.add_joint(joint("wrist", JointType::revolute, "lower", "hand"));
  expect_refusal(leaf, "joint", "wrist", {"\"wrist\"", "moves no mass", "\"hand\""});
  // A point mass on a turning axis, in skew axes so that only rounding is left of its inertia.
  ModelBuilder on_axis = arm().add_link({"hand", {1, {0.3, 0.6, 0.9}, Mat3::Zero()}});
  on_axis.add_joint(
      joint("wrist", JointType::revolute, "lower", "hand", {0.1, 0.2, 0.3}, {1, 2, 3}));
  expect_refusal(on_axis, "joint", "wrist", {"moves no mass"});
  // Two joints on one axis, or along one line: the one below gives way to the one above.
  // Along z no rounding is left, and the pivot is zero exactly.
  const JointType types[] = {JointType::revolute, JointType::prismatic, JointType::helical};
  for (int k = 0; k < 6; ++k) {
    const JointType type = types[k / 2];
    const Vec3 axis = k % 2 == 0 ? Vec3(1, 2, 3) : Vec3(0, 0, 1);
    const JointSpec first = joint("first", type, "world", "middle", {1, 2, 3}, axis);
    const JointSpec second = joint("second", type, "middle", "tip", 0.7 * axis, axis);
    expect_refusal(chain(some_body(), first, second), "joint", "first",
                   {"moves no mass of its own", "same axis"});
  }
}

TEST(BuildErrors, MimicJointsThatMoveNoMass) {
  ModelBuilder builder = arm().add_link({"finger"}).add_link({"thumb"});
  builder.add_joint(joint("grip", JointType::prismatic, "lower", "finger"));
  JointSpec follower = joint("follower", JointType::prismatic, "lower", "thumb");
  follower.mimic = Mimic{"grip", -1, 0};
  builder.add_joint(follower);
  expect_refusal(builder, "joint", "grip", {"\"grip\"", "moves no mass"});
  // two joints of a massless link on one line, while others mimic
  ModelBuilder twice = arm().add_link({"slide"}).add_link({"block", some_body()});
  JointSpec elbow_twin = joint("first", JointType::prismatic, "lower", "slide");
  twice.add_joint(elbow_twin);
  twice.add_joint(joint("second", JointType::prismatic, "slide", "block"));
  twice.add_link({"hand", some_body()});
  JointSpec wrist = joint("wrist", JointType::revolute, "lower", "hand");
  wrist.mimic = Mimic{"elbow", 1, 0};
  twice.add_joint(wrist);
  expect_refusal(twice, "joint", "first", {"\"first\"", "moves no mass of its own"});
}

// Massless links are no mistake where the joint moves some mass further on.
TEST(Build, AcceptsMasslessLinks) {
  const JointSpec first = joint("first", JointType::revolute, "world", "middle");
  const JointSpec second = joint("second", JointType::revolute, "middle", "tip", {0, 0, -1});
  EXPECT_EQ(chain(some_body(), first, second).build().n_q(), 2);
  // a frame that is welded on
  ModelBuilder welded = arm().add_link({"camera"});
  welded.add_joint(joint("mount", JointType::fixed, "lower", "camera"));
  EXPECT_EQ(welded.build().n_q(), 2);
  // a massless follower: its coordinate moves the leader
  ModelBuilder mimic = arm().add_link({"pointer"});
  JointSpec follower = joint("follower", JointType::revolute, "lower", "pointer");
  follower.mimic = Mimic{"elbow", 1, 0};
  mimic.add_joint(follower);
  EXPECT_EQ(mimic.build().n_q(), 2);
  // a light link with a heavy one hung from its axis, 1e-9 of it: rounding is 1e-16
  ModelBuilder light("light");
  light.add_link({"pin", solid_sphere(1e-3, 0.03)}).add_link({"load", some_body(1000)});
  light.add_joint(joint("a", JointType::revolute, "world", "pin"));
  light.add_joint(joint("b", JointType::revolute, "pin", "load"));
  EXPECT_EQ(light.build().n_q(), 2);
}

TEST(Build, AcceptsModelsWithoutCoordinates) {
  EXPECT_EQ(ModelBuilder("empty").build().n_q(), 0);
  ModelBuilder welded("welded");
  welded.add_link({"block", some_body()});
  welded.add_joint(joint("j", JointType::fixed, "world", "block", {1, 2, 3}));
  const Model model = welded.build();
  EXPECT_EQ(model.n_q(), 0);
  EXPECT_EQ(model.X_WL(VecX(), model.link("block")).p, Vec3(1, 2, 3));
  const State state = model.state();
  EXPECT_EQ(state.q.size(), 0);
  EXPECT_EQ(model.kinetic_energy(state), 0);
}

}  // namespace
}  // namespace saltus
