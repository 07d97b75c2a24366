// A can that stands on a table, in part beyond its border, is held where the border goes in below
// its cap and where it comes out; where a cap lies flat on another, where their rims cross. These
// are watched while the edge is within cosine_flat of the cap's plane; beyond, one place alone is
// nearest, and the rim as a whole has it.
//
// In a's frame, z its axis: the edge's line y + s e is over the rim where it crosses the round of
// the cylinder,
//
//   |(y + s e)_xy| = r,   s = s_0 -+ sqrt(r^2 - |(y + s_0 e)_xy|^2)/|e_xy|,   s_0 =
//   -y_xy.e_xy/e_xy^2
//
// (of a round edge the line on its surface that faces the cap),
// and two rims, seen along n, where circles cross: with c from centre to centre, u = c/|c|,
//
//   x = (c^2 + r_a^2 - r_b^2)/(2 c) u +- sqrt(r_a^2 - ...) n x u
//
// Both exact where cap and edge, or the caps, are parallel or touch there; meeting.cpp goes on from
// there to where x - y is across both.
#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/convex/meeting.hpp"
#include "collision/parts/kinds.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {
namespace {

/// A round edge that lies tilted may cross beside where it seems to: this part of the radius.
constexpr double near = 0.05;

using Where = RimCrossing::Place;

/// What a pair is about.
struct Place {
  const Shape& shape_a;
  Cylinder a;
  const Shape& b;
  RimCrossing::Place place;
  Vec3 out_a, out_b;  ///< as in Pair

  bool of_rims() const { return place == Where::left || place == Where::right; }
  const Cylinder& other() const { return std::get<Cylinder>(b); }
};

Place place_of(const RimCrossing& at, const Pair& pair) {
  const Shape& a = pair.on_a.shape;
  return {a, std::get<Cylinder>(a), pair.on_b.shape, at.place, Vec3::Zero(), at.out_b};
}

/// Out of the cap that is nearer to p.
Vec3 cap_towards(const Pose& X, const Vec3& p_W) {
  const Vec3 z = X.R.col(2);
  return side(z.dot(p_W - X.p)) * z;
}

/// Where to look, in a's frame moved to the world's axes: about a's origin.
struct Guess {
  Vec3 x, y, n;
  Vec3 middle;  ///< of the two places
};

bool edge_over_rim(const Place& x, const Pose& X_WA, const Pose& X_WB, Guess& out) {
  const double r = x.a.radius, radius = edge_capsule(x.b).radius;
  const Vec3 z = X_WA.R.col(2), e = X_WB.R.col(2);
  const Vec3 e_across = e - z.dot(e) * z;
  const double square = e_across.squaredNorm();
  if (!(square > 0.5)) return false;  // far from flat
  const Vec3 axis = X_WB.p - X_WA.p;
  const Vec3 m = side(z.dot(axis - axis.dot(e_across) / square * e)) * z;
  const Vec3 off = radius * (m - e.dot(m) * e).normalized(), y = axis - off;
  const double s_0 = -y.dot(e_across) / square;
  const Vec3 y_across = y - z.dot(y) * z;
  const double half = r * r - (y_across + s_0 * e_across).squaredNorm();
  if (!(half > -near * r * r)) return false;
  const double far = std::sqrt(std::fmax(half, near * near * r * r) / square);
  const double s = s_0 + (x.place == Where::in ? -far : far);
  out.middle = y + s_0 * e;
  out.y = axis + s * e;
  out.n = -m;
  const Vec3 there = out.y - off;
  out.x = r * (there - z.dot(there) * z).normalized() + x.a.half_length * m;
  return true;
}

bool rim_over_rim(const Place& x, const Pose& X_WA, const Pose& X_WB, Guess& out) {
  const Cylinder &a = x.a, &b = x.other();
  out.n = -cap_towards(X_WA, X_WB.p);
  const Vec3 m = cap_towards(X_WB, X_WA.p);
  if (out.n.dot(m) < cosine_flat) return false;
  const Vec3 at_a = -a.half_length * out.n, at_b = X_WB.p - X_WA.p + b.half_length * m;
  const Vec3 apart = at_b - at_a, line = apart - out.n.dot(apart) * out.n;
  const double c = line.norm();
  if (c < no_length) return false;
  const double along = (c * c + a.radius * a.radius - b.radius * b.radius) / (2 * c);
  const double square = a.radius * a.radius - along * along;
  if (!(square > 0)) return false;
  const Vec3 u = line / c, v = (x.place == Where::left ? 1 : -1) * out.n.cross(u);
  out.middle = at_a + along * u;
  out.x = out.middle + std::sqrt(square) * v;
  out.y = out.x + out.n.dot(apart) * out.n;
  return true;
}

bool guess(const Place& x, const Pose& X_WA, const Pose& X_WB, Guess& out) {
  return x.of_rims() ? rim_over_rim(x, X_WA, X_WB, out) : edge_over_rim(x, X_WA, X_WB, out);
}

Gap nowhere(const Pose& X_WA, const Pose& X_WB) {
  Gap g{};
  g.phi = g.d = std::numeric_limits<double>::infinity();
  g.n_W = X_WA.R.col(2);
  g.p_WA = g.center_W = X_WA.p;
  g.p_WB = X_WB.p;
  return g;
}

/// True where n is out of a cylinder's cap, nearly, and at the point p not into its side.
bool is_off_cap(const Pose& X, const Vec3& cap, const Vec3& p_W, const Vec3& n_W) {
  const Vec3 from_axis = p_W - X.p;
  const Vec3 w = (from_axis - cap.dot(from_axis) * cap).normalized();
  return n_W.dot(cap) >= cosine_flat && n_W.dot(w) >= -tilt;
}

bool is_edge_there(const Place& x, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  const Vec3 z = X_WA.R.col(2), e = X_WB.R.col(2), from_axis = gap.p_WA - X_WA.p;
  const bool goes_in = e.dot(from_axis - z.dot(from_axis) * z) < 0;
  if (goes_in != (x.place == Where::in)) return false;
  if (!is_within_ends(x.b, X_WB, gap.p_WB)) return false;
  return x.out_b.isZero(0) || is_in_cone(gap.n_W, X_WB.R * x.out_b);
}

Gap gap_at(const Place& place, const Pose& X_WA, const Pose& X_WB) {
  Guess at;
  if (!guess(place, X_WA, X_WB, at)) return nowhere(X_WA, X_WB);
  const Vec3 p_B = X_WB.p - X_WA.p;
  const Solid A = solid_of(place.shape_a, X_WA.R, Vec3::Zero());
  const bool rims = place.of_rims();
  const Capsule edge = edge_capsule(place.b);
  const Shape line = edge;
  const Solid B = solid_of(rims ? place.b : line, X_WB.R, p_B);
  const Vec3 end = edge.half_length * X_WB.R.col(2);
  Feature a = rim_at(A, at.x), b = rims ? rim_at(B, at.y) : edge_between(p_B - end, p_B + end);
  if (!rims) b.x = at.y;
  Vec3 n = at.n;
  if (!meet(A, B, a, b, n)) return nowhere(X_WA, X_WB);
  const double d = n.dot(a.x - b.x);
  return {.phi = d - B.radius,
          .n_W = n,
          .p_WA = X_WA.p + a.x,
          .p_WB = X_WA.p + (b.x + B.radius * n),
          .center_W = X_WA.p + a.x,
          .d = d,
          .a = patch_of(A, a, n),
          .b = patch_of(B, b, n)};
}

bool is_there(const Place& x, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  if (!std::isfinite(gap.phi)) return false;
  if (gap.a.t0.cross(gap.b.t0).norm() < along_rim) return false;
  // of a disc the point tells no side
  const Vec3 cap = x.out_a.isZero(0) ? cap_towards(X_WA, gap.p_WA) : Vec3(X_WA.R * x.out_a);
  if (!is_off_cap(X_WA, cap, gap.p_WA, -gap.n_W)) return false;
  if (x.of_rims()) return is_off_cap(X_WB, cap_towards(X_WB, gap.p_WB), gap.p_WB, gap.n_W);
  return is_edge_there(x, X_WA, X_WB, gap);
}

}  // namespace

Parts edge_over_rim_parts(const Shape& a, const Shape& b, int k) {
  const PartOfShape part = edge(b, k / 2);
  const bool in = k % 2 == 0;
  return {all_of(a, in ? "in" : "out"), part, RimCrossing{in ? Where::in : Where::out, part.out}};
}

Parts rim_over_rim_parts(const Shape& a, const Shape& b, int k) {
  const std::string name = k == 0 ? "left" : "right";
  return {all_of(a, name), all_of(b, name),
          RimCrossing{k == 0 ? Where::left : Where::right, Vec3::Zero()}};
}

/// Of the rim's circle, there, and the line of the edge, less its radius; or of the two circles.
/// phi is infinite where there is no such place.
Gap gap_of(const RimCrossing& at, const Pair& pair, const Pose& X_WA, const Pose& X_WB,
           const Vec3&) {
  return gap_at(place_of(at, pair), X_WA, X_WB);
}

/// Where it is beyond an end of the edge, on the far side of a body, or tilted.
bool silent(const RimCrossing& at, const Pair& pair, const Pose& X_WA, const Pose& X_WB,
            const Gap& gap) {
  return !(gap.phi > -deepest * pair.touch) || !is_there(place_of(at, pair), X_WA, X_WB, gap);
}

bool is_rim_crossed(const Rim& rim, const Pair& pair, bool by_rim, const Pose& X_WA,
                    const Pose& X_WB, const Gap& gap) {
  const Shape& a = pair.on_a.shape;
  for (const bool first : {true, false}) {
    const Where where =
        by_rim ? (first ? Where::left : Where::right) : (first ? Where::in : Where::out);
    const Place x{a, std::get<Cylinder>(a), pair.on_b.shape, where, rim.out, Vec3::Zero()};
    const Gap g = gap_at(x, X_WA, X_WB);
    if (g.phi <= gap.phi + pair.touch && is_there(x, X_WA, X_WB, g)) return true;
  }
  return false;
}

bool near_rim(const RimCrossing& crossing, const Pair& pair, const Pose& X_BA, NearRim& out) {
  Guess at;
  const Place x = place_of(crossing, pair);
  if (!guess(x, X_BA, {}, at)) return false;
  out.of_a = x.of_rims();
  out.part.joint = out.of_a ? pair.on_a.joint : pair.on_b.joint;
  Vec3 from = at.middle, to = at.x;
  if (!out.of_a) {  // in b's frame, whose z axis is the edge
    const double half = edge_capsule(pair.on_b.shape).half_length;
    const double middle = X_BA.p.z() + at.middle.z();
    from = std::clamp(middle, -half, half) * Vec3::UnitZ();
    to = (crossing.place == Where::in ? -half : half) * Vec3::UnitZ();
  } else {
    from = X_BA.R.transpose() * from;
    to = X_BA.R.transpose() * to;
  }
  const double length = (to - from).norm();
  if (!(length > 0)) return false;
  const Pose X_GP{rotation_z_to((to - from) / length), (from + to) / 2};
  const Placed& whole = out.of_a ? pair.on_a : pair.on_b;
  const double radius = out.of_a ? 0 : edge_capsule(pair.on_b.shape).radius;
  out.part.X_JG = whole.X_JG * X_GP;
  out.part.shape = Capsule{radius, length / 2};
  const bool is_side = !out.of_a && part_counts(pair.on_b.shape).rims > 0;
  if (is_side) out.part.shape = Cylinder{radius, length / 2};
  return true;
}

}  // namespace saltus
