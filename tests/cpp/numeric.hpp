// Numeric derivatives, the twins of every analytic one.
#pragma once

#include <algorithm>
#include <utility>

#include "saltus/spatial/spatial.hpp"

namespace saltus::test {

/// f'(0) by central differences of eighth order.
///
/// Error: h^8 |f^(9)| / 630 of truncation and 2.1 eps |f| / h of rounding. One coordinate enters a
/// Lagrangian or a pose as a trigonometric polynomial of order two or so, |f^(9)| <= 2^9 |f|: at
/// h = 0.02 both errors are about 2e-14 |f|. A mimic multiplier m raises the first by m^9.
template <class F>
auto derivative(const F& f, double h = 0.02) {
  using Value = std::decay_t<decltype(f(h))>;
  constexpr double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  Value sum = weight[0] * (f(h) - f(-h));
  for (int k = 2; k <= 4; ++k) {
    const Value difference = f(k * h) - f(-k * h);
    sum += weight[k - 1] * difference;
  }
  return Value(sum / h);
}

/// df/dx of a scalar function of a vector.
template <class F>
VecX gradient(const F& f, const VecX& x) {
  VecX out(x.size());
  for (int i = 0; i < x.size(); ++i) {
    out[i] = derivative([&](double h) {
      VecX moved = x;
      moved[i] += h;
      return static_cast<double>(f(moved));
    });
  }
  return out;
}

/// d f_i / d x_j of a vector function of a vector.
template <class F>
MatX jacobian(const F& f, const VecX& x) {
  MatX out(f(x).size(), x.size());
  for (int j = 0; j < x.size(); ++j) {
    out.col(j) = derivative([&](double h) {
      VecX moved = x;
      moved[j] += h;
      return VecX(f(moved));
    });
  }
  return out;
}

/// Largest difference, relative to the largest entry or to `scale` where that is more.
template <class A, class B>
double relative_error(const A& a, const B& b, double scale = 0) {
  if (a.size() == 0 && b.size() == 0) return 0;
  const double size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), scale});
  return size == 0 ? 0 : (a - b).cwiseAbs().maxCoeff() / size;
}

}  // namespace saltus::test
