// Poses, screws and twists against products of 4x4 matrices and their numeric derivatives.
#include <gtest/gtest.h>

#include "kit/random_trees.hpp"
#include "naive.hpp"
#include "numeric.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus {
namespace {

using test::Random;
using test::RandomTree;
using test::relative_error;

// A dozen products of rotations, each with errors of an eps or two.
constexpr double rounding = 2e-14;

Kinematics at(const Tree& tree, const VecX& q, const VecX& v) {
  Kinematics kin(tree);
  set_configuration(tree, q, kin);
  set_velocity(tree, v, kin);
  return kin;
}

std::vector<RandomTree> random_trees(int count) {
  std::vector<RandomTree> out;
  for (int k = 0; k < count; ++k) {
    Random random(static_cast<std::uint64_t>(k));
    out.push_back(random_tree(random, {.joints = 1 + k % 9,
                                       .branch = 0.4,
                                       .new_tree = k % 3 == 0 ? 0.3 : 0,
                                       .mimic = k % 4 == 0 ? 0.4 : 0}));
  }
  return out;
}

TEST(Kinematics, PosesAreProductsOfMatrices) {
  for (const RandomTree& t : random_trees(300)) {
    const Kinematics kin = at(t.tree, t.q, t.v);
    const test::NaiveMotion naive = test::naive_motion(t.tree, t.q, t.v);
    for (int i = 0; i < t.tree.joints(); ++i) {
      EXPECT_LT((test::homogeneous(kin.X_WJ(t.tree, i)) - naive.X[i]).norm(), rounding);
    }
  }
}

// S_k is the twist of its joint when coordinate k alone moves at unit speed, V_i their sum: both
// are read off the rates of the matrices.
TEST(Kinematics, TwistsAreRatesOfMatrices) {
  for (const RandomTree& t : random_trees(300)) {
    const Kinematics kin = at(t.tree, t.q, t.v);
    const test::NaiveMotion naive = test::naive_motion(t.tree, t.q, t.v);
    for (int i = 0; i < t.tree.joints(); ++i) {
      const Mat3 spin =
          naive.dX[i].topLeftCorner<3, 3>() * naive.X[i].topLeftCorner<3, 3>().transpose();
      const Vec3 w(spin(2, 1), spin(0, 2), spin(1, 0));
      const Vec3 p = naive.X[i].topRightCorner<3, 1>();
      const Vec3 p_O = kin.origin[t.tree.root[i]];
      const Vec3 v_O = Vec3(naive.dX[i].topRightCorner<3, 1>()) - w.cross(p - p_O);
      // velocities are up to 2 n and arms up to n long: ten times the rounding of poses
      EXPECT_LT((kin.joint[i].V - spatial(w, v_O)).norm(), 10 * rounding);
    }
  }
}

TEST(Kinematics, VelocitiesAddScrewsAlongTheBranch) {
  for (const RandomTree& t : random_trees(60)) {
    const Kinematics kin = at(t.tree, t.q, t.v);
    for (int i = 0; i < t.tree.joints(); ++i) {
      Vec6 V = Vec6::Zero();
      for (int k = i; k >= 0; k = t.tree.parent[k]) {
        const Drive& drive = t.tree.drive[k];
        V += kin.joint[k].S * drive.multiplier * t.v[drive.velocity];
      }
      EXPECT_LT((kin.joint[i].V - V).norm(), 10 * rounding);
    }
  }
}

// W = dS/dt about a point that stays. O moves with its joint, at the rate o say, and the moment of
// an axis about O loses o x axis by that; so W = d/dt(S about O) + [0; o x axis].
TEST(Kinematics, WIsTheRateOfTheScrew) {
  for (const RandomTree& t : random_trees(150)) {
    const Kinematics kin = at(t.tree, t.q, t.v);
    for (int i = 0; i < t.tree.joints(); ++i) {
      const auto moved = [&](double h) {
        const Kinematics there = at(t.tree, t.q + h * t.v, t.v);
        Eigen::Matrix<double, 9, 1> x;
        x << there.joint[i].S, there.origin[t.tree.root[i]];
        return x;
      };
      const auto rate = test::derivative(moved, 0.003);
      const Vec3 axis = angular(kin.joint[i].S);
      const Vec6 W = rate.head<6>() + spatial(Vec3::Zero(), Vec3(rate.tail<3>()).cross(axis));
      // 2.1 eps / h of rounding is 2e-13, of numbers up to 10; speeds up to 2 along nine joints,
      // doubled by mimics, are a frequency of 36: (36 h)^8 / 630 = 3e-11 at the very most
      EXPECT_LT(relative_error(kin.joint[i].W, W, 10), 1e-10);
    }
  }
}

TEST(Kinematics, ScrewsByHand) {
  Tree tree;
  const Mat3 to_x = rotation_z_to(Vec3::UnitX());
  add_joint(tree, -1, {Joint::Kind::revolute, 0}, {Mat3::Identity(), {1, 2, 3}}, {0, 1, 0});
  add_joint(tree, 0, {Joint::Kind::helical, 0.5}, {to_x, {0, 4, 0}}, {1, 1, 0});
  add_joint(tree, 0, {Joint::Kind::prismatic, 0}, {to_x, {0, 0, 7}}, {2, 1, 0});
  const Kinematics kin = at(tree, Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(kin.origin[0], Vec3(1, 2, 3));
  EXPECT_EQ(kin.joint[0].S, spatial({0, 0, 1}, {0, 0, 0}));
  EXPECT_EQ(kin.joint[1].S,
            spatial({1, 0, 0}, Vec3(0, 4, 0).cross(Vec3::UnitX()) + 0.5 * Vec3::UnitX()));
  EXPECT_EQ(kin.joint[2].S, spatial({0, 0, 0}, {1, 0, 0}));
  EXPECT_EQ(kin.joint[2].p, Vec3(2, 0, 7));
  EXPECT_EQ(kin.joint[2].W, spatial({0, 0, 0}, {0, 1, 0}));
  EXPECT_EQ(kin.X_WJ(tree, 2).p, Vec3(3, 2, 10));
  EXPECT_EQ(kin.X_WJ(tree, -1).R, Mat3(Mat3::Identity()));
  EXPECT_EQ(kin.X_WJ(tree, -1).p, Vec3(Vec3::Zero()));
}

// The reference joint is at O exactly, whatever slides above it.
TEST(ReferencePoint, IsTheOriginOfTheFirstTurningJoint) {
  for (const RandomTree& t : random_trees(300)) {
    const Kinematics kin = at(t.tree, t.q, t.v);
    for (int i = 0; i < t.tree.joints(); ++i) {
      if (t.tree.root[i] != i) continue;
      const int reference = t.tree.reference[i];
      EXPECT_EQ(kin.joint[reference].p, Vec3(Vec3::Zero()));
      for (int k = i; k < reference; ++k) {
        EXPECT_FALSE(t.tree.root[k] == i && t.tree.joint[k].turns());
      }
    }
  }
}

/// A body free to slide (x, y, z) and to turn, that carries a branched arm; the reference joint is
/// the fourth.
RandomTree free_body_with_arms() {
  Random random(7);
  RandomTree t;
  for (int k = 0; k < 3; ++k) {
    add_joint(t.tree, k - 1, {Joint::Kind::prismatic, 0}, {random.rotation(), random.vec3()},
              {k, 1, 0});
    t.mass.body.push_back({0, Vec3::Zero(), Mat3::Zero()});
  }
  for (int k = 3; k < 9; ++k) {
    add_joint(t.tree, k == 6 ? 3 : k - 1, random_joint(random), random.pose(0.3), {k, 1, 0});
    t.mass.body.push_back(random.body());
  }
  t.tree.joint[3] = {Joint::Kind::revolute, 0};
  t.tree.reference[0] = 3;
  t.q = random.vector(9);
  t.v = random.vector(9);
  return t;
}

void expect_same_motion(const Kinematics& a, const Kinematics& b, int first) {
  for (std::size_t i = static_cast<std::size_t>(first); i < a.joint.size(); ++i) {
    EXPECT_EQ(a.joint[i].S, b.joint[i].S) << i;
    EXPECT_EQ(a.joint[i].V, b.joint[i].V) << i;
    EXPECT_EQ(a.joint[i].W, b.joint[i].W) << i;
    EXPECT_EQ(a.joint[i].R, b.joint[i].R) << i;
    EXPECT_EQ(a.joint[i].p, b.joint[i].p) << i;
  }
}

// Not "nearly": every bit that the dynamics read stays, and the distance is in `origin` alone.
TEST(ReferencePoint, KeepsEveryBitOfATreeBuiltFarAway) {
  for (RandomTree t : random_trees(60)) {
    const Kinematics near = at(t.tree, t.q, t.v);
    for (const double shift : {1e3, 1e6}) {
      Tree far_tree = t.tree;
      const Vec3 away = shift * Vec3(1, -2, 0.5);
      for (int i = 0; i < t.tree.joints(); ++i) {
        if (t.tree.parent[i] < 0) far_tree.X_PJ[i].p += away;
      }
      const Kinematics far = at(far_tree, t.q, t.v);
      expect_same_motion(near, far, 0);
      for (int i = 0; i < t.tree.joints(); ++i) {
        const Vec3 moved = far.X_WJ(far_tree, i).p - near.X_WJ(t.tree, i).p;
        EXPECT_LT((moved - away).norm(), 4 * 2.2e-16 * away.norm());  // rounding of the distance
      }
    }
  }
}

TEST(ReferencePoint, KeepsEveryBitOfABodyThatHasTravelledFar) {
  RandomTree t = free_body_with_arms();
  const Kinematics near = at(t.tree, t.q, t.v);
  for (const double distance : {1e3, 1e6, 1e9}) {
    VecX q = t.q;
    q.head(3) += distance * Vec3(1, 0.3, -2);
    const Kinematics far = at(t.tree, q, t.v);
    expect_same_motion(near, far, 3);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(near.joint[i].S, far.joint[i].S);
    const test::NaiveMotion naive = test::naive_motion(t.tree, q, t.v);
    for (int i = 0; i < t.tree.joints(); ++i) {
      const Mat3 R = naive.X[i].topLeftCorner<3, 3>();
      const Vec3 p = naive.X[i].topRightCorner<3, 1>();
      EXPECT_LT((far.X_WJ(t.tree, i).R - R).norm(), rounding);
      EXPECT_LT((far.X_WJ(t.tree, i).p - p).norm(), 1e-15 * 4 * distance);
    }
  }
}

// A planar mechanism stays in its plane to the last bit: axes along x, y, z are permutations.
TEST(Kinematics, APlanarChainStaysInItsPlane) {
  Tree tree;
  const Mat3 to_y = rotation_z_to(Vec3::UnitY());
  const Mat3 back = to_y.transpose();
  add_joint(tree, -1, {Joint::Kind::revolute, 0}, {to_y, {0.1, 0, 0.3}}, {0, 1, 0});
  for (int k = 1; k < 8; ++k) {
    add_joint(tree, k - 1, {Joint::Kind::revolute, 0}, {back * to_y, back * Vec3(0.2, 0, -0.7)},
              {k, 1, 0});
  }
  Random random(9);
  const Kinematics kin = at(tree, random.vector(8, 3), random.vector(8, 3));
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(kin.joint[i].R.col(2), Vec3(Vec3::UnitY()));
    EXPECT_EQ(kin.X_WJ(tree, i).p[1], 0);
    EXPECT_EQ(kin.joint[i].S[4], 0);
    EXPECT_EQ(kin.joint[i].W[4], 0);
  }
}

}  // namespace
}  // namespace saltus
