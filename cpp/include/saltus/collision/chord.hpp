// Certified advance along a chord q(s) = q (+) s dq, s in [0, 1], dq (n_v): no root of a gap is
// stepped over.
//
// Theory, section 4, in the sharper form that convexity allows (derived in chord.cpp): with x the
// points of a's core seen from b, mu >= |phi'|, B >= |x''|, C >= |x'''| from the reaches of the
// joints between a and b, and n as it is at s, the gap at s + d is at least
//
//   phi - mu d,    phi + min_x (n.(x + x' d)) - n.P - B d^2/2,
//   phi + min_x (n.(x + x' d + x'' d^2/2)) - n.P - C d^3/6
//
// The curvature of the shapes does not enter: the distance from a convex solid is convex.
#pragma once

#include "saltus/collision/contact.hpp"

namespace saltus {

struct ChordHit {
  enum class Outcome { clear, hit, not_converged };
  Outcome outcome = Outcome::clear;
  double s = 1;  ///< where phi first falls to `floor` (hit), or how far it is certified clear
};

/// Bound mu on how much the pair's gap can change along the whole chord [m]. Infinite where b is
/// a half-space that moves.
SALTUS_EXPORT double gap_change_bound(const Tree& tree, const Pair& pair, const VecRef& q,
                                      const VecRef& dq);

/// First s >= 0 with phi(q (+) s dq) <= floor, looking from s = 0 where phi >= floor or, for a pair
/// that touches or overlaps there, from its departure on: a pair with phi <= floor and phi' > 0 is
/// not a hit at s = 0, one with phi' <= 0 is ("=" in both: up to rounding). An s that is hit is
/// never late, and early by less than phi's rounding. Edges of solids (PairKind::crossing) have no
/// inside: theirs is found where they meet, whatever floor below 0. Allocates nothing.
///
/// Bounded: two bodies that swing together nearer to the floor than about 1e-8 of the third power
/// of their motion are not_converged, clear up to s.
SALTUS_EXPORT ChordHit first_hit_on_chord(const Tree& tree, const Pair& pair, const VecRef& q,
                                          const VecRef& dq, double floor);

}  // namespace saltus
