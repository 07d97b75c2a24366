// Lines x(xi) = c_a + xi t_a and y(eta) = c_b + eta t_b, at rest where w = x - y is across both:
//
//   n = +- t_a x t_b / |t_a x t_b|,  d = n.(c_a - c_b)
//   xi = ((t_b.w0)(t_a.t_b) - t_a.w0)/det,  eta = (t_b.w0 - (t_a.w0)(t_a.t_b))/det,  w0 = c_a - c_b
//
// with det = 1 - (t_a.t_b)^2. n points out of b and into a where these have a side there (the
// edges of solids: then d < 0 is penetration); two bare axes have no sides, and d >= 0.
#include <cmath>
#include <limits>

#include "collision/parts/kinds.hpp"

namespace saltus {
namespace {

/// Below this sine edges count as parallel: their ends bear the load, and 1/det loses its digits.
constexpr double parallel = 1e-6;

/// Part of an edge next to its ends that is left to the corners.
constexpr double end = 1e-9;

Vec3 axis(const Pose& X) { return X.R.col(2); }

}  // namespace

bool is_within_ends(const Shape& edge, const Pose& X_WE, const Vec3& p_W) {
  const double along = axis(X_WE).dot(p_W - X_WE.p);
  return std::abs(along) <= edge_capsule(edge).half_length * (1 - end);
}

// |out| = 1/cos(half), and cos(half + tilt)/cos(half) = 1 - tilt tan(half) nearly
bool is_in_cone(const Vec3& n_W, const Vec3& out_W) {
  const double tangent = std::sqrt(std::fmax(out_W.squaredNorm() - 1, 0));
  return n_W.dot(out_W) >= 1 - tilt * (1 + tangent);
}

Parts crossing_parts(const Shape& a, const Shape& b, int k) {
  const int edges_b = part_counts(b).edges;
  const PartOfShape part_a = edge(a, k / edges_b), part_b = edge(b, k % edges_b);
  return {part_a, part_b, Crossing{part_a.out, part_b.out}};
}

/// Of the two axes, less both radii, as if they had no ends; phi is infinite where they are
/// parallel.
Gap gap_of(const Crossing& at, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&) {
  const Capsule a = edge_capsule(pair.on_a.shape), b = edge_capsule(pair.on_b.shape);
  const Vec3 t_a = axis(X_WA), t_b = axis(X_WB), w0 = X_WA.p - X_WB.p;
  const Vec3 across = t_a.cross(t_b);
  const double sine = across.norm(), cosine = t_a.dot(t_b);
  Gap g{};
  g.a = {.dim = 1, .t0 = t_a};
  g.b = {.dim = 1, .t0 = t_b};
  if (sine < parallel) {
    g.phi = g.d = std::numeric_limits<double>::infinity();
    g.n_W = t_a.unitOrthogonal();
    g.p_WA = g.center_W = X_WA.p;
    g.p_WB = X_WB.p;
    return g;
  }
  g.n_W = across / sine;
  const Vec3 out = X_WB.R * at.out_b - X_WA.R * at.out_a;
  if (g.n_W.dot(out.isZero(0) ? w0 : out) < 0) g.n_W = -g.n_W;
  const double xi = (t_b.dot(w0) * cosine - t_a.dot(w0)) / (sine * sine);
  g.d = g.n_W.dot(w0);
  g.phi = g.d - a.radius - b.radius;
  g.center_W = X_WA.p + xi * t_a;
  g.p_WA = g.center_W - a.radius * g.n_W;
  g.p_WB = g.p_WA - g.phi * g.n_W;
  return g;
}

double distance_around_cylinder(const Pair& pair, const Pose& X_WA, const Pose& X_WB) {
  const Shape &a = pair.on_a.shape, &b = pair.on_b.shape;
  const bool is_a = part_counts(a).rims > 0;
  if (!is_a && part_counts(b).rims == 0) {
    return -std::numeric_limits<double>::infinity();
  }
  const Sphere ball{bounding_radius(is_a ? a : b)};
  return is_a ? gap(ball, X_WA, b, X_WB).phi : gap(ball, X_WB, a, X_WA).phi;
}

/// Where the lines cross beyond the ends of an edge, or on the far side of a body.
bool silent(const Crossing& at, const Pair& pair, const Pose& X_WA, const Pose& X_WB,
            const Gap& gap) {
  if (!(gap.phi > -deepest * pair.touch) || !std::isfinite(gap.phi)) return true;
  if (!is_within_ends(pair.on_a.shape, X_WA, gap.p_WA)) return true;
  if (!is_within_ends(pair.on_b.shape, X_WB, gap.p_WB)) return true;
  if (!at.out_a.isZero(0) && !is_in_cone(-gap.n_W, X_WA.R * at.out_a)) return true;
  return !at.out_b.isZero(0) && !is_in_cone(gap.n_W, X_WB.R * at.out_b);
}

}  // namespace saltus
