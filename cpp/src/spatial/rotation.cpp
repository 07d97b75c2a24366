#include "saltus/spatial/rotation.hpp"

#include <cmath>

#include "spatial/turn_series.hpp"

namespace saltus {

using turn_series::small;
using turn_series::sum;

Quaternion quaternion_exp(const Vec3& f) {
  const double x = f.squaredNorm();
  if (x < small) {
    const double factor = sum(turn_series::sine, x);
    return {sum(turn_series::cosine, x), factor * f.x(), factor * f.y(), factor * f.z()};
  }
  const double t = std::sqrt(x);
  const double factor = std::sin(t / 2) / t;
  return {std::cos(t / 2), factor * f.x(), factor * f.y(), factor * f.z()};
}

Vec3 quaternion_log(const Quaternion& q) {
  const double sine = q.vec().norm();
  const double sign = q.w() < 0 ? -1 : 1;
  if (sine == 0) return Vec3::Zero();
  return 2 * std::atan2(sine, sign * q.w()) / sine * sign * q.vec();
}

JacobianCoefficients jacobian_coefficients(const Vec3& f) {
  const double x = f.squaredNorm();
  if (x < small) {
    return {sum(turn_series::b, x), sum(turn_series::c, x), sum(turn_series::b1, x),
            sum(turn_series::c1, x)};
  }
  const double t = std::sqrt(x), sine = std::sin(t), cosine = std::cos(t);
  const double half = std::sin(t / 2), versine = 2 * half * half;
  return {versine / x, (t - sine) / (x * t), (t * sine - 2 * versine) / (x * x),
          (3 * sine - 2 * t - t * cosine) / (x * x * t)};
}

Mat3 left_jacobian(const Vec3& f) {
  const JacobianCoefficients k = jacobian_coefficients(f);
  Mat3 out = k.c * f * f.transpose() + k.b * cross_matrix(f);
  out.diagonal().array() += 1 - k.c * f.squaredNorm();  // [f]^2 = f f^T - |f|^2
  return out;
}

Mat3 left_jacobian_derivative(const Vec3& f, const Vec3& x) {
  const JacobianCoefficients k = jacobian_coefficients(f);
  const Vec3 f_x = f.cross(x);
  // [f][x] = x f^T - f.x
  Mat3 out = (k.b1 * f_x + k.c1 * f.cross(f_x)) * f.transpose();
  out -= cross_matrix(k.b * x + k.c * f_x) + k.c * x * f.transpose();
  out.diagonal().array() += k.c * f.dot(x);
  return out;
}

ArcCoefficients arc_coefficients(const Vec3& f) {
  const double x = f.squaredNorm();
  if (x < small) return {sum(turn_series::arc1, x), sum(turn_series::arc2, x)};
  const double t = std::sqrt(x), sine = std::sin(t / 2), cosine = std::cos(t / 2);
  return {(t / 2 / sine - 1) / x, sine / (1 + cosine) / t};
}

}  // namespace saltus
