// The arc of a flight where contacts rest in a model with friction.
//
// Theory, section 6, with Coulomb's law for the arc: the impulses of all that rests act along the
// rows [N; T] at the arc's start, and the rates that they meet the law with are the gaps' by the
// arc's end and T v in its middle. The closing half kick at its end is settle_with_friction: the
// same law for M^-1 p there.
//
// Newton's method has the law in it: each linearised arc is a problem for settle_pile (pile.hpp),
// that says who is pressed, sticks and slides. What is not pressed is let go.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Something rests, in a model with friction.
bool needs_friction_arc(const Node& node);

/// Room in the node and the flight for all that touches to be held.
void make_room(const ModelData& model, Node& node, Flight& flight);

/// Of the holds of a flight over `left`: what they did in the one before is the guess. Needs the
/// flight's number.
void recall_impulses(double left, Node& node, Flight& flight);

/// No guess: where that of before leads to no arc.
void forget_impulses(Flight& flight);

/// For the closing half kick, and the next flight's start.
void remember_impulses(Node& node, const Flight& flight);

/// solve_flight_arc where it is needed; what is pressed is held then.
/// @return false where the law is not met in a bounded number of rounds, by flight.closing
bool solve_friction_arc(const ModelData& model, const StepOptions& options, double tau, Node& node,
                        Flight& flight);

}  // namespace saltus
