// All outcomes of an impact: every order of reflecting on one approaching contact at a time.
//
// The search is depth first and visits each velocity once. So the work grows with the number of
// velocities on the way (for contacts of a finite reflection group at most its order, for N balls
// in line N!) and not with the number of orders. If the impulses are certain to end (theory,
// section 6), the set is complete.
#pragma once

#include <vector>

#include "saltus/variational/cascade.hpp"

namespace saltus {

/// Bounds of the search.
struct OutcomesOptions {
  int max_outcomes = 1000;   ///< more raise a ModelError
  long max_states = 400000;  ///< velocities on the way, m numbers each; more raise a ModelError
  /// A gap rate below this fraction of |v|_M sqrt(G_ii) waits until no other contact approaches,
  /// and outcomes that differ by less than this fraction of |v|_M are the same.
  double tolerance = 1e-9;
};

/// All outcomes of one impact, and how far they are apart.
struct ImpactOutcomes {
  /// Each with one order that leads to it, that of lowest indices; the first is ImpactOrder::index.
  std::vector<ImpactOutcome> outcomes;
  double spread;           ///< [sqrt(J)] the largest |v_a - v_b|_M of two outcomes
  double relative_spread;  ///< of |v|_M, at most 2
  long states;             ///< velocities on the way, first and last ones included
};

/// @param M (n, n) positive definite; @param N (m, n) rows phi_q; @param v (n) velocity before
/// @param restitution (m) e in [0, 1] of each contact; all 0: one outcome, the projection
/// @throws ModelError as resolve_impact(), and if a bound of the options is exceeded;
///         JammedError if an order of impulses returns to a velocity it has passed, or if a bound
///         is exceeded and no velocity opens all gaps.
SALTUS_EXPORT ImpactOutcomes impact_outcomes(const Eigen::Ref<const MatX>& M,
                                             const Eigen::Ref<const MatX>& N, const VecRef& v,
                                             const VecRef& restitution,
                                             const OutcomesOptions& options = {});

/// The same e for all contacts.
SALTUS_EXPORT ImpactOutcomes impact_outcomes(const Eigen::Ref<const MatX>& M,
                                             const Eigen::Ref<const MatX>& N, const VecRef& v,
                                             double restitution = 1,
                                             const OutcomesOptions& options = {});

}  // namespace saltus
