#include "saltus/collision/parts.hpp"

#include <algorithm>
#include <cassert>

#include "collision/parts/crossing.hpp"
#include "collision/parts/on_faces.hpp"
#include "collision/parts/rim_crossing.hpp"
#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

template <class Kind>
bool is(const Shape& shape) {
  return std::holds_alternative<Kind>(shape);
}

/// What has no parts touches anything in one point.
bool is_round(const Shape& shape) {
  const PartCounts n = part_counts(shape);
  return n.corners + n.edges + n.rims == 0 && !is<HalfSpace>(shape);
}

/// Edges of solids are listed up to this many crossings of two shapes: boxes have 144, hexagonal
/// prisms 324. Each is a gap of its own, looked at in every step in which the two are near.
constexpr int most_crossings = 400;

/// The parts of two shapes, in this order.
struct Counts {
  int corners_a = 0, corners_b = 0;
  int lines = 0;   ///< an edge and an edge
  int over_a = 0;  ///< an edge of b and the rims of a, in and out
  int over_b = 0;  ///< an edge of a and those of b
  int tips = 0;    ///< a rim and a rim, left and right
  int rims_a = 0, rims_b = 0;
  int whole = 0;
  int crossings() const { return lines + over_a + over_b + tips; }
  int all() const { return corners_a + corners_b + crossings() + rims_a + rims_b + whole; }
};

Counts counts_of(const Shape& a, const Shape& b) {
  if (!has_gap(a, b)) return {};
  if (is_round(a) || is_round(b)) return {.whole = 1};
  const PartCounts of_a = part_counts(a), of_b = part_counts(b);
  if (is<HalfSpace>(b)) return {.corners_a = of_a.corners, .rims_a = of_a.rims};
  Counts n{.corners_a = of_a.corners,
           .corners_b = of_b.corners,
           .lines = of_a.edges * of_b.edges,
           .over_a = of_a.rims * of_b.edges,
           .over_b = of_b.rims * of_a.edges,
           .tips = of_a.rims * of_b.rims / 2,
           .rims_a = of_a.rims,
           .rims_b = of_b.rims};
  if (n.crossings() <= most_crossings) return n;
  n.lines = n.over_a = n.over_b = n.tips = 0;
  n.whole = 1;
  return n;
}

bool goes_second(const Shape& a, const Shape& b) {
  return is<HalfSpace>(a) || (is<Sphere>(b) && !is<Sphere>(a));
}

PartOfShape all_of(const Shape& shape, const std::string& name = "") {
  return {name, shape, {}, Vec3::Zero(), {}};
}

/// Both parts and the kind of their gap.
struct Parts {
  PairKind kind;
  bool exchanged;  ///< the first part is of b
  PartOfShape a, b;
  RimPart rim = RimPart::none;
};

/// Edge k / 2 of `other` over the rims of `can`: where it goes in, or comes out.
Parts over_rim(const Shape& can, const Shape& other, int k, bool exchanged) {
  const bool in = k % 2 == 0;
  return {PairKind::crossing, exchanged, all_of(can, in ? "in" : "out"), edge(other, k / 2),
          in ? RimPart::in : RimPart::out};
}

/// Where the rims of two cylinders cross.
Parts tip(const Shape& a, const Shape& b, int k) {
  const std::string name = k == 0 ? "left" : "right";
  return {PairKind::crossing, false, all_of(a, name), all_of(b, name),
          k == 0 ? RimPart::left : RimPart::right};
}

Parts parts_of(const Shape& a, const Shape& b, int k) {
  const Counts n = counts_of(a, b);
  assert(k >= 0 && k < n.all());
  if (k < n.corners_a) return {PairKind::corner, false, corner(a, k), all_of(b)};
  k -= n.corners_a;
  if (k < n.corners_b) return {PairKind::corner, true, corner(b, k), all_of(a)};
  k -= n.corners_b;
  if (k < n.lines) {
    const int edges_b = part_counts(b).edges;
    return {PairKind::crossing, false, edge(a, k / edges_b), edge(b, k % edges_b)};
  }
  k -= n.lines;
  if (k < n.over_a) return over_rim(a, b, k, false);
  k -= n.over_a;
  if (k < n.over_b) return over_rim(b, a, k, true);
  k -= n.over_b;
  if (k < n.tips) return tip(a, b, k);
  k -= n.tips;
  if (k < n.rims_a) return {PairKind::whole, false, rim(a, k), all_of(b), RimPart::nearest};
  k -= n.rims_a;
  if (k < n.rims_b) return {PairKind::whole, true, rim(b, k), all_of(a), RimPart::nearest};
  return {PairKind::whole, false, all_of(a), all_of(b)};
}

Placed put(const PlacedShape& shape, const PartOfShape& part) {
  return {part.shape, shape.joint, shape.X_JG * part.X_GP};
}

/// A corner or rim that slides over the border of a face stays in its plane, also where that ends.
/// What is round bears the rims and the points of cylinders as it is.
bool is_held_in_faces(const Shape& a, const Parts& parts, const Shape& b) {
  const PartCounts n = part_counts(b);
  if (parts.rim != RimPart::none) return n.faces > 0 && n.rims == 0;
  return part_counts(a).rims == 0 || n.faces > 0;
}

Pair pair_of(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b,
             const Parts& parts) {
  Pair pair;
  pair.a = a;
  pair.b = b;
  pair.kind = parts.kind;
  pair.rim = parts.rim;
  pair.on_a = put(shapes[a], parts.a);
  pair.on_b = put(shapes[b], parts.b);
  pair.out_a = parts.a.out;
  pair.out_b = parts.b.out;
  if (is_held_in_faces(shapes[a].shape, parts, shapes[b].shape)) pair.inward = parts.a.inward;
  pair.chain = chain_between(tree, pair.on_b.joint, pair.on_a.joint);
  pair.touch =
      relative_touch * std::min(feature_size(shapes[a].shape), feature_size(shapes[b].shape));
  return pair;
}

}  // namespace

int part_count(const Shape& a, const Shape& b) {
  return goes_second(a, b) ? counts_of(b, a).all() : counts_of(a, b).all();
}

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
  pair.lists_edges = n.crossings() > 0;
  pair.skips_corners =
      parts.kind == PairKind::whole && parts.rim == RimPart::none && n.corners_a + n.corners_b > 0;
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
  return part_gap(pair, X_WA, X_WB, Vec3::Zero());
}

Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3& motion_W) {
  if (pair.kind == PairKind::crossing) {
    return pair.rim == RimPart::none ? crossing_gap(pair, X_WA, X_WB)
                                     : rim_crossing_gap(pair, X_WA, X_WB);
  }
  if (pair.rim != RimPart::none) return rim_on_faces(pair, X_WA, X_WB);
  if (!pair.inward.empty()) return corner_on_faces(pair, X_WA, X_WB, motion_W);
  return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
}

bool is_silent(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  if (pair.kind == PairKind::crossing) {
    return pair.rim == RimPart::none ? !is_crossing(pair, X_WA, X_WB, gap)
                                     : !is_rim_crossing(pair, X_WA, X_WB, gap);
  }
  if (pair.rim != RimPart::none) return is_rim_silent(pair, X_WA, X_WB, gap);
  if (pair.kind == PairKind::corner) return is_rim_point_silent(pair, X_WA, gap);
  if (!pair.skips_corners) return false;
  const auto on_corner = [](const Shape& shape, const Patch& patch) {
    return patch.dim == 0 && part_counts(shape).rims == 0;
  };
  const auto on_rim = [](const Shape& shape, const Patch& patch, const Patch& other) {
    return patch.dim == 1 && other.dim == 2 && part_counts(shape).rims > 0;
  };
  const Shape &a = pair.on_a.shape, &b = pair.on_b.shape;
  return on_corner(a, gap.a) || on_corner(b, gap.b) || on_rim(a, gap.a, gap.b) ||
         on_rim(b, gap.b, gap.a);
}

}  // namespace saltus
