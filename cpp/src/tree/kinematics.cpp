#include "saltus/tree/kinematics.hpp"

#include <cmath>

#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// R <- R Rz(s), without the multiplications by the zeros of Rz.
void turn(double s, Mat3& R) {
  const double c = std::cos(s), n = std::sin(s);
  const Vec3 x = R.col(0);
  R.col(0) = c * x + n * R.col(1);
  R.col(1) = c * R.col(1) - n * x;
}

/// R_WJ; the third joint of a ball is not turned yet.
void set_rotation(const Tree& tree, int i, double s, Kinematics& kin) {
  const int parent = tree.parent[i];
  Mat3& R = kin.joint[i].R;
  if (parent < 0) {
    R = tree.X_PJ[i].R;
  } else {
    R.noalias() = kin.joint[parent].R * tree.X_PJ[i].R;
  }
  if (tree.joint[i].turns() && !tree.joint[i].is_ball()) turn(s, R);
}

/// How far joint frame i is from its parent's, in world axes. Needs the rotations of both.
Vec3 step_of(const Tree& tree, int i, const VecRef& q, const Kinematics& kin) {
  const int parent = tree.parent[i];
  const Joint& joint = tree.joint[i];
  Vec3 step = tree.X_PJ[i].p;
  if (parent >= 0) step = kin.joint[parent].R * step;
  if (joint.kind == Joint::Kind::revolute || joint.is_ball()) return step;
  const double s = displacement(tree, i, q);
  return step + kin.joint[i].R.col(2) * (joint.turns() ? joint.pitch * s : s);
}

/// Places the joints from the root to the reference joint so that the latter is at O exactly.
/// All joints strictly above the reference slide, so their rotations are already known.
void place_reference_path(const Tree& tree, int root, const VecRef& q, Kinematics& kin) {
  const int reference = tree.reference[root];
  Vec3 p = Vec3::Zero();
  for (int i = reference; i != root; i = tree.parent[i]) {
    kin.joint[i].p = p;
    p -= step_of(tree, i, q, kin);
  }
  kin.joint[root].p = p;
  kin.origin[root] = step_of(tree, root, q, kin) - p;
}

Vec6 screw(const Joint& joint, const Vec3& axis, const Vec3& p) {
  if (joint.kind == Joint::Kind::prismatic) return spatial(Vec3::Zero(), axis);
  return spatial(axis, p.cross(axis) + joint.pitch * axis);
}

}  // namespace

// The axes of a ball's joints are those of its placement, which the third one's frame leaves.
void set_configuration(const Tree& tree, const VecRef& q, Kinematics& kin) {
  for (int i = 0; i < tree.joints(); ++i) {
    JointMotion& m = kin.joint[i];
    m.s = displacement(tree, i, q);
    set_rotation(tree, i, m.s, kin);
    m.S.head<3>() = m.R.col(2);  // until the screw is written below
    if (tree.joint[i].is_ball() && tree.joint[i].axis == 2) {
      m.R = m.R * quaternion(ball_of(tree, i), q).toRotationMatrix();
    }
  }
  for (int i = 0; i < tree.joints(); ++i) {
    if (tree.root[i] == i) {
      place_reference_path(tree, i, q, kin);
    } else if (!tree.is_ancestor(i, tree.reference[tree.root[i]])) {
      kin.joint[i].p = kin.joint[tree.parent[i]].p + step_of(tree, i, q, kin);
    }
    JointMotion& m = kin.joint[i];
    m.S = screw(tree.joint[i], m.S.head<3>(), m.p);
  }
}

void set_velocity(const Tree& tree, const VecRef& v, Kinematics& kin) {
  for (int i = 0; i < tree.joints(); ++i) {
    JointMotion& m = kin.joint[i];
    const Drive& drive = tree.drive[i];
    m.V = m.S * (drive.multiplier * v[drive.velocity]);
    if (tree.parent[i] >= 0) m.V += kin.joint[tree.parent[i]].V;
    m.W = cross_motion(m.V, m.S);
    if (!tree.joint[i].is_ball() || tree.joint[i].axis != 2) continue;
    for (const int k : {i - 2, i - 1}) kin.joint[k].W = cross_motion(m.V, kin.joint[k].S);
  }
}

void to_joints(const Tree& tree, const VecRef& v, VecX& out) {
  for (int i = 0; i < tree.joints(); ++i) {
    out[i] = tree.drive[i].multiplier * v[tree.drive[i].velocity];
  }
}

void to_coordinates(const Tree& tree, const VecRef& f, VecX& out) {
  out.setZero();
  for (int i = 0; i < tree.joints(); ++i) {
    out[tree.drive[i].velocity] += tree.drive[i].multiplier * f[i];
  }
}

}  // namespace saltus
