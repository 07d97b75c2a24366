// The gap between two shapes: signed distance, normal, witness points and curvature.
#pragma once

#include <string>
#include <vector>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// Invariants: p_WA - p_WB = phi n_W, |n_W| = 1, n from b to a; phi < 0 is penetration.
/// Exchanging the shapes exchanges witnesses and patches and turns n round, and changes nothing
/// else.
struct Gap {
  double phi;     ///< [m]
  Vec3 n_W;       ///< unit normal from b to a
  Vec3 p_WA;      ///< [m] witness on a's surface
  Vec3 p_WB;      ///< [m] witness on b's surface
  Vec3 center_W;  ///< [m] P of theory section 7: the point of a's core, p_WA + n times its radius
  double d;       ///< [m] phi and both radii: from core to core along n, below 0 where they overlap
  Patch a;        ///< the feature of a; never of one direction that both are straight along
  Patch b;        ///< the feature of b
};

/// Second partials of phi for motions t = [w; u] of a against b, u the velocity of P, to which the
/// turning of u itself is added: for joints i, l of the chain from b to a, i at or nearer to b,
///
///   phi_qq[i,l] = t_i^T C t_l + n.(w_i x u_l)
///
/// Theory, section 7, by feature; derived in curvature.cpp. 0 in directions where it is infinite.
SALTUS_EXPORT Mat6 curvature(const Gap& gap);

/// [1/m] The part for translations alone, (3, 3): F_s of theory section 7.
SALTUS_EXPORT Mat3 F_W(const Gap& gap);

/// True where `gap` knows the pair (in either order).
SALTUS_EXPORT bool has_gap(const Shape& a, const Shape& b);

/// The signed distance: the greatest separation along any direction, and where it is below 0 the
/// least way that takes the shapes apart. Needs has_gap(a, b).
///
/// Where many points are as near (a face on a face or an edge, parallel edges or axes), the
/// witnesses are one extreme place of those: a corner or an end over the other shape, or where two
/// edges cross. Which one is the same for the same input, and told in each pair's header.
SALTUS_EXPORT Gap gap(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

/// The table of pairs that have a gap, as (name, name), for people; generated from the dispatch.
SALTUS_EXPORT std::vector<std::pair<std::string, std::string>> gap_table();

}  // namespace saltus
