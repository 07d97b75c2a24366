// Frictionless impact on several contacts: while a contact approaches, one that does takes an
// impulse.
//
// Paper, section III-D and (4), (5); theory, section 6. In contact space, with rows n_i = phi_q of
// the contacts, u = N v and G = N M^-1 N^T:
//
//   lambda_i = -(1 + e_i) u_i / G_ii,   u += G(:, i) lambda_i     until all u >= -epsilon
//
// The cascade of impulses is finite if all e = 1 and the cone {v: N v >= 0} has an interior.
#pragma once

#include <vector>

#include "saltus/error.hpp"
#include "saltus/spatial/spatial.hpp"
#include "saltus/variational/report.hpp"

namespace saltus {

/// Of one impact.
struct CascadeOptions {
  ImpactOrder order = ImpactOrder::fastest;  ///< which contact is next
  int max_impulses = 100000;                 ///< more are an error
};

/// G = N M^-1 N^T by rows, without zeros: contacts on different bodies do not affect each other.
struct ContactMatrix {
  std::vector<int> start;        ///< (m + 1) where a row begins
  std::vector<int> column;       ///< of each entry
  std::vector<double> value;     ///< likewise
  std::vector<double> diagonal;  ///< (m)

  /// m
  int size() const { return static_cast<int>(diagonal.size()); }
};

/// The next contact, kept up to date by a tournament tree: O(log m) for each rate that changes.
struct CascadeScratch {
  std::vector<double> key;  ///< (m) negative for a contact that approaches
  std::vector<int> winner;  ///< (2 leaves) of each match; winner[1] of all
};

/// Contact-space cascade in place: O(entries of a row) for each impulse.
/// @param G (m, m)
/// @param u (m) gap rates, in and out: after its impulse a contact has exactly -e u
/// @param rest (m) epsilon_u >= 0: a contact with u >= -epsilon_u does not approach
/// @param restitution (m) e in [0, 1] of each contact
/// @param impulses appended: (index of contact, lambda) in order
/// @param options order and bound; @param scratch is resized
/// @return false if contacts still approach after max_impulses impulses
SALTUS_EXPORT bool cascade(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
                           const VecRef& restitution, const CascadeOptions& options,
                           CascadeScratch& scratch, std::vector<Impulse>& impulses);

/// The same from a dense G (m, m).
SALTUS_EXPORT bool cascade(const Eigen::Ref<const MatX>& G, Eigen::Ref<VecX> u, const VecRef& rest,
                           const VecRef& restitution, const CascadeOptions& options,
                           std::vector<Impulse>& impulses);

/// What an impact does.
struct ImpactOutcome {
  VecX v;                         ///< (n) velocity after
  std::vector<Impulse> impulses;  ///< `pair` is the row of N
};

/// The continuous-time problem of the paper's section II, for any mass matrix and normals.
/// @param M (n, n) positive definite; @param N (m, n) rows phi_q; @param v (n) velocity before
/// @param restitution (m) e in [0, 1] of each contact
/// @param options order and bound
/// @throws ModelError on shapes that do not match, NaN or infinite values, M not positive definite,
///         e outside [0, 1]; JammedError if the cascade does not end within max_impulses.
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
