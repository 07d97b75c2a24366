// Friction of the contacts that a flight holds closed.
//
// Theory, section 6, with Coulomb's law for the arc: each held contact sticks (two constraints
// more, T v = 0 at the arc's middle) or slides (its force is along n - mu T^T d, d = T v / |T v|).
// Rows of the forces are those at the arc's start, and the closing half kick at its end is
// settle_with_friction: the same law for M^-1 p there.
//
// An arc is solved with what the one before did. If that breaks the law, it is solved once more
// together with the law of all contacts that rest, by Newton's method: each linearised arc is a
// problem for settle_pile, over [N; T] J^-1 [N; T]^T. That says who is pressed, sticks and slides.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

enum class Grips { settled, not_settled };

/// Some contact that rests at the node has friction: then update_grips says what is held.
bool rests_with_friction(const Node& node);

/// Room in the node and the flight for all that touches to be held and to stick.
void make_room(const ModelData& model, Node& node, Flight& flight);

/// Starts the holds of a flight with what they did in the one before. Needs the flight's number.
void start_grips(double left, Node& node, Flight& flight);

/// Checks the arc just solved against Coulomb's law, and solves it anew if need be.
/// @return not_settled: the law is not met in a bounded number of rounds
Grips update_grips(const ModelData& model, const StepOptions& options, Node& node, Flight& flight);

/// Takes out what sticks, where none that rests has friction any more. @return true where any did
bool drop_sticks(Flight& flight);

/// Once a flight, where what was held before leads to no arc: solves a free one, from which
/// update_grips finds all anew.
bool restart(const ModelData& model, const StepOptions& options, double tau, Node& node,
             Flight& flight);

/// For the closing half kick, and the next flight's start.
void remember_grips(Node& node, const Flight& flight);

/// Contacts that the flight holds closed.
int count_holds(const Flight& flight);

}  // namespace saltus
