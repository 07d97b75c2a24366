// Coulomb's law at all contacts of a pile together, by a proximal Newton method.
//
// With rates u = u_0 + W p (friction.hpp) the law is, at every contact and for every rho > 0,
//
//   p = P(p - rho u),   P(a) = (lambda, beta):  lambda = max(a_n, 0),  beta = a_t cut to mu lambda
//
// (P. Alart & A. Curnier, "A mixed formulation for frictional contact problems prone to Newton like
// solution methods", CMAME 92, 1991). Piles are redundant: W has no inverse, and p is not unique.
// So each round solves the same law with contacts that give way a little, by 1/rho, from p_k on:
//
//   p_k+1 = P(p_k - rho (u_0 + W p_k+1))      (the proximal point method, R. T. Rockafellar 1976)
//
// which has one solution where rho is small, and whose rounds end where the law holds exactly. With
// W = L K^T (L = K where W is symmetric) and z = K^T (p_k+1 - p_k) the unknowns are as few as the
// rates that do not follow from others:
//
//   F(z) = z - K^T (P(p_k - rho (u_k + L z)) - p_k) = 0,   F' = 1 + rho K^T P' L
//
// Near the law u_k of what sticks is as small as what is still missing, and so is the rounding of
// rho u_k: the last digits need no other method. F = 0 is solved by Newton's method with
// backtracking on |F|. The first rho is large: one round is enough where it is known who sticks and
// who slides. Then rho grows where Newton's method ends nearer to the law; where not, the round is
// taken back, and rho shrinks.
// Impulses and rates are scaled by sqrt(W_ii), so that light and heavy bodies count alike.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "saltus/variational/friction.hpp"

namespace saltus {

/// Room for all blocks of so many contacts, of so many rates each; 36 are those of two free bodies.
void reserve(ContactBlocks& W, std::size_t contacts, std::size_t numbers = 36);

/// Contacts are scaled so that W_ii = 1 at most.
inline double scale_of(const Mat3& own) { return 1 / std::sqrt(own.diagonal().maxCoeff()); }

/// No contacts.
void clear(ContactBlocks& W);

/// No entries; what contacts are stays.
void clear_blocks(ContactBlocks& W);

/// `block` alone says what W is from now on.
void forget_factors(ContactBlocks& W);

/// Room for settle_pile, which grows with the largest pile.
struct PileScratch {
  std::vector<int> island, order, place;  ///< (m) union-find; contacts by island; in its island
  // of one island with k contacts and r independent rates
  std::vector<double> scale, friction, rest, bound;  ///< (k)
  std::vector<int> first, last;  ///< (k) columns of L that the rows of a contact have
  struct Span {
    int first = 0, count = 0;
  };
  std::vector<std::array<Span, 2>> spans;  ///< (k) those of them that may be other than 0
  std::vector<int> pivot;                  ///< (r) the rate that a column of L was made for
  std::vector<double> W, L, K;             ///< (3 k, 3 k), (3 k, r), (3 k, r) by rows
  std::vector<double> H, DL;               ///< (r, r) F', (3, r)
  std::vector<int> ends;                   ///< (r) where the entries of a row of H end
  std::vector<int> reach;                  ///< (r) likewise, of rows as they are eliminated
  // bodies of one island, in an order in which neighbours are near
  std::vector<int> body_of, column;          ///< (coordinates) number of its body; (bodies) column
  std::vector<int> body_first, body_count;   ///< (bodies)
  std::vector<int> near_begin, near, queue;  ///< (bodies + 1), (2 k) contacts of each; (bodies)
  std::vector<Vec3> u, u_before, p, q, base, trial;  ///< (k) scaled rates and impulses
  std::vector<std::array<double, 2>> step;           ///< (k) by `sweep`
  std::vector<Vec3> u_best, p_best;                  ///< (k) nearest to the law so far
  std::vector<Vec3> u_first, p_first;                ///< (m) before sweeps
  std::vector<double> z, z_new, dz, F, F_new;        ///< (r)

  double work = 0;  ///< multiplications of all that was eliminated, and swept, since it was 0

  void reserve(std::size_t contacts);
};

/// Of `work` in a step, about: half a second. What a step goes on with then takes less.
inline constexpr double most_pile_work = 1e9;

/// How far from Coulomb's law: |p - P(p - u)|, as a part of the impulses and rates that there are.
struct Lawlessness {
  double residual = 0;
  double excess = 0;  ///< likewise, of what is more than W.rest of a contact
  double least() const { return std::min(residual, excess); }
};

struct Settled : Lawlessness {
  double worst = 0;    ///< |p - P(p - u)|, of scaled contacts
  int iterations = 0;  ///< Newton's, of all islands
};

/// |p - P(p - u)| of one contact, scaled, and of rates u that p has been added to.
double lawlessness_of(const ContactBlocks& W, int contact, const Vec3& u, const Vec3& p);

/// u += W p, p of one contact or of all
void add_rates(const ContactBlocks& W, int contact, const Vec3& p, std::vector<Vec3>& u);
void add_rates(const ContactBlocks& W, const std::vector<Vec3>& p, std::vector<Vec3>& u);

/// The contact that is farthest from the law, for messages.
int most_lawless(const ContactBlocks& W, const std::vector<Vec3>& u, const std::vector<Vec3>& p);

/// Of all contacts.
Lawlessness lawlessness(const ContactBlocks& W, const std::vector<Vec3>& u,
                        const std::vector<Vec3>& p);

/// @param W its rank is that of its symmetric part: impulses push where they are felt
/// @param u (m) rates with p in place, changed; @param p (m) guess in, solution out
/// @param part of its residual at the start that is small enough
/// @return what is left; has settled where excess <= small_residual
Settled settle_pile(const ContactBlocks& W, PileScratch& s, std::vector<Vec3>& u,
                    std::vector<Vec3>& p, double part = 0);

/// The same, and where Newton's method does not halve what there was, or with part = 0 does not
/// settle, Gauss-Seidel sweeps before it.
Settled settle_for_sure(const ContactBlocks& W, PileScratch& s, std::vector<Vec3>& u,
                        std::vector<Vec3>& p, double part = 0);

/// `collide` (friction.hpp) with room that stays.
bool collide(const ContactBlocks& W, const CascadeOptions& options, PileScratch& pile,
             std::vector<Vec3>& u, std::vector<Vec3>& scratch,
             std::vector<FrictionImpulse>& impulses);

/// Rounding of rates that impulses hold against each other is far below; so is what would be felt.
inline constexpr double small_residual = 1e-9;

/// More is an error. Between the two a step goes on, and reports it.
inline constexpr double large_residual = 1e-6;

}  // namespace saltus
