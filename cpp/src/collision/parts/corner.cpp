// A corner in the touch of a solid with faces, or inside: the nearest of those faces along whose
// normal its own body is beyond the corner. Another face cannot have stopped it: the corners of
// cubes that are stacked edge on edge lie on the upright faces too, and would slide down there.
//
// Of several faces that a corner touches while it moves, the one that it leaves fastest bears it:
// what parts from one face of a convex solid does not meet the solid.
#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/gap/sphere_gap.hpp"
#include "collision/parts/kinds.hpp"

namespace saltus {
namespace {

constexpr double flush = 1e-9;  // of the solid's size: as good as on the face, not beside it
constexpr double deep = 0.01;   // of the solid's size

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

}  // namespace

Parts corner_parts(const Shape& a, const Shape& b, int k) {
  const PartOfShape part = corner(a, k);
  return {part, all_of(b), Corner{part.out}};
}

bool goes_below(const Pair& pair, const Vec3& n_A) {
  const auto below = [&](const Vec3& edge) { return n_A.dot(edge) < -tilt; };
  return std::any_of(pair.inward.begin(), pair.inward.end(), below);
}

Gap gap_of(const Corner&, const Pair& pair, const Pose& X_WA, const Pose& X_WB,
           const Vec3& motion_W) {
  const auto anywhere = [&] { return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB); };
  if (pair.inward.empty()) return anywhere();
  return std::visit(
      [&]<class S>(const S& solid) {
        if constexpr (HasFaces<S>) {
          return corner_on(pair, solid, X_WA, X_WB, X_WB.R.transpose() * motion_W);
        } else {
          return anywhere();
        }
      },
      pair.on_b.shape);
}

/// One of the points on the rims of a cylinder that does not stand, or nearly: its rim bears it
/// then, wherever it rolls.
bool silent(const Corner& corner, const Pair&, const Pose& X_WA, const Pose&, const Gap& gap) {
  return !corner.out.isZero(0) && -gap.n_W.dot(X_WA.R * corner.out) < cosine_flat;
}

}  // namespace saltus
