// Impulses at one instant: while some contact approaches, reflect on one that does.
//
// Paper, section III-D and (4), (5); theory, section 6. In contact space, with rows n_i = phi_q of
// the contacts, u = N v and G = N M^-1 N^T:
//
//   lambda_i = -(1 + e_i) u_i / G_ii,   u += G(:, i) lambda_i     until all u >= -epsilon
//
// Ends after finitely many impulses if all e = 1 and the cone {v: N v >= 0} has an interior. If all
// e = 0, whatever the order, v+ is the nearest velocity in the cone: p+ = p- + N^T lambda with
// 0 <= lambda, N v+ >= 0 and one of both 0 at each contact.
#pragma once

#include <vector>

#include "saltus/error.hpp"
#include "saltus/spatial/spatial.hpp"
#include "saltus/variational/report.hpp"

namespace saltus {

/// Which of the approaching contacts is next. Outside of what classify_impact() certifies the
/// outcome depends on this, and each order is a convention.
enum class ImpactOrder {
  fastest,  ///< the most negative u_i / sqrt(G_ii); ties go to the lowest index
  index,    ///< the lowest index
  /// all of them, together: reflected in the face of their cone that is nearest, until none
  /// approaches (generalized reflections). Keeps mirror symmetry.
  symmetric,
};

struct CascadeOptions {
  ImpactOrder order = ImpactOrder::fastest;
  int max_impulses = 100000;
};

/// G = N M^-1 N^T by rows, without the zeros: contacts on different bodies do not feel each other.
struct ContactMatrix {
  std::vector<int> start;        ///< (m + 1) where a row begins
  std::vector<int> column;       ///< of each entry
  std::vector<double> value;     ///< likewise
  std::vector<double> diagonal;  ///< (m)

  int size() const { return static_cast<int>(diagonal.size()); }
};

/// Who is next, kept up to date by a tournament: O(log m) where a rate changes.
struct CascadeScratch {
  std::vector<double> key;  ///< (m) below 0 where a contact approaches
  std::vector<int> winner;  ///< (2 leaves) of each match; winner[1] of all
};

/// Contact-space cascade in place: O(entries of a row) an impulse, and without allocation for the
/// orders fastest and index unless all e are 0.
/// @param u (m) gap rates, changed: after its impulse a contact has exactly -e u
/// @param rest (m) epsilon_u >= 0; @param restitution (m) e in [0, 1] of each contact
/// @param impulses appended: (index of contact, lambda) in order
/// @return false when max_impulses did not suffice.
/// @throws StepError when a projection (symmetric, or e = 0) is not met to 1e-10.
SALTUS_EXPORT bool cascade(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
                           const VecRef& restitution, const CascadeOptions& options,
                           CascadeScratch& scratch, std::vector<Impulse>& impulses);

/// The same from a dense G (m, m).
SALTUS_EXPORT bool cascade(const Eigen::Ref<const MatX>& G, Eigen::Ref<VecX> u, const VecRef& rest,
                           const VecRef& restitution, const CascadeOptions& options,
                           std::vector<Impulse>& impulses);

struct ImpactOutcome {
  VecX v;                         ///< (n) velocity after
  std::vector<Impulse> impulses;  ///< `pair` is the row of N
};

/// The continuous-time problem of the paper's section II, for any mass matrix and normals.
/// @param M (n, n) positive definite; @param N (m, n) rows phi_q; @param v (n) velocity before
/// @param restitution (m) e in [0, 1] of each contact
/// @throws ModelError on shapes that do not fit, values that are not finite, M not positive
///         definite, e outside [0, 1]; JammedError when the cascade does not end.
SALTUS_EXPORT ImpactOutcome resolve_impact(const Eigen::Ref<const MatX>& M,
                                           const Eigen::Ref<const MatX>& N, const VecRef& v,
                                           const VecRef& restitution,
                                           const CascadeOptions& options = {});

/// The same e for all contacts.
SALTUS_EXPORT ImpactOutcome resolve_impact(const Eigen::Ref<const MatX>& M,
                                           const Eigen::Ref<const MatX>& N, const VecRef& v,
                                           double restitution = 1,
                                           const CascadeOptions& options = {});

}  // namespace saltus
