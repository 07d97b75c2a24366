#include "saltus/lagrangian/curve.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace saltus {
namespace {

/// f'' at the knots, by elimination of the tridiagonal system from the first to the last.
std::vector<double> second_derivatives(const std::vector<double>& x, const std::vector<double>& y,
                                       const std::optional<std::array<double, 2>>& slopes) {
  const std::size_t n = x.size();
  const auto width = [&](std::size_t k) { return x[k + 1] - x[k]; };
  const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / width(k); };
  std::vector<double> upper(n, 0), m(n, 0);  // natural ends: m = 0
  if (slopes) {
    upper[0] = 0.5;
    m[0] = 3 / width(0) * (secant(0) - (*slopes)[0]);
  }
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double below = width(k - 1) / 6, above = width(k) / 6;
    const double pivot = 2 * (below + above) - below * upper[k - 1];
    upper[k] = above / pivot;
    m[k] = (secant(k) - secant(k - 1) - below * m[k - 1]) / pivot;
  }
  if (slopes) {
    const double right = 3 / width(n - 2) * ((*slopes)[1] - secant(n - 2));
    m[n - 1] = (right - 0.5 * m[n - 2]) / (1 - 0.5 * upper[n - 2]);
  }
  for (std::size_t k = n - 1; k-- > 0;) m[k] -= upper[k] * m[k + 1];
  return m;
}

/// Of the piece from knot k on.
CurveValue value_in(const Curve& c, std::size_t k, double at) {
  const double h = c.x[k + 1] - c.x[k], t = at - c.x[k], u = c.x[k + 1] - at;
  const double m0 = c.second[k], m1 = c.second[k + 1];
  const double a = c.y[k] / h - m0 * h / 6, b = c.y[k + 1] / h - m1 * h / 6;
  const double h4 = h * h * h * h;
  return {c.integral[k] + (m0 * (h4 - u * u * u * u) + m1 * t * t * t * t) / (24 * h) +
              (a * (h * h - u * u) + b * t * t) / 2,
          (m0 * u * u * u + m1 * t * t * t) / (6 * h) + a * u + b * t,
          (m1 * t * t - m0 * u * u) / (2 * h) - a + b, (m0 * u + m1 * t) / h};
}

CurveValue on_line(double integral, double y, double slope, double dx) {
  return {integral + y * dx + slope * dx * dx / 2, y + slope * dx, slope, 0};
}

}  // namespace

CurveValue Curve::operator()(double at) const {
  if (!(at >= x.front())) return on_line(0, y.front(), first_slope, at - x.front());
  if (at > x.back()) return on_line(integral.back(), y.back(), last_slope, at - x.back());
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  return value_in(*this, static_cast<std::size_t>(above - x.begin()) - 1, at);
}

Curve make_curve(std::vector<double> x, std::vector<double> y,
                 const std::optional<std::array<double, 2>>& slopes) {
  Curve c{std::move(x), std::move(y), {}, {}, 0, 0};
  c.second = second_derivatives(c.x, c.y, slopes);
  c.integral.assign(c.x.size(), 0);
  for (std::size_t k = 0; k + 1 < c.x.size(); ++k) {
    c.integral[k + 1] = value_in(c, k, c.x[k + 1]).integral;
  }
  c.first_slope = value_in(c, 0, c.x.front()).slope;
  c.last_slope = value_in(c, c.x.size() - 2, c.x.back()).slope;
  return c;
}

}  // namespace saltus
