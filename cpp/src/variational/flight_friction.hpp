// Friction of the contacts that a flight holds closed.
//
// Theory, section 6, with Coulomb's law for the arc: each held contact sticks (two constraints
// more, T v = 0 at the arc's middle) or slides (its force is along n - mu T^T d, d = T v / |T v|).
// Rows of the forces are those at the arc's start, and the closing half kick at its end is
// settle_with_friction: the same law for M^-1 p there.
//
// An arc is solved with what the one before did. If that breaks Coulomb's law, the law is solved
// for the arc linearised at hand (`settle`, over W = C J^-1 [N; T]^T), which says who sticks and
// who slides, and the arc is solved again with that, until the law holds.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

enum class Grips { unchanged, changed, too_many, not_settled };

/// Starts the holds of a flight with what they did in the one before. Needs the flight's number.
/// @return false where there are too many constraints
bool start_grips(double left, Node& node, Flight& flight);

/// Checks the arc just solved against Coulomb's law, and changes who sticks and slides if need be.
/// @param changed the holds are not those of the last call
/// @return not_settled: the law is not met in the bounded number of rounds by flight.closing
Grips update_grips(const ModelData& model, const StepOptions& options, bool changed, Node& node,
                   Flight& flight);

/// For the closing half kick, and the next flight's start.
void remember_grips(Node& node, const Flight& flight);

/// Contacts that the flight holds closed.
int count_holds(const Flight& flight);

}  // namespace saltus
