// Whether the outcome of an impact on several contacts is unique, by their angles (theory, section
// 6).
//
// In the kinetic metric contacts are mirrors that meet at the wedge angles theta_ij,
//
//   cos theta_ij = -G_ij / sqrt(G_ii G_jj),   G = N M^-1 N^T
//
// Two contacts: unique for all v if and only if theta = pi/m; else at most ceil(pi/theta) impulses.
// Many: if every theta_ij = pi/m_ij and the diagram of the m_ij > 2 is one of a finite reflection
// group, every order leads to the same v+ by the same number of impulses, at most as many as the
// group has mirrors. J. Humphreys, Reflection Groups and Coxeter Groups, sections 1.8, 2.4, 2.11.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// What holds for all velocities v before the impact.
enum class ImpactKind {
  unique,           ///< v+ does not depend on the order of the impulses
  order_dependent,  ///< for some v it does: any single answer is a convention
  jammed,           ///< no velocity opens all gaps at once: impulses need not end
};

/// Whether the outcome of an impact is unique, and why.
struct ImpactCertificate {
  ImpactKind kind;  ///< what holds
  /// If unique, the groups of contacts that affect each other, larger ones first: "A3 x A1^2", or
  /// "plastic" if all e = 0; else empty.
  std::string type;
  std::optional<long> impulses;  ///< upper bound of their number; empty if none is known
  MatX angles;                   ///< (m, m) [rad] theta_ij, pi on the diagonal
  double interior;        ///< the largest d with N w >= d sqrt(diag G), |w|_M = 1; 0: there is none
  std::vector<int> same;  ///< (m) the first contact with the same normal, usually itself
};

/// "unique, A2, at most 3 impulses"
SALTUS_EXPORT std::string describe(const ImpactCertificate& certificate);

/// How exact angles are to be.
struct CertificateOptions {
  /// An angle counts as pi/m if m theta / pi is 1 to this; also the error of v that this causes.
  double tolerance = 1e-9;
};

/// @param M (n, n) positive definite; @param N (m, n) rows phi_q
/// @param restitution (m) e in [0, 1] of each contact. With e < 1 the outcome is unique only for
///        contacts that do not affect each other; with all e = 0 it always is.
/// @throws ModelError as resolve_impact(); also on a tolerance outside (0, 1e-3].
SALTUS_EXPORT ImpactCertificate classify_impact(const Eigen::Ref<const MatX>& M,
                                                const Eigen::Ref<const MatX>& N,
                                                const VecRef& restitution,
                                                const CertificateOptions& options = {});

/// The same e for all contacts.
SALTUS_EXPORT ImpactCertificate classify_impact(const Eigen::Ref<const MatX>& M,
                                                const Eigen::Ref<const MatX>& N,
                                                double restitution = 1,
                                                const CertificateOptions& options = {});

}  // namespace saltus
