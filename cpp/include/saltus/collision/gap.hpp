// The gap between two shapes: signed distance, normal, witness points and curvature.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// Where the witness of a shape can move, to second order: the feature of the shape's core (the
/// point or segment that a round shape is swept about, the whole of another) that is nearest.
struct Patch {
  int dim = 0;  ///< 0 a point (corner, centre, end), 1 a curve (edge, axis, rim), 2 a surface
  Vec3 t0 = Vec3::Zero();  ///< the first `dim` valid: unit tangents, orthogonal, across n; in the
  Vec3 t1 = Vec3::Zero();  ///< world
  double k00 = 0;          ///< [1/m] n.x_00, n.x_01, n.x_11 of the core x along t0 and t1:
  double k01 = 0;          ///< not below 0 on a, not above 0 on b (both are convex)
  double k11 = 0;
};

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
  Patch a, b;     ///< the features; never of one direction that both are straight along
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
