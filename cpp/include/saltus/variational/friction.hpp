// Contacts with Coulomb friction at one instant: collisions one after another, and rest together.
//
// Each contact has three rates u = (u_n, u_t): the gap rate n.v and the relative velocity T v of
// the two material points in two unit tangents. An impulse p = (lambda, beta) there, |beta| <=
// mu lambda, changes the rates of all by W = [N; T] M^-1 [N; T]^T.
//
//   collide  while some contact approaches, let one collide: compression and expansion, friction
//            by maximal dissipation in each (coulomb.hpp). With mu = 0 the plain cascade. If
//            all e = 0 they settle.
//   settle   all at once, e = 0:  0 <= lambda_i  _|_  u_n,i >= 0,  and beta_i dissipates most
//
// Restitution is Poisson's: it is the impulse of the expansion that is e times that of the
// compression. Where normal and tangential motion are not coupled (spheres, discs) this is Newton's
// u+ = -e u-; where they are, Newton's could gain energy. What several contacts at once do is a
// convention, as it is without friction (cascade.hpp): one after another, in the order asked for
// (`symmetric` is `fastest` here).
#pragma once

#include <vector>

#include "saltus/variational/cascade.hpp"

namespace saltus {

/// W by contacts: for each contact the rates that an impulse there changes, without zero blocks.
struct ContactBlocks {
  std::vector<int> start;           ///< (m + 1) where a contact begins
  std::vector<int> contact;         ///< of each entry: who feels it
  std::vector<Mat3> block;          ///< likewise: its rates by a unit impulse
  std::vector<Mat3> own;            ///< (m) W_ii, symmetric
  std::vector<double> friction;     ///< (m) mu >= 0
  std::vector<double> restitution;  ///< (m) e in [0, 1]
  std::vector<double> rest;         ///< (m) epsilon_u >= 0

  int size() const { return static_cast<int>(own.size()); }
};

/// One collision with friction.
struct FrictionImpulse {
  int contact;
  Vec3 p;  ///< [N s] lambda, beta
};

/// @param u (m) rates, changed; @param impulses appended, in order
/// @return false when max_impulses did not suffice
SALTUS_EXPORT bool collide(const ContactBlocks& W, const CascadeOptions& options,
                           std::vector<Vec3>& u, std::vector<Vec3>& scratch,
                           std::vector<FrictionImpulse>& impulses);

/// Block Gauss-Seidel (NSGS: Jourdan, Alart & Jean 1998) until the impulses change by rounding.
/// @param u (m) rates with `p` in place, changed; @param p (m) guess in, solution out
/// @return sweeps used; most_sweeps where the impulses still changed
SALTUS_EXPORT int settle(const ContactBlocks& W, int most_sweeps, std::vector<Vec3>& u,
                         std::vector<Vec3>& p);

struct FrictionOutcome {
  VecX v;  ///< (n) velocity after
  std::vector<FrictionImpulse> impulses;
};

/// `resolve_impact` with friction.
/// @param T (2m, n) two rows a contact: the velocity of the points that touch, in two orthogonal
/// unit tangents (one of them 0 for planar motion)
/// @param friction (m) mu >= 0
/// @throws as resolve_impact
SALTUS_EXPORT FrictionOutcome resolve_impact(const Eigen::Ref<const MatX>& M,
                                             const Eigen::Ref<const MatX>& N,
                                             const Eigen::Ref<const MatX>& T, const VecRef& v,
                                             const VecRef& restitution, const VecRef& friction,
                                             const CascadeOptions& options = {});

}  // namespace saltus
