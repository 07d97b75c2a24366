#include "saltus/collision/parts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

PartOfShape all_of(const Shape& shape) { return {"", shape, {}, Vec3::Zero(), {}}; }

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

/// A face of a solid as a corner sees it.
struct SeenFace {
  double e;  ///< [m] height of the corner over it
  Vec3 n;    ///< in the solid's frame
};

SeenFace face(const Box& box, const Vec3& c, int k) {
  const Vec3 n = (k % 2 == 0 ? 1 : -1) * Vec3::Unit(k / 2);
  return {n.dot(c) - box.half[k / 2], n};
}

SeenFace face(const Convex& convex, const Vec3& c, int k) {
  const Hull::Face& f = convex.hull->faces[k];
  return {f.normal.dot(c) - f.offset, f.normal};
}

int face_count(const Box&) { return 6; }
int face_count(const Convex& convex) { return static_cast<int>(convex.hull->faces.size()); }

/// A corner in the touch of a solid with faces, or inside: the nearest of those faces along whose
/// normal its own body is beyond the corner. Another face cannot have stopped it: the corners of
/// cubes that are stacked edge on edge lie on the upright faces too, and would slide down there.
/// Of several that it touches and a motion (in the solid's frame) the one that it leaves fastest:
/// what parts from one face of a convex solid does not meet the solid.
template <class Solid>
Gap corner_on_faces(const Pair& pair, const Solid& solid, const Pose& X_WA, const Pose& X_WB,
                    const Vec3& motion) {
  constexpr double flush = 1e-9;  // of the solid's size: as good as on the face, not beside it
  constexpr double tilt = 1e-3;   // [rad] faces that are flat on each other may be apart
  const Vec3 c = in_frame(X_WB, X_WA.p);
  const Mat3 R_BA = X_WB.R.transpose() * X_WA.R;
  const double beside = flush * feature_size(solid);
  const bool moves = !motion.isZero(0);
  SeenFace best{-std::numeric_limits<double>::infinity(), Vec3::Zero()};
  for (int k = 0; k < face_count(solid); ++k) {
    const SeenFace seen = face(solid, c, k);
    if (seen.e > beside) return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
    const Vec3 n_A = R_BA.transpose() * seen.n;
    const auto goes_below = [&](const Vec3& edge) { return n_A.dot(edge) < -tilt; };
    const bool both_touch =
        moves && std::abs(seen.e) <= pair.touch && std::abs(best.e) <= pair.touch;
    const bool better = both_touch ? seen.n.dot(motion) > best.n.dot(motion) : seen.e > best.e;
    if (!better || std::any_of(pair.inward.begin(), pair.inward.end(), goes_below)) continue;
    best = seen;
  }
  if (!std::isfinite(best.e)) return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
  const Vec3 t = best.n.unitOrthogonal();
  const Patch flat{.dim = 2, .t0 = t, .t1 = best.n.cross(t)};
  return sphere_gap(std::get<Sphere>(pair.on_a.shape), X_WA, X_WB, {best.e, best.n, flat});
}

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
  pair.inward = parts.a.inward;
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
  return part_gap(pair, X_WA, X_WB, Vec3::Zero());
}

Gap part_gap(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3& motion_W) {
  if (pair.kind == PairKind::crossing) return crossing_gap(pair, X_WA, X_WB);
  if (!pair.inward.empty()) {
    const Vec3 motion = X_WB.R.transpose() * motion_W;
    const Shape& solid = pair.on_b.shape;
    if (const auto* box = std::get_if<Box>(&solid)) {
      return corner_on_faces(pair, *box, X_WA, X_WB, motion);
    }
    if (const auto* convex = std::get_if<Convex>(&solid)) {
      return corner_on_faces(pair, *convex, X_WA, X_WB, motion);
    }
  }
  return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
}

bool is_silent(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  if (pair.kind == PairKind::crossing) return !is_crossing(pair, X_WA, X_WB, gap);
  if (!pair.skips_corners) return false;
  if (is<HalfSpace>(pair.on_b.shape)) {  // the rim of a cylinder that stands
    constexpr double upright = 1e-10;
    return X_WA.R.col(2).cross(gap.n_W).norm() < upright;
  }
  const auto on_corner = [](const Shape& shape, const Patch& patch) {
    return patch.dim == 0 && !is<Cylinder>(shape);
  };
  return on_corner(pair.on_a.shape, gap.a) || on_corner(pair.on_b.shape, gap.b);
}

}  // namespace saltus
