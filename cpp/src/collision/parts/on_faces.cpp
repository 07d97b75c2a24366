// A corner in the touch of a solid with faces, or inside: the nearest of those faces along whose
// normal its own body is beyond the corner. Another face cannot have stopped it: the corners of
// cubes that are stacked edge on edge lie on the upright faces too, and would slide down there. A
// rim likewise: those of cans that lie side by side, end by end, are on each other's caps too.
//
// Of several faces that a corner touches while it moves, the one that it leaves fastest bears it:
// what parts from one face of a convex solid does not meet the solid.
//
// The lowest point of a rim over a flat face is in closed form, as over a half-space.
#include "collision/parts/on_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/gap/sphere_gap.hpp"
#include "collision/shapes/facts.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {
namespace {

constexpr double flush = 1e-9;  // of the solid's size: as good as on the face, not beside it
constexpr double deep = 0.01;   // of the solid's size
constexpr double tilt = 1e-3;   // [rad] faces that are flat on each other may be apart

/// True where the body of a corner or rim goes on below a plane through it across n_A.
bool goes_below(const Pair& pair, const Vec3& n_A) {
  const auto below = [&](const Vec3& edge) { return n_A.dot(edge) < -tilt; };
  return std::any_of(pair.inward.begin(), pair.inward.end(), below);
}

/// `motion` is of the corner, in the solid's frame.
template <class Solid>
Gap corner_on(const Pair& pair, const Solid& solid, const Pose& X_WA, const Pose& X_WB,
              const Vec3& motion) {
  const Vec3 c = in_frame(X_WB, X_WA.p);
  const Mat3 R_BA = X_WB.R.transpose() * X_WA.R;
  const int faces = parts_of(solid).faces;
  const double beside = flush * size_of(solid);
  SeenFace best{-std::numeric_limits<double>::infinity(), Vec3::Zero()};
  double highest = best.e;
  const auto touches = [&](const SeenFace& seen) { return std::abs(seen.e) <= pair.touch; };
  const bool moves = !motion.isZero(0);
  for (int k = 0; k < faces; ++k) {
    const SeenFace seen = face_of(solid, c, k);
    highest = std::fmax(highest, seen.e);
    if (seen.e > beside) return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
    const bool better = moves && touches(seen) && touches(best)
                            ? seen.n.dot(motion) > best.n.dot(motion)
                            : seen.e > best.e;
    if (!better || goes_below(pair, R_BA.transpose() * seen.n)) continue;
    best = seen;
  }
  // a far side is not where it came in
  if (!(best.e > highest - deep * size_of(solid))) {
    return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
  }
  const bool round = best.bend != 0;
  const Vec3 t = round ? Vec3(-best.n.y(), best.n.x(), 0) : best.n.unitOrthogonal();
  const Patch patch{.dim = 2, .t0 = t, .t1 = best.n.cross(t), .k00 = best.bend};
  return sphere_gap(std::get<Sphere>(pair.on_a.shape), X_WA, X_WB, {best.e, best.n, patch});
}

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
Gap rim_on_cylinder(const Pair& pair, const Cylinder& b, const Pose& X_WA, const Pose& X_WB) {
  const Gap g = gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
  const double beside = flush * size_of(b);
  if (g.phi > beside) return g;
  const double longer = b.half_length + 4 * (b.radius + bounding_radius(pair.on_a.shape));
  const Gap side = gap(pair.on_a.shape, X_WA, Cylinder{b.radius, longer}, X_WB);
  const double z = std::abs(X_WB.R.col(2).dot(side.p_WB - X_WB.p));
  if (side.phi < g.phi - beside || z > b.half_length + beside) return g;
  const bool below = X_WA.R.transpose().lazyProduct(side.n_W).dot(-pair.out_a) < -tilt;
  return below ? g : side;
}

}  // namespace

Gap corner_on_faces(const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3& motion_W) {
  return std::visit(
      [&]<class S>(const S& solid) {
        if constexpr (HasFaces<S>) {
          return corner_on(pair, solid, X_WA, X_WB, X_WB.R.transpose() * motion_W);
        } else {
          return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
        }
      },
      pair.on_b.shape);
}

Gap rim_on_faces(const Pair& pair, const Pose& X_WA, const Pose& X_WB) {
  return std::visit(
      [&]<class S>(const S& solid) {
        if constexpr (std::is_same_v<S, Cylinder>) {
          return rim_on_cylinder(pair, solid, X_WA, X_WB);
        } else if constexpr (HasFaces<S>) {
          return rim_on(pair, solid, X_WA, X_WB);
        } else {
          return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
        }
      },
      pair.on_b.shape);
}

}  // namespace saltus
