// The gap between two shapes: signed distance, normal, witness points and curvature.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// Invariants: p_WA - p_WB = phi n_W, |n_W| = 1, n from b to a; phi < 0 is penetration.
/// Exchanging the shapes exchanges the witnesses and turns n round, and changes nothing else.
struct Gap {
  double phi;     ///< [m]
  Vec3 n_W;       ///< unit normal from b to a
  Vec3 p_WA;      ///< [m] witness on a's surface
  Vec3 p_WB;      ///< [m] witness on b's surface
  Vec3 center_W;  ///< [m] P of theory section 7: the centre of sphere a, on the contact line
  Mat3 F_W;       ///< [1/m] d2 phi for translations of a against b: the curvature by feature
};

/// True where `gap` knows the pair (in either order).
SALTUS_EXPORT bool has_gap(const Shape& a, const Shape& b);

/// Needs has_gap(a, b). Where a is no sphere but b is, P is the centre of b.
SALTUS_EXPORT Gap gap(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

/// The table of pairs that have a gap, as (name, name), for people; generated from the dispatch.
SALTUS_EXPORT std::vector<std::pair<std::string, std::string>> gap_table();

}  // namespace saltus
