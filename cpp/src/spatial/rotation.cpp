#include "saltus/spatial/rotation.hpp"

#include <array>
#include <cmath>

namespace saltus {
namespace {

constexpr double small = 0.09;  ///< t^2 below which series are summed; ten terms are exact there

/// sum of k[i] x^i.
template <std::size_t N>
double series(const std::array<double, N>& k, double x) {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) sum = sum * x + k[i];
  return sum;
}

// In x = t^2: b = sum (-x)^k / (2k + 2)!, c = sum (-x)^k / (2k + 3)!, their derivatives by t over t.
constexpr std::array series_b = {1. / 2, -1. / 24, 1. / 720, -1. / 40320, 1. / 3628800,
                                 -1. / 479001600};
constexpr std::array series_c = {1. / 6,      -1. / 120,       1. / 5040,
                                 -1. / 362880, 1. / 39916800, -1. / 6227020800};
constexpr std::array series_b1 = {-2. / 24, 4. / 720, -6. / 40320, 8. / 3628800, -10. / 479001600};
constexpr std::array series_c1 = {-2. / 120, 4. / 5040, -6. / 362880, 8. / 39916800,
                                  -10. / 6227020800};
constexpr std::array series_arc1 = {1. / 24, 7. / 5760, 31. / 967680, 127. / 154828800,
                                    73. / 3503554560,   1414477. / 2678117105664000};
constexpr std::array series_arc2 = {1. / 4, 1. / 192, 1. / 7680, 17. / 5160960, 31. / 371589120,
                                    691. / 326998425600};

}  // namespace

Quaternion quaternion_exp(const Vec3& f) {
  const double t = f.norm();
  // sin(t/2) / t is 1/2 where t is nothing
  const double factor = t > 0 ? std::sin(t / 2) / t : 0.5;
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
    return {series(series_b, x), series(series_c, x), series(series_b1, x), series(series_c1, x)};
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
  if (x < small) return {series(series_arc1, x), series(series_arc2, x)};
  const double t = std::sqrt(x), sine = std::sin(t / 2), cosine = std::cos(t / 2);
  return {(t / 2 / sine - 1) / x, sine / (1 + cosine) / t};
}

}  // namespace saltus
