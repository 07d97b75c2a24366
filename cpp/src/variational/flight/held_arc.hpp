// The arc of a flight in which contacts are held closed.
//
// Theory, section 6. The impulses of the active rows act along B = [N; T] at the arc's start, and
// the rates that they meet Signorini's and Coulomb's law with are those of the gaps by the arc's
// end, and of the sliding in it (rows.hpp). The closing half kick at its end is finish.hpp: the
// same law for M^-1 p there.
//
// Newton's method has the law in it: each linearised arc is a problem for settle_pile (pile.hpp),
// that says who is pressed, sticks and slides.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Of the arc's equation in a held arc: quadratically less as a rule.
inline constexpr double most_residual = 1e-12;

/// Newton's method on the arc of duration tau from the node with the active rows, from
/// flight.arc.v and their impulses; where that leads nowhere from the node's v and none.
/// @return false where the law is not met in a bounded number of rounds, by flight.closing
bool solve_held_arc(const ModelData& model, const StepOptions& options, double tau,
                    const Node& node, Flight& flight);

}  // namespace saltus
