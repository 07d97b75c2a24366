// Certified advance along a chord q(s) = q + s dq, s in [0, 1]: no root of a gap is stepped over.
//
// Theory, section 4. With rho_k the greatest distance from axis k to the surface it moves (1 for a
// prismatic joint) and R_k that to P, the centre of sphere a,
//
//   |phi'(s)|  <= mu = sum |dq_k| rho_k
//   |phi''(s)| <= B  = sum_{i<=l} (2 - delta_il) |dq_i||dq_l| R_l [i turns] + (sum |dq_k| R_k)^2 / r_min
//   advance by d = (phi' + sqrt(phi'^2 + 2 B phi)) / B
//
// r_min is the least radius of F's curvature while phi >= 0 (the sphere's own radius, plus b's).
#pragma once

#include "saltus/collision/contact.hpp"

namespace saltus {

struct ChordHit {
  enum class Outcome { clear, hit, not_converged };
  Outcome outcome = Outcome::clear;
  double s = 1;  ///< where phi first falls to `floor` (hit), or how far it is certified clear
};

/// Bound mu on how much the pair's gap can change along the whole chord [m].
SALTUS_EXPORT double gap_change_bound(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                      const Pair& pair, const VecRef& q, const VecRef& dq);

/// First s >= 0 with phi(q + s dq) <= floor, looking from s = 0 where phi >= floor or, for a pair
/// that touches there, from its departure on: a pair with |phi| about 0 and phi' > 0 is not a hit
/// at s = 0, one with phi' <= 0 is. Bounded; allocates nothing.
SALTUS_EXPORT ChordHit first_hit_on_chord(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                          const Pair& pair, const VecRef& q, const VecRef& dq,
                                          double floor);

}  // namespace saltus
