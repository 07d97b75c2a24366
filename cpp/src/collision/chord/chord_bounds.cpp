// How fast the points P of shape a's core can move, as b sees them.
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
// A ball is one joint that turns about one axis, its third; its first two are at rest.
//
// R_l is the reach of joint l: its axis' distance to the next joint's origin and from there the
// placements one after the other, each at its longest on the chord, to P if l is on a's branch.
// On b's branch the path ends at b's core, and P is no farther from it than phi, the radii and a's
// core across.
//
// Where b is a sphere, P is seen from its centre with the directions of the common ancestor: each
// branch moves its own centre, in the order from the ancestor to the shape, and the sums add.
//
// |phi'| <= mu = sum x_l rho_l: n.u_l is the same for every point of the contact line, so a's
// branch takes P and b's the core's point, and no radius enters.
#include <algorithm>
#include <cmath>

#include "collision/chord/chord_path.hpp"
#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

/// Makes up for the rounding of these sums, a few units in the 16th digit a joint.
constexpr double slack = 1 + 1e-12;

/// Where the next origin towards the shape can be, seen from a joint's frame (a segment: it may
/// slide on the chord), and the longest path from there on.
struct Path {
  Vec3 first, last;
  double rest;

  double from_axis() const {
    return std::sqrt(std::max(first.head<2>().squaredNorm(), last.head<2>().squaredNorm())) + rest;
  }
  double from_axis(const Vec3& axis) const {
    return std::max(axis.cross(first).norm(), axis.cross(last).norm()) + rest;
  }
  double from_origin() const {
    return std::sqrt(std::max(first.squaredNorm(), last.squaredNorm())) + rest;
  }
};

/// Axis of a ball that turns, in the frame that it carries: it is the same all the way.
Vec3 axis_of_ball(const Chord& chord, int joint) {
  return chord.start_of_ball(joint).transpose() * chord.turn_of_ball(joint).normalized();
}

/// Calls visit(l, x_l, R_l) for each joint of the branch that carries `shape`, from the shape up.
/// Returns the longest path from the common ancestor to the shape's core.
template <class Iterator, class Visit>
double walk_branch(const Chord& chord, const Placed& shape, double sign, Iterator k, Iterator end,
                   Visit visit) {
  Path path{shape.X_JG.p, shape.X_JG.p, core_extent(shape.shape)};
  for (; k != end && k->sign == sign; ++k) {
    const int l = k->joint;
    const double w = chord.rate(l), x = chord.start(l), h = chord.slide_per_unit(l);
    double lever = chord.tree.joint[l].turns() ? path.from_axis() : 0;
    if (chord.tree.joint[l].is_ball()) lever = w > 0 ? path.from_axis(axis_of_ball(chord, l)) : 0;
    visit(l, std::abs(w), std::sqrt(lever * lever + h * h));
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

/// Adds the terms of one joint: T is what turns before it.
void add_joint_terms(const Chord& chord, int l, double x, double R, double T, ChordBounds& bounds) {
  const bool turns = chord.tree.joint[l].turns();
  bounds.B += R * x * (turns ? 2 * T + x : 2 * T);
  bounds.C += R * x * (turns ? 3 * T * (T + x) + x * x : 3 * T * T);
}

/// The same for a branch walked from its shape up, in the order from the ancestor down; `before`
/// is what turns before the whole branch.
template <class Walk>
void add_branch_terms(const Chord& chord, const Walk& walk, double before, ChordBounds& bounds) {
  const auto turn_of = [&](int l, double x) { return chord.tree.joint[l].turns() ? x : 0; };
  double T = before;
  walk([&](int l, double x, double) { T += turn_of(l, x); });
  walk([&](int l, double x, double R) {
    T = std::max(T - turn_of(l, x), before);
    add_joint_terms(chord, l, x, R, T, bounds);
  });
}

}  // namespace

ChordBounds first_bounds(const Chord& chord) {
  double mu = 0;
  const auto add = [&](int, double x, double R) { mu += x * R; };
  const double length_a = walk_branch_a(chord, add), length_b = walk_branch_b(chord, add);
  // A half-space has no end, but is the world's: only where its frame is matters.
  const double far_b = std::isfinite(length_b) ? length_b : chord.b().X_JG.p.norm();
  const double radii = core_radius(chord.a().shape) + core_radius(chord.b().shape);
  return {mu * slack, 0, 0, length_a + far_b + radii};
}

void add_higher_bounds(const Chord& chord, double phi, ChordBounds& bounds) {
  const auto walk_a = [&](auto visit) { walk_branch_a(chord, visit); };
  const auto walk_b = [&](auto visit) { walk_branch_b(chord, visit); };
  double before_a = 0;
  if (chord.b_is_sphere()) {
    add_branch_terms(chord, walk_b, 0, bounds);
  } else {
    const double radii = core_radius(chord.a().shape) + core_radius(chord.b().shape);
    const double across_a = 2 * core_extent(chord.a().shape);
    const double beyond_b = std::max(phi + bounds.mu, 0.0) + radii + across_a;
    walk_b([&](int l, double x, double R) {
      const bool turns = chord.tree.joint[l].turns();
      add_joint_terms(chord, l, x, turns ? R + beyond_b : R, before_a, bounds);
      if (turns) before_a += x;
    });
  }
  add_branch_terms(chord, walk_a, before_a, bounds);
  bounds.B *= slack;
  bounds.C *= slack;
}

}  // namespace saltus
