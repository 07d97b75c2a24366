// An arc of given duration from a node: of what is free, and of what contacts hold closed.
//
// Theory, section 6. The impulses of the active rows act along B = [N; T] at the arc's start, and
// the rates that they meet Signorini's and Coulomb's law with are those of the gaps by the arc's
// end, and of the sliding in it (rows.hpp). The closing half kick at its end is finish.hpp: the
// same law for M^-1 p there.
//
// Newton's method has the law in it: each linearised arc is a problem for settle_pile (pile.hpp),
// that says who is pressed, sticks and slides.
#pragma once

#include "variational/arc/rows.hpp"

namespace saltus {

/// An arc that is being sought: all that makes it up. Written by `solve` and the flight.
struct ArcWork {
  explicit ArcWork(const Scene& scene);

  Arc arc;
  Rows rows;
  LaunchLine line;
  ArcScratch scratch;
  int iterations = 0;     ///< Newton's, of all arcs tried
  double rough = 0;       ///< residual of an arc that is only looked at; 0 for one that is flown
  bool is_rough = false;  ///< `solve` has left it at that
  int unlawful = -1;      ///< slot of the pair that the law was least met by, where it was not
};

/// Of the arc's equation in an arc that rows hold: quadratically less as a rule.
inline constexpr double most_residual = 1e-12;

/// Enough to see what an arc does: two rounds of the law.
inline constexpr double rough_look = 1e-5;

/// The arc from the node with the launch, and with the impulses in rows.momentum if rows are
/// active.
ArcProblem arc_problem(const Scene& scene, double tau, const Node& node, ArcWork& work);

/// From arc.v and the impulses of the active rows; where those lead nowhere, from the node's v and
/// none.
/// @return false where it does not converge, or the law is not met in a bounded number of rounds
bool solve(const Scene& scene, double tau, const Node& node, ArcWork& work);

/// M^-1 p at the node as the guess of work.arc.v. Takes the factors of the arc.
/// @return false where the mass matrix is singular
bool guess_from_momenta(const Scene& scene, const Node& node, ArcWork& work);

}  // namespace saltus
