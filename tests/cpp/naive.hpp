// The mechanics of a tree from 4x4 matrices alone: no screws, no recursion of momenta. Slow and
// independent of the library's formulas.
//
//   X_i = X_parent X_PJ A(s_i)      T = sum 1/2 tr(X' J X'^T)      V = -sum m g.c
//
// with J = integral of r r^T dm over a body, r = (x, y, z, 1) in its joint's frame.
#pragma once

#include <cmath>
#include <vector>

#include "saltus/lagrangian/mass_model.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus::test {

using Mat4 = Eigen::Matrix<double, 4, 4>;

inline Mat4 homogeneous(const Pose& X) {
  Mat4 out = Mat4::Identity();
  out.topLeftCorner<3, 3>() = X.R;
  out.topRightCorner<3, 1>() = X.p;
  return out;
}

/// How far a joint turns [rad] and slides [m] at displacement 1.
inline double turn(const Joint& joint) { return joint.kind == Joint::Kind::prismatic ? 0 : 1; }
inline double slide(const Joint& joint) {
  return joint.kind == Joint::Kind::prismatic ? 1 : joint.pitch;
}

struct NaiveMotion {
  std::vector<Mat4> X;   ///< (n) joint frames in the world
  std::vector<Mat4> dX;  ///< (n) their rates
};

inline NaiveMotion naive_motion(const Tree& tree, const VecX& q, const VecX& v) {
  NaiveMotion out;
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    const double s = drive.multiplier * q[drive.velocity] + drive.offset;
    const double w = turn(tree.joint[i]), d = slide(tree.joint[i]);
    Mat4 A = Mat4::Identity(), dA_ds = Mat4::Zero();
    A.topLeftCorner<3, 3>() = Eigen::AngleAxisd(w * s, Vec3::UnitZ()).toRotationMatrix();
    A(2, 3) = d * s;
    dA_ds.topLeftCorner<2, 2>() << -w * std::sin(w * s), -w * std::cos(w * s),  //
        w * std::cos(w * s), -w * std::sin(w * s);
    dA_ds(2, 3) = d;
    const int parent = tree.parent[i];
    const Mat4 X_WP = parent < 0 ? Mat4(Mat4::Identity()) : out.X[parent];
    const Mat4 dX_WP = parent < 0 ? Mat4(Mat4::Zero()) : out.dX[parent];
    const Mat4 X_PJ = homogeneous(tree.X_PJ[i]);
    const double rate = drive.multiplier * v[drive.velocity];
    out.X.push_back(X_WP * X_PJ * A);
    out.dX.push_back(dX_WP * X_PJ * A + X_WP * X_PJ * dA_ds * rate);
  }
  return out;
}

/// Integral of r r^T dm, from the inertia about the centre of mass.
inline Mat4 second_moments(const BodyInertia& body) {
  const Mat3& I = body.I_J;
  const Mat3 central = 0.5 * I.trace() * Mat3::Identity() - I;
  Mat4 J = Mat4::Zero();
  J.topLeftCorner<3, 3>() = central + body.mass * body.c_J * body.c_J.transpose();
  J.topRightCorner<3, 1>() = body.mass * body.c_J;
  J.bottomLeftCorner<1, 3>() = body.mass * body.c_J.transpose();
  J(3, 3) = body.mass;
  return J;
}

inline double naive_lagrangian(const Tree& tree, const MassModel& mass, const VecX& q,
                               const VecX& v) {
  const NaiveMotion motion = naive_motion(tree, q, v);
  double L = 0;
  for (int i = 0; i < tree.joints(); ++i) {
    const Mat4& dX = motion.dX[i];
    L += 0.5 * (dX * second_moments(mass.body[i]) * dX.transpose()).trace();
    const Vec3 c_W = (motion.X[i] * mass.body[i].c_J.homogeneous()).head<3>();
    L += mass.body[i].mass * mass.gravity.dot(c_W);
  }
  return L;
}

}  // namespace saltus::test
