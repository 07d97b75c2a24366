// Spatial algebra: poses, twists, wrenches and inertias as 6-vectors `[angular; linear]`.
//
// Reference: R. Featherstone, Rigid Body Dynamics Algorithms, ch. 2 (2008).
// All quantities are in world axes; a twist `[w; v]` holds the angular velocity and the velocity
// of the body point that coincides with the reference point O, a wrench `[n; f]` the moment about
// O and the force. Which O is used is the caller's choice; all operands must share it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace saltus {

using Vec3 = Eigen::Matrix<double, 3, 1>;               ///< a point or a direction
using Vec6 = Eigen::Matrix<double, 6, 1>;               ///< `[angular; linear]`
using Mat6 = Eigen::Matrix<double, 6, 6>;               ///< of such
using VecX = Eigen::Matrix<double, Eigen::Dynamic, 1>;  ///< numbers of a model or a run
using Mat3 = Eigen::Matrix<double, 3, 3>;               ///< a rotation or an inertia
/// A table: rows lie in memory as they do in NumPy.
using MatX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using VecRef = Eigen::Ref<const VecX>;  ///< an argument: a VecX, or a part of other numbers

/// A rigid placement: `X_WB` takes coordinates in frame B to coordinates in frame W.
struct Pose {
  Mat3 R = Mat3::Identity();  ///< rotation, columns are B's axes in W
  Vec3 p = Vec3::Zero();      ///< [m] B's origin in W

  /// X_WB X_BC is X_WC.
  Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, p + R * X_BC.p}; }
  /// [m] A point of B, in W.
  Vec3 operator*(const Vec3& p_B) const { return p + R * p_B; }
  /// X_BW.
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Rotation by fixed-axis roll, pitch, yaw (URDF's convention): `Rz(yaw) Ry(pitch) Rx(roll)`.
inline Mat3 rotation_from_rpy(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
          Eigen::AngleAxisd(roll, Vec3::UnitX()))
      .toRotationMatrix();
}

/// The angular part of a twist or wrench.
inline auto angular(const Vec6& x) { return x.head<3>(); }
/// The linear part.
inline auto linear(const Vec6& x) { return x.tail<3>(); }

/// Both parts together.
inline Vec6 spatial(const Vec3& angular, const Vec3& linear) {
  Vec6 x;
  x.head<3>() = angular;
  x.tail<3>() = linear;
  return x;
}

/// Motion cross product `a x b` of two twists.
inline Vec6 cross_motion(const Vec6& a, const Vec6& b) {
  return spatial(angular(a).cross(angular(b)),
                 angular(a).cross(linear(b)) + linear(a).cross(angular(b)));
}

/// Force cross product `a x* f` of a twist and a wrench: `b . (a x* f) = -(a x b) . f`.
inline Vec6 cross_force(const Vec6& a, const Vec6& f) {
  return spatial(angular(a).cross(angular(f)) + linear(a).cross(linear(f)),
                 angular(a).cross(linear(f)));
}

/// Spatial inertia about the reference point O, in world axes.
struct Inertia {
  double mass = 0;        ///< [kg]
  Vec3 h = Vec3::Zero();  ///< [kg m] mass times centre of mass, from O
  Mat3 I = Mat3::Zero();  ///< [kg m^2] rotational inertia about O

  /// Of both bodies together, about the same O.
  Inertia& operator+=(const Inertia& other) {
    mass += other.mass;
    h += other.h;
    I += other.I;
    return *this;
  }
  /// Momentum wrench of a body that moves with this twist.
  Vec6 operator*(const Vec6& twist) const {
    return spatial(I * angular(twist) + h.cross(linear(twist)),
                   mass * linear(twist) - h.cross(angular(twist)));
  }
};

/// Inertia about a point from mass, centre of mass `c` relative to that point, and the
/// rotational inertia `I_c` about the centre of mass (same axes).
inline Inertia inertia_about(double mass, const Vec3& c, const Mat3& I_c) {
  return {mass, mass * c, I_c + mass * (c.squaredNorm() * Mat3::Identity() - c * c.transpose())};
}

}  // namespace saltus
