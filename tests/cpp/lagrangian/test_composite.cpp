// Bodies welded and seen from other frames; one pass after another.
#include <gtest/gtest.h>

#include "lagrangian/evaluate.hpp"
#include "numeric.hpp"
#include "plain/composite.hpp"

namespace saltus {
namespace {

using namespace plain;
using test::Random;
using test::relative_error;

constexpr double rounding = 1e-14;  // sums of a few dozen terms of size 1

void expect_same_body(const BodyInertia& a, const BodyInertia& b) {
  EXPECT_NEAR(a.mass, b.mass, rounding);
  EXPECT_LT(relative_error(a.c_J, b.c_J, 1), rounding);
  EXPECT_LT(relative_error(a.I_J, b.I_J), rounding);
}

TEST(Weld, OfParticlesByHand) {
  const BodyInertia a{1, {1, 0, 0}, Mat3::Zero()}, b{3, {-1, 0, 0}, Mat3::Zero()};
  const BodyInertia both = weld(a, b);
  EXPECT_EQ(both.mass, 4);
  EXPECT_EQ(both.c_J, Vec3(-0.5, 0, 0));
  // reduced mass 3/4 at distance 2
  EXPECT_EQ(both.I_J, Mat3(Vec3(0, 3, 3).asDiagonal()));
}

TEST(Weld, NeitherOrderNorGroupingMatters) {
  Random random(1);
  for (int k = 0; k < 30; ++k) {
    const BodyInertia a = random.body(), b = random.body(), c = random.body();
    expect_same_body(weld(a, b), weld(b, a));
    expect_same_body(weld(weld(a, b), c), weld(a, weld(b, c)));
  }
}

TEST(Weld, MasslessBodiesAddNothing) {
  Random random(2);
  const BodyInertia a = random.body(), nothing;
  expect_same_body(weld(a, nothing), a);
  expect_same_body(weld(nothing, a), a);
  const BodyInertia none = weld(nothing, nothing);
  EXPECT_EQ(none.mass, 0);
  EXPECT_EQ(none.c_J, Vec3(Vec3::Zero()));
  EXPECT_EQ(none.I_J, Mat3(Mat3::Zero()));
}

TEST(Transform, CommutesWithWeld) {
  Random random(3);
  for (int k = 0; k < 30; ++k) {
    const BodyInertia a = random.body(), b = random.body();
    const Pose X = random.pose(), Y = random.pose();
    expect_same_body(transform(X, weld(a, b)), weld(transform(X, a), transform(X, b)));
    expect_same_body(transform(X * Y, a), transform(X, transform(Y, a)));
  }
}

TEST(Transform, OfARodByHand) {
  const BodyInertia rod{2, {0, 0, 1}, Vec3(0.5, 0.5, 0).asDiagonal()};
  const BodyInertia seen = transform({rotation_from_rpy(0, std::acos(0.0), 0), {0, 5, 0}}, rod);
  expect_same_body(seen, {2, {1, 5, 0}, Vec3(0, 0.5, 0.5).asDiagonal()});  // z -> x
}

// Nothing of the last evaluation is left in the next, in bodies without mass either.
TEST(Passes, CanBeRepeated) {
  test::RandomTree t = test::varied_tree(8);
  for (const int i : {0, 2, 3, 6}) t.mass.body[i] = {};
  test::Evaluation used = evaluate(t);
  t.q *= 0.7;
  t.v *= -1.1;
  const Composite fresh = evaluate(t).comp;
  set_configuration(t.tree, t.q, used.kin);
  set_velocity(t.tree, t.v, used.kin);
  first_pass(t.tree, t.mass, used.kin, used.comp);
  second_pass(t.tree, t.mass, used.kin, used.comp);
  EXPECT_EQ(fresh.L_q, used.comp.L_q);
  EXPECT_EQ(fresh.L_v, used.comp.L_v);
  for (std::size_t i = 0; i < fresh.joint.size(); ++i) {
    EXPECT_EQ(fresh.joint[i].Ic.I, used.comp.joint[i].Ic.I);
    EXPECT_EQ(fresh.joint[i].H, used.comp.joint[i].H);
    EXPECT_EQ(fresh.joint[i].g, used.comp.joint[i].g);
    EXPECT_EQ(fresh.joint[i].F, used.comp.joint[i].F);
    EXPECT_EQ(fresh.joint[i].G, used.comp.joint[i].G);
  }
}

// At the root the composites are those of the whole tree: mass, momentum, gravity's wrench.
TEST(Passes, TheRootHoldsTheWholeTree) {
  Random random(5);
  const test::RandomTree t = random_tree(random, {.joints = 8, .branch = 0.5});
  const test::Evaluation at = test::evaluate(t);
  BodyInertia all;
  Vec6 momentum = Vec6::Zero();
  for (int i = 0; i < t.tree.joints(); ++i) {
    const JointMotion& m = at.kin.joint[i];
    const BodyInertia body = transform({m.R, m.p}, t.mass.body[i]);
    all = weld(all, body);
    momentum += inertia_about(body.mass, body.c_J, body.I_J) * m.V;
  }
  const JointComposite& root = at.comp.joint[0];
  const Inertia about_O = inertia_about(all.mass, all.c_J, all.I_J);
  EXPECT_NEAR(root.Ic.mass, all.mass, rounding);
  EXPECT_LT(relative_error(root.Ic.h, about_O.h), 10 * rounding);
  EXPECT_LT(relative_error(root.Ic.I, about_O.I), 10 * rounding);
  EXPECT_LT(relative_error(root.H, momentum), 10 * rounding);
  const Vec3 weight = all.mass * t.mass.gravity;
  EXPECT_LT(relative_error(root.g, spatial(all.c_J.cross(weight), weight)), 10 * rounding);
}

}  // namespace
}  // namespace saltus
