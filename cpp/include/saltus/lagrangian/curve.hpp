// A cubic spline f(x) through points, twice continuously differentiable, and a line beyond its
// ends.
//
// Between knots, with m the second derivatives at them and h = x1 - x0, t = x - x0, u = x1 - x:
//
//   f   = (m0 u^3 + m1 t^3) / 6h + (y0/h - m0 h/6) u + (y1/h - m1 h/6) t
//
// m solves the tridiagonal system that makes f' continuous. Ends are natural, m = 0 there, so that
// the line beyond continues f''; or f' is given there, and f'' jumps to 0 at the end.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "saltus/export.hpp"

namespace saltus {

/// f and its derivatives at one x, and the integral of f from the first knot.
struct CurveValue {
  /// In the order of the text above.
  double integral, f, slope, second;
};

/// A spline, ready to be asked.
struct Curve {
  /// Knots, x ascending, at least two.
  std::vector<double> x, y;
  std::vector<double> second;    ///< (knots) f'' at them
  std::vector<double> integral;  ///< (knots) of f, from the first
  /// f' of the lines beyond the ends.
  double first_slope, last_slope;

  /// At any x.
  SALTUS_EXPORT CurveValue operator()(double at) const;
};

/// `slopes` of f at both ends; natural ends without.
SALTUS_EXPORT Curve make_curve(std::vector<double> x, std::vector<double> y,
                               const std::optional<std::array<double, 2>>& slopes = {});

}  // namespace saltus
