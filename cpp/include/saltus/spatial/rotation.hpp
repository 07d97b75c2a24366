// Rotations without a chart: unit quaternions, and the functions of a turn f = a theta (axis times
// angle) that arcs of ball joints are made of. Theory, O.
//
//   exp(f) = 1 + sin t/t [f] + (1 - cos t)/t^2 [f]^2         J(f) = 1 + b [f] + c [f]^2
//   d exp(f) exp(f)^-1 = [J(f) df]                           b = (1 - cos t)/t^2, c = (t - sin
//   t)/t^3
//
// with t = |f|, [f] x = f x x. All coefficients are entire functions of t^2; below t = 0.3 they are
// summed as series, where the closed forms would lose digits.
#pragma once

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// Memory order x y z w: a Map on four numbers of q is one.
using Quaternion = Eigen::Quaterniond;

/// [f]: the matrix of f x.
inline Mat3 cross_matrix(const Vec3& f) {
  Mat3 out;
  out << 0, -f.z(), f.y(), f.z(), 0, -f.x(), -f.y(), f.x(), 0;
  return out;
}

/// exp(f) as a unit quaternion, (a sin t/2, cos t/2).
SALTUS_EXPORT Quaternion quaternion_exp(const Vec3& f);

/// The f of a unit quaternion with |f| <= pi; q and -q give the same.
SALTUS_EXPORT Vec3 quaternion_log(const Quaternion& q);

/// b and c of J(f), b' / t and c' / t.
struct JacobianCoefficients {
  /// Of J, and b' / t, c' / t.
  double b, c, b1, c1;
};

SALTUS_EXPORT JacobianCoefficients jacobian_coefficients(const Vec3& f);

/// J(f).
SALTUS_EXPORT Mat3 left_jacobian(const Vec3& f);

/// D(f, x) = d (J(f) x) / df.
SALTUS_EXPORT Mat3 left_jacobian_derivative(const Vec3& f, const Vec3& x);

/// What corrects the momenta of a ball's arc: c1 = ((t/2) / sin(t/2) - 1) / t^2, c2 = tan(t/4) / t.
struct ArcCoefficients {
  /// Of `f`, t its length.
  double c1, c2;
};

SALTUS_EXPORT ArcCoefficients arc_coefficients(const Vec3& f);

}  // namespace saltus
