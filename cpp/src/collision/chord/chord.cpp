// Certified advance: theory, section 4; the bounds are derived in chord_bounds.cpp.
//
// Departs from the theory's B in two ways. The signed distance of convex solids is the greatest
// separation along any direction, so that along the n of one s it is a lower bound of those that
// come: b's support stays as it is (n is at rest to b), and
//
//   phi(s + d) >= phi + min_x n.x(s + d) - min_x n.x(s)         x over a's core
//
// where n.x(s + d) >= n.(x + x' d) - B d^2/2 >= n.(x + x' d + x'' d^2/2) - C d^3/6. The curvature
// of the shapes can only open the gap, its term mu^2/r_min is not needed, and the bounds hold where
// bodies overlap or features change. The third order is for bodies that swing together: their P''
// is about 0 while B knows only that both move.
//
// For every x these are parabolas that bend down, so their minimum over x is concave in d: where it
// is not below 0 at d, it is not below 0 before. The support of a's core finds the lowest x.
#include "saltus/collision/chord.hpp"

#include <cmath>
#include <limits>

#include "collision/chord/chord_path.hpp"
#include "collision/parts/kinds.hpp"
#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// [units of rounding] of the longest length: each joint on the way adds about one to phi, and
/// they add up as a random walk does.
constexpr double rounding = 16 * epsilon;

/// A plain root takes 5 to 10, a graze of depth 1e-12 about 20. Balls that swing side by side at a
/// distance g need (C/6g)^(1/3): 400 is g = 3e-9 C, below what a gap is known to.
constexpr int max_iterations = 400;

/// Where a body that touches departs at its witness, but another point of it comes down at once, no
/// advance longer than this is certain: that is a hit too.
constexpr double sideways = 1e-9;

/// Of what is nearer than `touch` by then and comes nearer, no more is asked: it may be a hit,
/// which the arc itself tells. A point that comes down slowly beside others that could do so fast,
/// such as one of a rim that lies on an edge, would take all iterations to close.
constexpr int patience = 40;

/// Of a body that overlaps and departs nothing is promised but an end: this much at a time.
constexpr double stride = 1.0 / 64;

/// First root of g + rate d - B d^2/2, for g, B >= 0, without cancellation.
double quadratic_advance(double g, double rate, double B) {
  const double root = std::sqrt(rate * rate + 2 * B * g);
  if (rate < 0) return 2 * g / (root - rate);
  return B > 0 ? (rate + root) / B : std::numeric_limits<double>::infinity();
}

/// The least height of a's core along n over [s, s + d], as a function of d that is concave:
/// g + (c + m.y) - ... with the bend K of the parabolas taken off.
struct Descent {
  const Shape& shape;
  const Heights& h;
  double g;       ///< [m] at d = 0: phi - floor
  double lowest;  ///< [m] min over y of m[0].y
  double order;   ///< 1 with the second derivatives, 0 without
  double K;       ///< [m]

  Vec3 slope(double d) const { return h.m[0] + d * h.m[1] + order * d * d / 2 * h.m[2]; }
  /// Of a point y of a's core.
  double at(const Vec3& y, double d) const {
    return g + y.dot(slope(d)) - lowest + h.c[1] * d + (order * h.c[2] - K) * d * d / 2;
  }
  /// Where it meets 0, of one point alone.
  double root(const Vec3& y) const {
    const double start = std::fmax(g + y.dot(h.m[0]) - lowest, 0);
    const double bend = order * (h.c[2] + y.dot(h.m[2]));
    return quadratic_advance(start, h.c[1] + y.dot(h.m[1]), std::fmax(K - bend, 0));
  }
};

/// The longest d <= most for which the descent is certainly not below 0: Newton's iteration from
/// above over the lowest points, which ends after finitely many of a polytope.
double advance_core(const Descent& f, double most) {
  double d = most;
  for (int k = 0; k < 8; ++k) {
    const Vec3 y = core_support(f.shape, -f.slope(d));
    const double value = f.at(y, d);
    if (value >= 0) return d;
    const double root = f.root(y);
    if (!(root < d)) return d;                   // its own root, to rounding
    if (k == 7) return d * f.g / (f.g - value);  // concave: above the line from (0, g)
    d = root;
  }
  return 0;
}

double advance(const Chord& chord, const Descent& f, double most) {
  if (chord.a_is_ball()) return f.root(Vec3::Zero());
  return advance_core(f, most);
}

/// How far ahead of a sample the gap stays above the floor; it is `g` above it there (where it is
/// below: how far it stays no lower). Up to a reach D the third order bends by no more than C D/3;
/// any D is safe, and three halvings of its exponent come near the best.
double certified_advance(const Chord& chord, double g, const ChordSample& x,
                         const ChordBounds& bounds, double remaining) {
  g = std::fmax(g, 0);
  const Shape& shape = chord.a().shape;
  const Heights& h = x.heights;
  double lowest = 0, most_bend = h.c[2];
  if (!chord.a_is_ball()) {
    lowest = h.m[0].dot(core_support(shape, -h.m[0]));
    most_bend += h.m[2].dot(core_support(shape, h.m[2]));
  }
  double d =
      std::fmax(g / bounds.mu, advance(chord, {shape, h, g, lowest, 0, bounds.B}, remaining));
  double D = remaining;
  for (int k = 0; k < 3 && d < D; ++k) {
    const double K = std::fmax(bounds.C * D / 3, most_bend);
    d = std::fmax(d, std::fmin(D, advance(chord, {shape, h, g, lowest, 1, K}, D)));
    D = std::sqrt(d * D);
  }
  return d;
}

bool has_rims(const Pair& pair) {
  return part_counts(pair.on_a.shape).rims + part_counts(pair.on_b.shape).rims > 0;
}

/// The floor that a pair can reach: edges of solids meet at 0.
double reachable(const Pair& pair, double floor) {
  if (pair.kind != PairKind::crossing || has_rims(pair)) return floor;
  const double radii = core_radius(pair.on_a.shape) + core_radius(pair.on_b.shape);
  return std::fmax(floor, -radii);
}

ChordHit search(const Chord& chord, double floor) {
  using Outcome = ChordHit::Outcome;
  ChordSample x = sample_chord(chord, 0);
  ChordBounds bounds = first_bounds(chord);
  if (x.phi - bounds.mu > floor) return {Outcome::clear, 1};

  add_higher_bounds(chord, x.phi, bounds);
  double s = 0;
  bool apart = false;  // edges have no inside: just beyond the root they depart
  const bool edges = chord.pair.kind == PairKind::crossing;
  for (int k = 0; k < max_iterations; ++k, x = sample_chord(chord, s)) {
    const double g = x.phi - floor;
    if (!std::isfinite(g) || !std::isfinite(x.rate)) break;
    const bool touches = g <= rounding * bounds.length, departs = x.rate > rounding * bounds.mu;
    if (touches && (!departs || (edges && apart))) return {Outcome::hit, s};
    if (k >= patience && g <= chord.pair.touch && x.rate < 0) {
      return {Outcome::hit, std::fmin(s - std::fmax(g, 0) / x.rate, 1)};
    }
    apart = apart || !touches;
    double d = certified_advance(chord, g, x, bounds, 1 - s);
    const bool overlaps = g < -rounding * bounds.length;
    if (overlaps) d = std::fmax(d, stride);
    if (touches && d < sideways && !chord.a_is_ball()) return {Outcome::hit, s};
    s += std::fmax(d, epsilon);  // s is known no better
    if (s >= 1) return {Outcome::clear, 1};
  }
  return {Outcome::not_converged, s};
}

/// Of a stop, whose gap is linear on the chord.
ChordHit search_stop(const Chord& chord, double floor) {
  using Outcome = ChordHit::Outcome;
  const Stop& stop = chord.pair.stop;
  const int joint = chord.pair.on_a.joint;
  const double start = chord.start(joint), rate = stop.side * chord.rate(joint);
  const double g = stop.side * (start - stop.bound) - floor;
  const double size = std::fmax(std::abs(start), std::abs(stop.bound));
  if (!std::isfinite(g) || !std::isfinite(rate)) return {Outcome::not_converged, 0};
  if (rate >= 0) return {g < -rounding * size ? Outcome::hit : Outcome::clear, g < 0 ? 0.0 : 1.0};
  if (g + rate > 0) return {Outcome::clear, 1};
  return {Outcome::hit, std::fmax(0, g / -rate)};
}

/// Of a crossing with a cylinder: most edges of a large body are far from it. Where a rim is
/// crossed, one part is searched that is near the place.
ChordHit search_at_cylinder(Chord chord, double floor) {
  const Pose X_BA = pose_at_start(chord);
  const double around = distance_around_cylinder(chord.pair, X_BA, {});
  if (around - first_bounds(chord).mu > floor) return {ChordHit::Outcome::clear, 1};
  NearRim near;
  const auto* crossing = std::get_if<RimCrossing>(&chord.pair.kind);
  if (crossing == nullptr) return search(chord, floor);
  if (!near_rim(*crossing, chord.pair, X_BA, near)) return {ChordHit::Outcome::clear, 1};
  (near.of_a ? chord.part_a : chord.part_b) = &near.part;
  return search(chord, floor);
}

}  // namespace

double gap_change_bound(const Tree& tree, const Pair& pair, const VecRef& q, const VecRef& dq) {
  if (pair.is_stop()) return std::abs(Chord{tree, pair, q, dq}.rate(pair.on_a.joint));
  return first_bounds({tree, pair, q, dq}).mu;
}

ChordHit first_hit_on_chord(const Tree& tree, const Pair& pair, const VecRef& q, const VecRef& dq,
                            double floor) {
  if (pair.is_stop()) return search_stop({tree, pair, q, dq}, floor);
  const Chord chord{tree, pair, q, dq};
  floor = reachable(pair, floor);
  const bool at_cylinder = pair.kind == PairKind::crossing && has_rims(pair);
  return at_cylinder ? search_at_cylinder(chord, floor) : search(chord, floor);
}

}  // namespace saltus
