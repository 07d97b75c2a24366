// Where two features face each other.
#pragma once

#include "collision/shapes/features.hpp"

namespace saltus {

/// Two features, a direction and how good it is.
struct Meeting {
  Vec3 n;  ///< from b to a
  Feature a, b;
  double s = 0;     ///< [m] separation of the whole cores along n
  double d = 0;     ///< [m] n.(x - y), not below s but by rounding
  double past = 0;  ///< [m] by how much the witnesses are none: past an end, not along n
};

/// [rad] By how much n may turn where nothing is known of it.
inline constexpr double any_turn = 1.47;

/// Moves the witnesses of `a` and `b` to where x - y is along n and n across both features;
/// neither is a face. False where that is not found with n turned by less than `turn`.
bool meet(const Solid& A, const Solid& B, Feature& a, Feature& b, Vec3& n, double turn = any_turn);

/// The witness for n, the normal of a face of a or of b: where a flat lies on a flat, the corner of
/// what they share that is farthest from both solids' origins (the first such).
void lay_flat(const Solid& A, const Solid& B, bool of_a, double tolerance, Meeting& out);

}  // namespace saltus
