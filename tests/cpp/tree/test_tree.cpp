// Building a tree: derived fields, and the frames that take z to an axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kit/random_trees.hpp"
#include "saltus/tree/kinematics.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {
namespace {

using test::Random;

const Joint revolute{Joint::Kind::revolute, 0};
const Joint prismatic{Joint::Kind::prismatic, 0};
const Joint helical{Joint::Kind::helical, 0.1};

TEST(Tree, DerivedFieldsOfTwoTrees) {
  Tree tree;
  EXPECT_EQ(add_joint(tree, -1, prismatic, {}, {0, 1, 0}), 0);
  EXPECT_EQ(tree.reference[0], 0);  // nothing turns yet
  EXPECT_EQ(add_joint(tree, -1, revolute, {}, {1, 1, 0}), 1);
  EXPECT_EQ(add_joint(tree, 0, prismatic, {}, {2, 1, 0}), 2);
  EXPECT_EQ(tree.reference[0], 0);
  EXPECT_EQ(add_joint(tree, 2, helical, {}, {3, 1, 0}), 3);
  EXPECT_EQ(add_joint(tree, 0, revolute, {}, {4, 1, 0}), 4);
  EXPECT_EQ(add_joint(tree, 1, revolute, {}, {5, 1, 0}), 5);
  EXPECT_EQ(tree.joints(), 6);
  EXPECT_EQ(tree.n_v, 6);
  EXPECT_EQ(tree.parent, (std::vector<int>{-1, -1, 0, 2, 0, 1}));
  EXPECT_EQ(tree.root, (std::vector<int>{0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(tree.reference[0], 3);  // the first that turns, and it stays so
  EXPECT_EQ(tree.reference[1], 1);
  EXPECT_TRUE(tree.one_to_one);
  const std::vector<std::vector<int>> branches{{0}, {1}, {0, 2}, {0, 2, 3}, {0, 4}, {1, 5}};
  for (int j = 0; j < tree.joints(); ++j) {
    for (int i = 0; i < tree.joints(); ++i) {
      const bool above = std::count(branches[j].begin(), branches[j].end(), i) > 0;
      EXPECT_EQ(tree.is_ancestor(i, j), above) << i << " " << j;
    }
  }
}

TEST(Tree, OneToOneEndsWithAnyOtherDrive) {
  const Drive others[] = {{0, 1, 0}, {1, 2, 0}, {1, 1, 0.5}, {2, 1, 0}};
  for (const Drive& drive : others) {
    Tree tree;
    add_joint(tree, -1, revolute, {}, {0, 1, 0});
    EXPECT_TRUE(tree.one_to_one);
    add_joint(tree, 0, revolute, {}, drive);
    EXPECT_FALSE(tree.one_to_one);
    EXPECT_EQ(tree.n_v, std::max(1, drive.velocity + 1));
    add_joint(tree, 1, revolute, {}, {2, 1, 0});
    EXPECT_FALSE(tree.one_to_one);
  }
}

TEST(Tree, OnlyPrismaticJointsDoNotTurn) {
  EXPECT_TRUE(revolute.turns());
  EXPECT_TRUE(helical.turns());
  EXPECT_FALSE(prismatic.turns());
}

TEST(RotationZTo, IsAPermutationForCoordinateAxes) {
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {1.0, -1.0}) {
      const Vec3 axis = sign * Vec3::Unit(k);
      const Mat3 R = rotation_z_to(axis);
      EXPECT_EQ(Vec3(R.col(2)), axis);
      EXPECT_EQ(Mat3(R.transpose() * R), Mat3(Mat3::Identity()));
      EXPECT_EQ(R.determinant(), 1);
      EXPECT_EQ(R.cwiseAbs().sum(), 3);  // with the two above: entries are 0 and +-1
    }
  }
  EXPECT_EQ(rotation_z_to(Vec3::UnitZ()), Mat3(Mat3::Identity()));
}

TEST(RotationZTo, AnyAxis) {
  Random random(1);
  std::vector<Vec3> axes;
  for (int k = 0; k < 200; ++k) axes.push_back(random.unit());
  for (const double tilt : {1e-3, 1e-8, 1e-16}) {  // where the shortest turn is ill-defined, too
    axes.push_back(Vec3(tilt, -tilt, 1).normalized());
    axes.push_back(Vec3(tilt, tilt, -1).normalized());
  }
  for (const Vec3& axis : axes) {
    const Mat3 R = rotation_z_to(axis);
    EXPECT_EQ(Vec3(R.col(2)), axis);
    // the axis is a unit vector to an eps only
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 2e-15) << axis.transpose();
    EXPECT_GT(R.determinant(), 0);
  }
}

TEST(Drives, ToJointsAndBack) {
  Tree tree;
  add_joint(tree, -1, revolute, {}, {0, 1, 0});
  add_joint(tree, 0, revolute, {}, {1, 1, 0});
  add_joint(tree, 1, revolute, {}, {0, -2, 0.3});
  add_joint(tree, 2, prismatic, {}, {1, 0.5, 0});
  VecX joints(4), coordinates(2);
  to_joints(tree, Eigen::Vector2d(3, 5), joints);
  EXPECT_EQ(joints, VecX(Eigen::Vector4d(3, 5, -6, 2.5)));
  to_coordinates(tree, Eigen::Vector4d(1, 10, 100, 1000), coordinates);
  EXPECT_EQ(coordinates, VecX(Eigen::Vector2d(1 - 200, 10 + 500)));
}

}  // namespace
}  // namespace saltus
