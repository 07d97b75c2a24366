#include "saltus/tree/tree.hpp"

#include <cmath>

namespace saltus {

int add_joint(Tree& tree, int parent, const Joint& joint, const Pose& X_PJ, const Drive& drive) {
  const int i = tree.joints();
  tree.parent.push_back(parent);
  tree.joint.push_back(joint);
  tree.X_PJ.push_back(X_PJ);
  tree.drive.push_back(drive);
  tree.root.push_back(parent < 0 ? i : tree.root[static_cast<std::size_t>(parent)]);
  tree.reference.push_back(i);
  // The first turning joint of a tree carries its reference point; until there is one, the root.
  const std::size_t root = static_cast<std::size_t>(tree.root.back());
  const std::size_t reference = static_cast<std::size_t>(tree.reference[root]);
  if (joint.turns() && !tree.joint[reference].turns()) tree.reference[root] = i;
  while (tree.n_v <= drive.velocity) {
    tree.coordinate.push_back(tree.n_q++);
    ++tree.n_v;
  }
  tree.one_to_one =
      tree.one_to_one && drive.velocity == i && drive.multiplier == 1 && drive.offset == 0;
  return i;
}

int add_ball(Tree& tree, int parent, const Pose& X_PJ) {
  const Ball ball{tree.joints(), tree.n_v, tree.n_q};
  tree.balls.push_back(ball);
  for (int axis = 0; axis < 3; ++axis) tree.coordinate.push_back(ball.coordinate);
  tree.n_v += 3;
  tree.n_q += 4;
  Mat3 R = Mat3::Identity();  // from the joint before to the placement's axes
  for (int axis = 0; axis < 3; ++axis) {
    const Mat3 A = rotation_z_to(Vec3::Unit(axis));
    const Pose X = axis == 0 ? X_PJ * Pose{A, Vec3::Zero()} : Pose{R * A, Vec3::Zero()};
    parent = add_joint(tree, parent, {Joint::Kind::ball, 0, axis}, X, {ball.velocity + axis, 1, 0});
    R = A.transpose();
  }
  return parent;
}

Mat3 rotation_z_to(const Vec3& axis) {
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {1.0, -1.0}) {
      if (axis != sign * Vec3::Unit(k)) continue;
      Mat3 R;  // a signed permutation with determinant 1
      R.col(2) = axis;
      R.col(0) = Vec3::Unit((k + 1) % 3);
      R.col(1) = R.col(2).cross(R.col(0));
      return R;
    }
  }
  // Else the shortest turn from the nearer pole, after half a turn about x if that is -z. From the
  // farther one it would lose half of the digits.
  const double sign = axis.z() < 0 ? -1 : 1;
  const Vec3 k = sign * Vec3::UnitZ().cross(axis);  // sine of the turn times its axis
  const double c = sign * axis.z();                 // its cosine
  Mat3 K;
  K << 0, -k.z(), k.y(), k.z(), 0, -k.x(), -k.y(), k.x(), 0;
  Mat3 R = Mat3::Identity() + K + K * K / (1 + c);
  R.col(1) *= sign;
  R.col(2) = axis;
  return R;
}

}  // namespace saltus
