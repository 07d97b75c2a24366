// q (+) x and q1 (-) q0; kinematics of balls against poses.
#include "saltus/tree/coordinates.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "kit/random_trees.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

using test::moved;
using test::Random;
using test::RandomTree;
using test::varied_ball_tree;

TEST(Coordinates, ABallHasFourOfThemAndThreeVelocities) {
  Tree tree;
  add_joint(tree, -1, {Joint::Kind::prismatic, 0}, {}, {0, 1, 0});
  const int last = add_ball(tree, 0, {});
  add_joint(tree, last, {}, {}, {4, 1, 0});
  EXPECT_EQ(tree.n_q, 6);
  EXPECT_EQ(tree.n_v, 5);
  EXPECT_EQ(last, 3);
  EXPECT_EQ(tree.coordinate, (std::vector<int>{0, 1, 1, 1, 5}));
  EXPECT_TRUE(tree.one_to_one);
  EXPECT_EQ(neutral(tree), (VecX(6) << 0, 0, 0, 0, 1, 0).finished());
  EXPECT_EQ(&ball_of(tree, 2), &tree.balls[0]);
}

TEST(Coordinates, DifferenceIsTheInverseOfIntegrate) {
  for (int k = 0; k < 100; ++k) {
    const RandomTree t = varied_ball_tree(k);
    Random random(static_cast<std::uint64_t>(k));
    const VecX x = random.vector(t.tree.n_v, 1.8);  // |f| <= 3.12 < pi
    const VecX q1 = moved(t.tree, t.q, x);
    VecX back(t.tree.n_v);
    difference(t.tree, t.q, q1, back);
    EXPECT_LT((back - x).cwiseAbs().maxCoeff(), 2e-14) << k;  // log near pi loses a digit
    for (const Ball& ball : t.tree.balls) {
      EXPECT_NEAR(quaternion(ball, q1).norm(), 1, 3e-16);
    }
  }
}

TEST(Coordinates, IntegrateGoesOnAlongOneTurn) {
  for (int k = 0; k < 50; ++k) {
    const RandomTree t = varied_ball_tree(k);
    VecX half(t.tree.n_q), twice(t.tree.n_q), whole(t.tree.n_q);
    integrate(t.tree, t.q, 0.35, t.v, half);
    integrate(t.tree, half, 0.65, t.v, twice);
    integrate(t.tree, t.q, 1, t.v, whole);
    EXPECT_LT((twice - whole).cwiseAbs().maxCoeff(), 4e-15) << k;
    VecX in_place = t.q;
    integrate(t.tree, in_place, 1, t.v, in_place);
    EXPECT_EQ(in_place, whole);
  }
}

// The parent's axes: turning the placement of a ball's joint by R turns what v means by R.
TEST(Coordinates, VelocitiesOfABallAreInItsParentsAxes) {
  Random random(3);
  Tree tree;
  const int child = add_ball(tree, -1, random.pose());
  const VecX q = test::random_coordinates(random, tree);
  const Vec3 w = random.vec3(2);
  Kinematics kin(tree);
  set_configuration(tree, q, kin);
  set_velocity(tree, w, kin);
  const Mat3 axes = tree.X_PJ[0].R * rotation_z_to(Vec3::UnitX()).transpose();
  EXPECT_LT((angular(kin.joint[child].V) - axes * w).norm(), 1e-15);
}

// Twists against numeric derivatives of poses; S and W along every velocity.
TEST(Coordinates, TwistsAreDerivativesOfPoses) {
  for (int k = 0; k < 60; ++k) {
    const RandomTree t = varied_ball_tree(k);
    Kinematics kin(t.tree), at(t.tree);
    set_configuration(t.tree, t.q, kin);
    set_velocity(t.tree, t.v, kin);
    for (int i = 0; i < t.tree.joints(); ++i) {
      if (t.tree.joint[i].is_ball() && t.tree.joint[i].axis < 2) continue;  // carry nothing
      const auto pose = [&](double h) {
        set_configuration(t.tree, moved(t.tree, t.q, h * t.v), at);
        Eigen::Matrix<double, 3, 4> out;
        const Pose X = at.X_WJ(t.tree, i);
        out << X.R, X.p;
        return out;
      };
      // bodies turn by up to 30 rad/s: a step that leaves no truncation, and 2e-13 of rounding
      const auto rate = test::derivative(pose, 0.002);
      const Pose X = kin.X_WJ(t.tree, i);
      const Vec3 w = angular(kin.joint[i].V);
      const Vec3 from_O = X.p - kin.origin[t.tree.root[i]];
      EXPECT_LT((rate.leftCols<3>() - cross_matrix(w) * X.R).norm(), 2e-11);
      EXPECT_LT((rate.col(3) - (linear(kin.joint[i].V) + w.cross(from_O))).norm(), 2e-11);
    }
  }
}

}  // namespace
}  // namespace saltus
