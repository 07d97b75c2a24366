// A rim in the touch of a solid with faces: which face bears it, as of corners (corner.cpp): those
// of cans that lie side by side, end by end, are on each other's caps too. The lowest point of a
// rim over a flat face is in closed form, as over a half-space.
#include <cmath>
#include <limits>
#include <type_traits>

#include "collision/gap/sphere_gap.hpp"
#include "collision/parts/kinds.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {
namespace {

constexpr double flush = 1e-9;          // of the solid's size: as good as on the face
constexpr double upright_sine = 1e-10;  // [rad]

/// The point of a disc that is lowest along n_A; its middle where the disc is level.
Vec3 lowest_of_disc(double radius, const Vec3& n_A) {
  const double rho = std::hypot(n_A.x(), n_A.y());
  if (rho < flush) return Vec3::Zero();
  return {-radius * n_A.x() / rho, -radius * n_A.y() / rho, 0};
}

/// Along n of any face the rim is no farther than the gap, and as far where it is over the face: so
/// that face is the highest of those that can have stopped it.
template <class Solid>
Gap rim_on(const Pair& pair, const Solid& solid, const Pose& X_WA, const Pose& X_WB) {
  const double radius = std::get<Cylinder>(pair.on_a.shape).radius;
  const Pose X_BA{X_WB.R.transpose() * X_WA.R, in_frame(X_WB, X_WA.p)};
  const int faces = parts_of(solid).faces;
  SeenFace best{-std::numeric_limits<double>::infinity(), Vec3::Zero()};
  Vec3 lowest = Vec3::Zero();
  for (int k = 0; k < faces; ++k) {
    const Vec3 n_A = X_BA.R.transpose() * face_of(solid, X_BA.p, k).n;
    const Vec3 c = X_BA * lowest_of_disc(radius, n_A);
    const SeenFace seen = face_of(solid, c, k);
    if (seen.e <= best.e || goes_below(pair, n_A)) continue;
    best = seen;
    lowest = c;
  }
  bool over = std::isfinite(best.e);
  const double beside = flush * size_of(solid);
  for (int k = 0; k < faces && over; ++k) {
    const SeenFace seen = face_of(solid, lowest, k);
    over = seen.n == best.n || seen.e <= beside;
  }
  if (!over) return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
  const Pose X_BP{rotation_z_to(best.n), lowest - best.e * best.n};
  return gap(pair.on_a.shape, X_WA, HalfSpace{}, X_WB * X_BP);
}

/// In touch, a rim on the side of a cylinder may be beside its end: the side alone tells n.
Gap rim_on_cylinder(const Rim& rim, const Pair& pair, const Cylinder& b, const Pose& X_WA,
                    const Pose& X_WB) {
  const Gap g = gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
  const double beside = flush * size_of(b);
  if (g.phi > beside) return g;
  const double longer = b.half_length + 4 * (b.radius + bounding_radius(pair.on_a.shape));
  const Gap side = gap(pair.on_a.shape, X_WA, Cylinder{b.radius, longer}, X_WB);
  const double z = std::abs(X_WB.R.col(2).dot(side.p_WB - X_WB.p));
  if (side.phi < g.phi - beside || z > b.half_length + beside) return g;
  const bool below = X_WA.R.transpose().lazyProduct(side.n_W).dot(-rim.out) < -tilt;
  return below ? g : side;
}

}  // namespace

Parts rim_parts(const Shape& a, const Shape& b, int k) {
  const PartOfShape part = rim(a, k);
  return {part, all_of(b), Rim{part.out}};
}

Gap gap_of(const Rim& rim, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&) {
  return std::visit(
      [&]<class S>(const S& solid) {
        if constexpr (std::is_same_v<S, Cylinder>) {
          return rim_on_cylinder(rim, pair, solid, X_WA, X_WB);
        } else if constexpr (HasFaces<S>) {
          return rim_on(pair, solid, X_WA, X_WB);
        } else {
          return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
        }
      },
      pair.on_b.shape);
}

/// Where its nearest point is not its to watch: a corner, an edge or a rim that crosses it flat. Of
/// a cylinder that stands on a face the four points bear it.
bool silent(const Rim& rim, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Gap& gap) {
  if (gap.a.dim != 1 || gap.b.dim == 0) return true;
  const Vec3 z = X_WA.R.col(2);
  const PartCounts b = part_counts(pair.on_b.shape);
  const bool upright = z.cross(gap.n_W).norm() < upright_sine;
  if (edge_capsule(pair.on_b.shape).radius > 0) {
    const bool on_side = b.rims > 0 && gap.b.dim == 2;
    if (on_side && std::abs(X_WB.R.col(2).dot(gap.n_W)) > 0.5) return upright;  // its cap
    return is_rim_crossed(rim, pair, b.rims > 0 && !on_side, X_WA, X_WB, gap);
  }
  if (gap.b.dim == 2) return upright;
  if (!rim.lists_edges) return true;
  const bool crosses = gap.a.t0.cross(gap.b.t0).norm() >= along_rim;
  return crosses && -gap.n_W.dot(z) * side(rim.out.z()) >= cosine_flat;
}

}  // namespace saltus
