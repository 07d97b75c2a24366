// How fast the centre P of sphere a can move, seen from b.
//
// Reference: theory, section 4, here to third order. With u_l the velocity of P for unit speed of
// joint l, and joints i, j <= l in the order from b to a, the derivatives of P in b's frame are
//
//   dP/dq_l = u_l    d2P/dq_i dq_l = s_i w_i x u_l    d3P/dq_i dq_j dq_l = s_i w_i x (s_j w_j x
//   u_l)
//
// With R_l >= |u_l|, x_l = |dq_l| and T_l the sum of x over the turning joints before l, summing
// over all orders of the indices gives
//
//   |P''|  <= B = sum R_l ((T_l + x_l)^2 - T_l^2)      (l turns)    sum 2 x_l T_l    (l slides)
//   |P'''| <= C = sum R_l ((T_l + x_l)^3 - T_l^3)                   sum 3 x_l T_l^2
//
// R_l is the reach of joint l: its axis' distance to the next joint's origin and from there the
// placements one after the other, each at its longest on the chord, to P if l is on a's branch.
// On b's branch the path ends at b's core (the point or segment that a round shape is swept about,
// the whole of another), and P is no farther from it than phi + the radii.
//
// |phi'| <= mu = sum x_l rho_l: n.u_l is the same for every point of the contact line, so a's
// branch takes P and b's the core's point, and no radius enters.
#include <algorithm>
#include <cmath>

#include "collision/chord_path.hpp"

namespace saltus {
namespace {

/// Makes up for the rounding of these sums, a few units in the 16th digit a joint.
constexpr double slack = 1 + 1e-12;

/// The ball about its origin that holds a shape's core, and the radius round the core.
struct Core {
  double extent, radius;
};

Core core_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {0, sphere->radius};
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    return {capsule->half_length, capsule->radius};
  }
  return {bounding_radius(shape), 0};
}

/// Where the next origin towards the shape can be, seen from a joint's frame (a segment: it may
/// slide on the chord), and the longest path from there on.
struct Path {
  Vec3 first, last;
  double rest;

  double from_axis() const {
    return std::max(std::hypot(first.x(), first.y()), std::hypot(last.x(), last.y())) + rest;
  }
  double from_origin() const { return std::max(first.norm(), last.norm()) + rest; }
};

/// Calls visit(l, x_l, R_l) for each joint of the branch that carries `shape`, from the shape up.
/// Returns the longest path from the common ancestor to the shape's core.
template <class Iterator, class Visit>
double walk_branch(const Chord& chord, const PlacedShape& shape, double sign, Iterator k,
                   Iterator end, Visit visit) {
  Path path{shape.X_JG.p, shape.X_JG.p, core_of(shape.shape).extent};
  for (; k != end && k->sign == sign; ++k) {
    const int l = k->joint;
    const double w = chord.rate(l), x = chord.start(l), h = chord.slide_per_unit(l);
    const bool turns = chord.tree.joint[l].turns();
    visit(l, std::abs(w), turns ? std::hypot(path.from_axis(), h) : 1);
    const Pose& X_PJ = chord.tree.X_PJ[l];
    const Vec3 axis = h * X_PJ.R.col(2);
    path = {X_PJ.p + x * axis, X_PJ.p + (x + w) * axis, path.from_origin()};
  }
  return path.from_origin();
}

template <class Visit>
double walk_branch_a(const Chord& chord, Visit visit) {
  const auto& chain = chord.pair.chain;
  return walk_branch(chord, chord.a(), +1, chain.rbegin(), chain.rend(), visit);
}

template <class Visit>
double walk_branch_b(const Chord& chord, Visit visit) {
  const auto& chain = chord.pair.chain;
  return walk_branch(chord, chord.b(), -1, chain.begin(), chain.end(), visit);
}

}  // namespace

ChordBounds first_bounds(const Chord& chord) {
  double mu = 0;
  const auto add = [&](int, double x, double R) { mu += x * R; };
  const double length_a = walk_branch_a(chord, add), length_b = walk_branch_b(chord, add);
  // A half-space has no end, but is the world's: only where its frame is matters.
  const double far_b = std::isfinite(length_b) ? length_b : chord.b().X_JG.p.norm();
  const double radii = core_of(chord.a().shape).radius + core_of(chord.b().shape).radius;
  return {mu * slack, 0, 0, length_a + far_b + radii};
}

void add_higher_bounds(const Chord& chord, double phi, ChordBounds& bounds) {
  const Tree& tree = chord.tree;
  const auto add = [&](int l, double x, double R, double T) {
    const bool turns = tree.joint[l].turns();
    bounds.B += R * x * (turns ? 2 * T + x : 2 * T);
    bounds.C += R * x * (turns ? 3 * T * (T + x) + x * x : 3 * T * T);
  };
  const double radii = core_of(chord.a().shape).radius + core_of(chord.b().shape).radius;
  const double beyond_b = std::max(phi + bounds.mu, 0.0) + radii;
  double turned = 0;  // T of the next joint from b's end
  walk_branch_b(chord, [&](int l, double x, double R) {
    const bool turns = tree.joint[l].turns();
    add(l, x, turns ? R + beyond_b : R, turned);
    if (turns) turned += x;
  });
  walk_branch_a(chord, [&](int l, double x, double) {
    if (tree.joint[l].turns()) turned += x;
  });
  walk_branch_a(chord, [&](int l, double x, double R) {
    if (tree.joint[l].turns()) turned = std::max(turned - x, 0.0);
    add(l, x, R, turned);
  });
  bounds.B *= slack;
  bounds.C *= slack;
}

}  // namespace saltus
