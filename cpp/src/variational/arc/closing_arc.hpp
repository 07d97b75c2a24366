// The arc that ends where a gap closes: velocity and duration in one Newton iteration.
//
// Paper, (11a), (11b); theory, section 4. Unknowns v and tau, equations
//
//   F = p_start(q, v, tau) - p = 0      g = phi(q (+) tau v) = 0
//
// The Schur complement of J = dF/dv leaves one number:
//
//   dv_0 = -J^-1 F,  v' = -J^-1 dF/dtau
//   dtau = -(g + tau n.dv_0) / (n.(v + tau v')),  dv = dv_0 + dtau v'
//
// n is K^T phi_q, the derivative by v over tau: balls turn the end (K: packed_matrix.hpp).
#pragma once

#include "variational/arc/arc.hpp"

namespace saltus {

/// Where the gap is at the end of an arc.
struct ClosingGap {
  const Pair& pair;
  double longest;  ///< [s] the arc may not be longer
  VecX& n;         ///< (n_v) scratch: K^T phi_q there
  VecX& rate;      ///< (n_q) written: v'
};

/// Newton from arc.v and problem.tau of an arc that nothing holds and without a launch.
/// @return false where it leaves (0, longest], does not converge in a few iterations, or the gap
/// does not close: the guarded search of impact_time.cpp takes over from the old guess.
bool solve_closing_arc(const ModelData& model, const ArcProblem& problem, const ClosingGap& gap,
                       Arc& arc, ArcScratch& s);

}  // namespace saltus
