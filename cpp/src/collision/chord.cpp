// Certified advance: theory, section 4; the bounds are derived in chord_bounds.cpp.
//
// Departs from the theory's B in two ways. The distance from a convex solid is a convex function
// of the centre P, so
//
//   phi(s + d) >= phi + n.(P(s + d) - P(s)) >= phi + phi' d - B d^2/2
//                                           >= phi + phi' d + n.P'' d^2/2 - C d^3/6
//
// with |P''| <= B, |P'''| <= C: the curvature of the shapes can only open the gap, its term
// mu^2/r_min is not needed, and the bounds hold where bodies overlap or features change. The third
// order is for bodies that swing together: their P'' is about 0 while B knows only that both move.
#include "saltus/collision/chord.hpp"

#include <cassert>
#include <cmath>
#include <limits>

#include "collision/chord_path.hpp"

namespace saltus {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// [units of rounding] of the longest length: each joint on the way adds about one to phi, and
/// they add up as a random walk does.
constexpr double rounding = 16 * epsilon;

/// A plain root takes 5 to 10, a graze of depth 1e-12 about 20. Balls that swing side by side at a
/// distance g need (C/6g)^(1/3): 400 is g = 3e-9 C, below what a gap is known to.
constexpr int max_iterations = 400;

/// First root of g + rate d - B d^2/2, for g, B >= 0, without cancellation.
double quadratic_advance(double g, double rate, double B) {
  const double root = std::sqrt(rate * rate + 2 * B * g);
  if (rate < 0) return 2 * g / (root - rate);
  return B > 0 ? (rate + root) / B : std::numeric_limits<double>::infinity();
}

/// How far ahead of a sample the gap stays above the floor; it is `g` above it there (where it is
/// below: how far it stays no lower). Up to a reach D the cubic bound is at least the quadratic one
/// with B = C D/3 - n.P''; any D is safe, and three halvings of its exponent come near the best.
double certified_advance(double g, const ChordSample& x, const ChordBounds& bounds,
                         double remaining) {
  g = std::fmax(g, 0);
  double d = std::fmax(g / bounds.mu, quadratic_advance(g, x.rate, bounds.B));
  double D = remaining;
  for (int k = 0; k < 3 && d < D; ++k) {
    const double B = std::fmax(bounds.C * D / 3 - x.bend, 0);
    d = std::fmax(d, std::fmin(D, quadratic_advance(g, x.rate, B)));
    D = std::sqrt(d * D);
  }
  return d;
}

}  // namespace

double gap_change_bound(const Tree& tree, const std::vector<PlacedShape>& shapes, const Pair& pair,
                        const VecRef& q, const VecRef& dq) {
  return first_bounds({tree, shapes, pair, q, dq}).mu;
}

ChordHit first_hit_on_chord(const Tree& tree, const std::vector<PlacedShape>& shapes,
                            const Pair& pair, const VecRef& q, const VecRef& dq, double floor) {
  assert(std::holds_alternative<Sphere>(shapes[pair.a].shape));
  using Outcome = ChordHit::Outcome;
  const Chord chord{tree, shapes, pair, q, dq};
  ChordSample x = sample_chord(chord, 0);
  ChordBounds bounds = first_bounds(chord);
  if (x.phi - bounds.mu > floor) return {Outcome::clear, 1};

  add_higher_bounds(chord, x.phi, bounds);
  double s = 0;
  for (int k = 0; k < max_iterations; ++k, x = sample_chord(chord, s)) {
    const double g = x.phi - floor;
    if (!std::isfinite(g) || !std::isfinite(x.rate)) break;
    const bool touches = g <= rounding * bounds.length, departs = x.rate > rounding * bounds.mu;
    if (touches && !departs) return {Outcome::hit, s};
    s += std::fmax(certified_advance(g, x, bounds, 1 - s), epsilon);  // s is known no better
    if (s >= 1) return {Outcome::clear, 1};
  }
  return {Outcome::not_converged, s};
}

}  // namespace saltus
