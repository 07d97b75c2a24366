#include "saltus/collision/parts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "collision/corners.hpp"
#include "collision/crossing.hpp"
#include "collision/point_distance.hpp"

namespace saltus {
namespace {

template <class Kind>
bool is(const Shape& shape) {
  return std::holds_alternative<Kind>(shape);
}

/// Balls and ellipsoids touch anything in one point.
bool is_round(const Shape& shape) { return is<Sphere>(shape) || is<Ellipsoid>(shape); }

/// True where every pair of edges is listed; else the whole stands for them.
bool lists_edges(const Shape& a, const Shape& b) { return edge_count(a) > 0 && edge_count(b) > 0; }

/// The parts of two shapes, in this order.
struct Counts {
  int corners_a = 0, corners_b = 0, crossings = 0, rims = 0, whole = 0;
  int all() const { return corners_a + corners_b + crossings + rims + whole; }
};

Counts counts_of(const Shape& a, const Shape& b) {
  if (!has_gap(a, b)) return {};
  if (is_round(a) || is_round(b)) return {.whole = 1};
  if (is<HalfSpace>(b)) return {.corners_a = corner_count(a), .rims = is<Cylinder>(a) ? 2 : 0};
  const int edges = lists_edges(a, b) ? edge_count(a) * edge_count(b) : 0;
  return {corner_count(a), corner_count(b), edges, 0, edges > 0 ? 0 : 1};
}

bool goes_second(const Shape& a, const Shape& b) {
  return is<HalfSpace>(a) || (is<Sphere>(b) && !is<Sphere>(a));
}

PartOfShape all_of(const Shape& shape) { return {"", shape, {}, Vec3::Zero()}; }

/// Both parts and the kind of their gap.
struct Parts {
  PairKind kind;
  bool exchanged;  ///< the first part is of b
  PartOfShape a, b;
};

Parts parts_of(const Shape& a, const Shape& b, int k) {
  const Counts n = counts_of(a, b);
  assert(k >= 0 && k < n.all());
  if (k < n.corners_a) return {PairKind::corner, false, corner(a, k), all_of(b)};
  k -= n.corners_a;
  if (k < n.corners_b) return {PairKind::corner, true, corner(b, k), all_of(a)};
  k -= n.corners_b;
  if (k < n.crossings) {
    return {PairKind::crossing, false, edge(a, k / edge_count(b)), edge(b, k % edge_count(b))};
  }
  k -= n.crossings;
  if (k < n.rims) return {PairKind::whole, false, rim(std::get<Cylinder>(a), k), all_of(b)};
  return {PairKind::whole, false, all_of(a), all_of(b)};
}

Placed put(const PlacedShape& shape, const PartOfShape& part) {
  return {part.shape, shape.joint, shape.X_JG * part.X_GP};
}

/// A corner in the touch of a box: its nearest face, but where several are near to `flush` of the
/// box's size that one which faces the corner's own body least. Cubes that are stacked edge on edge
/// touch with such corners, and rounding may not choose the normal.
Gap corner_on_box(const Pair& pair, const Pose& X_WA, const Pose& X_WB) {
  constexpr double flush = 1e-9;
  const Vec3 half = std::get<Box>(pair.on_b.shape).half, c = in_frame(X_WB, X_WA.p);
  const Vec3 e = c.cwiseAbs() - half, out_B = X_WB.R.transpose() * (X_WA.R * pair.out_a);
  const double tolerance = flush * half.minCoeff(), most = e.maxCoeff();
  if (most > tolerance) return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
  int best = -1;
  double cosine = 0;
  for (int k = 0; k < 3; ++k) {
    const double along = -side(c[k]) * out_B[k];
    if (e[k] < most - tolerance || (best >= 0 && along <= cosine)) continue;
    best = k;
    cosine = along;
  }
  return sphere_gap(std::get<Sphere>(pair.on_a.shape), X_WA, X_WB,
                    {e[best], side(c[best]) * Vec3::Unit(best), face_across(best)});
}

}  // namespace

int part_count(const Shape& a, const Shape& b) {
  return goes_second(a, b) ? counts_of(b, a).all() : counts_of(a, b).all();
}

namespace {

Pair pair_of(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b,
             const Parts& parts) {
  Pair pair;
  pair.a = a;
  pair.b = b;
  pair.kind = parts.kind;
  pair.on_a = put(shapes[a], parts.a);
  pair.on_b = put(shapes[b], parts.b);
  pair.out_a = parts.a.out;
  pair.out_b = parts.b.out;
  pair.chain = chain_between(tree, pair.on_b.joint, pair.on_a.joint);
  // epsilon_phi: 1e-10 of the smaller shape is far above the rounding of positions (1e-16 of the
  // scene) and far below what anybody can see
  pair.touch = 1e-10 * std::min(feature_size(shapes[a].shape), feature_size(shapes[b].shape));
  return pair;
}

}  // namespace

Pair make_solid_pair(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b) {
  if (goes_second(shapes[a].shape, shapes[b].shape)) std::swap(a, b);
  const Parts parts{PairKind::whole, false, all_of(shapes[a].shape), all_of(shapes[b].shape)};
  return pair_of(tree, shapes, a, b, parts);
}

Pair make_pair(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b, int part) {
  if (goes_second(shapes[a].shape, shapes[b].shape)) std::swap(a, b);
  const Parts parts = parts_of(shapes[a].shape, shapes[b].shape, part);
  if (parts.exchanged) std::swap(a, b);
  Pair pair = pair_of(tree, shapes, a, b, parts);
  pair.part = part;
  const Counts n = counts_of(shapes[a].shape, shapes[b].shape);
  pair.skips_corners = parts.kind == PairKind::whole && n.corners_a + n.corners_b > 0;
  return pair;
}

std::string pair_name(const std::vector<PlacedShape>& shapes, const Pair& pair) {
  const int first = std::min(pair.a, pair.b), second = std::max(pair.a, pair.b);
  const bool exchanged = goes_second(shapes[first].shape, shapes[second].shape);
  const int a = exchanged ? second : first, b = exchanged ? first : second;
  const Parts parts = parts_of(shapes[a].shape, shapes[b].shape, pair.part);
  const auto show = [&](int shape, const std::string& part) {
    return shapes[shape].name + (part.empty() ? "" : "[" + part + "]");
  };
  return show(pair.a, parts.a.name) + " ~ " + show(pair.b, parts.b.name);
}

Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB) {
  if (pair.kind == PairKind::crossing) return crossing_gap(pair, X_WA, X_WB);
  if (pair.kind == PairKind::corner && std::holds_alternative<Box>(pair.on_b.shape) &&
      !pair.out_a.isZero(0)) {
    return corner_on_box(pair, X_WA, X_WB);
  }
  return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
}

bool is_silent(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  if (pair.kind == PairKind::crossing) return !is_crossing(pair, X_WA, X_WB, gap);
  if (!pair.skips_corners) return false;
  if (std::holds_alternative<HalfSpace>(pair.on_b.shape)) {  // the rim of a cylinder that stands
    constexpr double upright = 1e-10;
    return X_WA.R.col(2).cross(gap.n_W).norm() < upright;
  }
  const auto on_corner = [](const Shape& shape, const Patch& patch) {
    return patch.dim == 0 && !std::holds_alternative<Cylinder>(shape);
  };
  return on_corner(pair.on_a.shape, gap.a) || on_corner(pair.on_b.shape, gap.b);
}

}  // namespace saltus
