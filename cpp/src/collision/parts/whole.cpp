#include "collision/parts/kinds.hpp"

namespace saltus {

Gap gap_of(const Whole&, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&) {
  return gap(pair.on_a.shape, X_WA, pair.on_b.shape, X_WB);
}

/// Where a corner is nearest, or a rim on a face.
bool silent(const Whole& whole, const Pair& pair, const Pose&, const Pose&, const Gap& gap) {
  if (!whole.skips_corners) return false;
  const auto is_part = [](const Shape& shape, const Patch& patch, const Patch& other) {
    const bool rims = part_counts(shape).rims > 0;
    return rims ? patch.dim == 1 && other.dim == 2 : patch.dim == 0;
  };
  return is_part(pair.on_a.shape, gap.a, gap.b) || is_part(pair.on_b.shape, gap.b, gap.a);
}

}  // namespace saltus
