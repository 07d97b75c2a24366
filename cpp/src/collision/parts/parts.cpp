#include "saltus/collision/parts.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "collision/parts/kinds.hpp"

namespace saltus {
namespace {

/// Edges of solids are listed up to this many crossings of two shapes: boxes have 144, hexagonal
/// prisms 324. Each is a gap of its own, looked at in every step in which the two are near.
constexpr int most_crossings = 400;

/// Some of the gaps of two shapes.
struct Rule {
  bool exchanged;  ///< the first part is of b
  bool crosses;    ///< edges or rims
  int (*count)(const PartCounts& a, const PartCounts& b);
  Parts (*parts)(const Shape& a, const Shape& b, int k);
};

int corners(const PartCounts& a, const PartCounts&) { return a.corners; }
int lines(const PartCounts& a, const PartCounts& b) { return a.edges * b.edges; }
int edges_over_rims(const PartCounts& a, const PartCounts& b) { return a.rims * b.edges; }
int rims_over_rims(const PartCounts& a, const PartCounts& b) { return a.rims * b.rims / 2; }
int rims(const PartCounts& a, const PartCounts&) { return a.rims; }
int none(const PartCounts&, const PartCounts&) { return 0; }

Parts wholes(const Shape& a, const Shape& b, int) { return {all_of(a), all_of(b), Whole{}}; }

/// In the order of their numbers; the last stands in for the others.
constexpr Rule rules[] = {{false, false, corners, corner_parts},
                          {true, false, corners, corner_parts},
                          {false, true, lines, crossing_parts},
                          {false, true, edges_over_rims, edge_over_rim_parts},
                          {true, true, edges_over_rims, edge_over_rim_parts},
                          {false, true, rims_over_rims, rim_over_rim_parts},
                          {false, false, rims, rim_parts},
                          {true, false, rims, rim_parts},
                          {false, false, none, wholes}};

template <class S>
bool is(const Shape& shape) {
  return std::holds_alternative<S>(shape);
}

/// What has no parts touches anything in one point.
bool is_round(const Shape& shape) {
  const PartCounts n = part_counts(shape);
  return n.corners + n.edges + n.rims == 0 && !is<HalfSpace>(shape);
}

struct Counts {
  std::array<int, std::size(rules)> of = {};  ///< each rule

  int all() const { return std::accumulate(of.begin(), of.end(), 0); }
  int corners() const { return of[0] + of[1]; }
  int crossings() const { return of[2] + of[3] + of[4] + of[5]; }
};

Counts counts_of(const Shape& a, const Shape& b) {
  Counts n;
  if (!has_gap(a, b)) return n;
  const PartCounts of_a = part_counts(a), of_b = part_counts(b);
  const bool round = is_round(a) || is_round(b);
  for (std::size_t i = 0; i < n.of.size() && !round; ++i) {
    n.of[i] = rules[i].exchanged ? rules[i].count(of_b, of_a) : rules[i].count(of_a, of_b);
  }
  const bool too_many = n.crossings() > most_crossings;
  for (std::size_t i = 0; i < n.of.size() && too_many; ++i) {
    if (rules[i].crosses) n.of[i] = 0;
  }
  if (round || too_many) n.of.back() = 1;
  return n;
}

bool goes_second(const Shape& a, const Shape& b) {
  return is<HalfSpace>(a) || (is<Sphere>(b) && !is<Sphere>(a));
}

/// Their gap number k; exchanges a and b where the first part is of b.
Parts parts_of(const std::vector<PlacedShape>& shapes, int& a, int& b, int k) {
  const Counts n = counts_of(shapes[a].shape, shapes[b].shape);
  assert(k >= 0 && k < n.all());
  std::size_t i = 0;
  for (; k >= n.of[i]; ++i) k -= n.of[i];
  if (rules[i].exchanged) std::swap(a, b);
  return rules[i].parts(shapes[a].shape, shapes[b].shape, k);
}

Placed put(const PlacedShape& shape, const PartOfShape& part) {
  return {part.shape, shape.joint, shape.X_JG * part.X_GP};
}

/// A corner or rim that slides over the border of a face stays in its plane, also where that ends.
/// What is round bears the rims and the points of cylinders as it is.
bool is_held_in_faces(const Shape& a, const Parts& parts, const Shape& b) {
  const PartCounts n = part_counts(b);
  if (std::holds_alternative<Rim>(parts.kind)) return n.faces > 0 && n.rims == 0;
  return part_counts(a).rims == 0 || n.faces > 0;
}

Pair pair_of(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b,
             const Parts& parts) {
  Pair pair;
  pair.a = a;
  pair.b = b;
  pair.kind = parts.kind;
  pair.on_a = put(shapes[a], parts.a);
  pair.on_b = put(shapes[b], parts.b);
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
  return pair_of(tree, shapes, a, b, wholes(shapes[a].shape, shapes[b].shape, 0));
}

Pair make_pair(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b, int part) {
  if (goes_second(shapes[a].shape, shapes[b].shape)) std::swap(a, b);
  const Counts n = counts_of(shapes[a].shape, shapes[b].shape);
  const Parts parts = parts_of(shapes, a, b, part);
  Pair pair = pair_of(tree, shapes, a, b, parts);
  pair.part = part;
  if (auto* rim = std::get_if<Rim>(&pair.kind)) rim->lists_edges = n.crossings() > 0;
  if (auto* whole = std::get_if<Whole>(&pair.kind)) whole->skips_corners = n.corners() > 0;
  return pair;
}

std::string pair_name(const std::vector<PlacedShape>& shapes, const Pair& pair) {
  int a = std::min(pair.a, pair.b), b = std::max(pair.a, pair.b);
  if (goes_second(shapes[a].shape, shapes[b].shape)) std::swap(a, b);
  const Parts parts = parts_of(shapes, a, b, pair.part);
  const auto show = [&](int shape, const std::string& part) {
    return shapes[shape].name + (part.empty() ? "" : "[" + part + "]");
  };
  return show(a, parts.a.name) + " ~ " + show(b, parts.b.name);
}

Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB) {
  return part_gap(pair, X_WA, X_WB, Vec3::Zero());
}

Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3& motion_W) {
  return std::visit([&](const auto& kind) { return gap_of(kind, pair, X_WA, X_WB, motion_W); },
                    pair.kind);
}

bool is_silent(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  return std::visit([&](const auto& kind) { return silent(kind, pair, X_WA, X_WB, gap); },
                    pair.kind);
}

bool may_be_silent(const Pair& pair) {
  if (const auto* corner = std::get_if<Corner>(&pair.kind)) return !corner->out.isZero(0);
  const auto* whole = std::get_if<Whole>(&pair.kind);
  return whole == nullptr || whole->skips_corners;
}

}  // namespace saltus
