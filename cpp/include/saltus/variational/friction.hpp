// Contacts with Coulomb friction at one instant: collisions one after another, or all at rest.
//
// Each contact has three rates u = (u_n, u_t): the gap rate n.v and the relative velocity T v of
// the two material points along two unit tangents. A normal impulse lambda and a friction impulse
// beta, p = (lambda, beta) with |beta| <= mu lambda, change the rates of all contacts by
// W = [N; T] M^-1 [N; T]^T.
//
//   collide  while a contact approaches, one contact collides: compression and expansion, friction
//            by maximal dissipation in each (coulomb.hpp). With mu = 0 this is the cascade. If all
//            e = 0 the contacts settle instead.
//   settle   all at once, e = 0:  0 <= lambda_i  _|_  u_n,i >= 0,  and beta_i dissipates most
//
// Restitution is Poisson's: the normal impulse of the expansion is e times that of the compression.
// If normal and tangential motion are not coupled (spheres, discs) this is Newton's u+ = -e u-; if
// they are, Newton's could gain energy. The outcome for several contacts is a convention, as it is
// without friction (cascade.hpp): one after another in the order asked for, or with `symmetric` all
// that approach at once.
#pragma once

#include <array>
#include <vector>

#include "saltus/variational/cascade.hpp"

namespace saltus {

/// W in blocks of 3 x 3: for each contact the rates that an impulse there changes, without zeros.
struct ContactBlocks {
  std::vector<int> start;           ///< (m + 1) where a contact begins
  std::vector<int> contact;         ///< of each entry: the contact whose rates change
  std::vector<Mat3> block;          ///< likewise: the change of its rates by a unit impulse
  std::vector<Mat3> own;            ///< (m) W_ii, symmetric
  std::vector<double> friction;     ///< (m) mu >= 0
  std::vector<double> restitution;  ///< (m) e in [0, 1]
  std::vector<double> rest;         ///< (m) epsilon_u >= 0
  /// (m) [N s] where it is above 0: no contact but a joint with dry friction, of one rate and an
  /// impulse of at most this, either way. Empty: contacts alone.
  std::vector<double> bound = {};

  /// The coordinates of a body (tree) that a contact is on, numbered in a row.
  struct Body {
    int first = 0;  ///< number of the first
    int count = 0;  ///< none where it is 0
  };
  /// What W of a contact is made of.
  struct Factors {
    std::array<Body, 2> body;  ///< the one or two that it is on
    std::size_t begin = 0;     ///< of its 3 rows of body[0].count + body[1].count numbers each
  };
  /// (m) W_ij = rates_i . responses_j^T. Empty where that is not known; then `block` alone says
  /// what W is.
  std::vector<Factors> factors = {};
  std::vector<double> rates = {};      ///< du/dv, of all contacts
  std::vector<double> responses = {};  ///< dv/dp, likewise
  int coordinates = 0;                 ///< numbers of all are below

  /// [N s] of an entry that is a joint with dry friction; 0 of a contact.
  double bound_of(int i) const { return bound.empty() ? 0 : bound[static_cast<std::size_t>(i)]; }
  /// m
  int size() const { return static_cast<int>(own.size()); }
};

/// One collision with friction.
struct FrictionImpulse {
  int contact;  ///< its number
  Vec3 p;       ///< [N s] lambda, beta
};

/// One collision after another, see above.
/// @param W of all contacts; @param options order and bound; @param scratch is resized
/// @param u (m) rates, in and out; @param impulses appended, in order
/// @return false if contacts still approach after max_impulses impulses
SALTUS_EXPORT bool collide(const ContactBlocks& W, const CascadeOptions& options,
                           std::vector<Vec3>& u, std::vector<Vec3>& scratch,
                           std::vector<FrictionImpulse>& impulses);

/// Block Gauss-Seidel (NSGS: Jourdan, Alart & Jean 1998) until the impulses change by rounding
/// only.
/// @param W of all contacts; @param most_sweeps more are not made
/// @param u (m) rates after `p`, in and out; @param p (m) guess in, solution out
/// @return number of sweeps; most_sweeps if the impulses still change
SALTUS_EXPORT int settle(const ContactBlocks& W, int most_sweeps, std::vector<Vec3>& u,
                         std::vector<Vec3>& p);

/// What an impact with friction does.
struct FrictionOutcome {
  VecX v;                                 ///< (n) velocity after
  std::vector<FrictionImpulse> impulses;  ///< in order
};

/// `resolve_impact` with friction.
/// @param M (n, n) positive definite; @param N (m, n) rows phi_q; @param v (n) velocity before
/// @param T (2m, n) two rows a contact: the velocity of the points that touch, in two orthogonal
/// unit tangents (one of them 0 for planar motion)
/// @param restitution (m) e in [0, 1]
/// @param friction (m) mu >= 0
/// @param options order and bound
/// @throws as resolve_impact
SALTUS_EXPORT FrictionOutcome resolve_impact(const Eigen::Ref<const MatX>& M,
                                             const Eigen::Ref<const MatX>& N,
                                             const Eigen::Ref<const MatX>& T, const VecRef& v,
                                             const VecRef& restitution, const VecRef& friction,
                                             const CascadeOptions& options = {});

}  // namespace saltus
