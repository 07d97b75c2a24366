// Complementarity of sustained contacts over an arc: which of the pairs that rest at its start it
// holds closed, 0 <= lambda_i and 0 <= phi_i(q + tau v), one of them 0 (theory, section 6).
//
// A sharp corner on a face is held in the plane of that face, within its border and beyond; so is
// the end of a rod that slides lengthwise over a border. What bears there at the arc's end is
// another pair (edges that cross, a second table), and that rests from the next node on; see
// arrival.hpp.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Holds what the last arc held, if it rests. @return false: no room
bool start_holds(const ModelData& model, Node& node, Flight& flight);

/// A hold of a resting pair, its gap to be brought to 0: the next constraint, not active yet, and
/// without n, which is as long as q.
ArcConstraint& prepare_hold(const ModelData& model, int pair, const Node& node, Flight& flight);

/// Holds a resting pair closed from now on. @return false: no room
bool hold(const ModelData& model, int pair, Node& node, Flight& flight);

/// Lets go of the pair of constraint i. The last constraint takes its place.
void release(int i, Node& node, Flight& flight);

enum class Holds { unchanged, changed, too_many };

/// Of the arc just solved: pressed pairs are held, held pairs that would have to be pulled are
/// released. Each pair may change its mind twice.
Holds update_holds(const ModelData& model, Node& node, Flight& flight);

/// The round end of a rod goes round the border of a face, if the rod lies along the border. One
/// that lies across it is borne by the border behind its end, which stays level: where the rod as a
/// whole sinks, though its ends do not, they are held in the plane of the face from now on.
/// @return true where one is that was not. A part of update_holds.
bool level_rods(const ModelData& model, Node& node, Flight& flight);

/// For an arc without a solution: one that holds the round end of a rod on two flush tables can
/// follow neither round its border. All ends are held in the planes of their faces from now on.
/// @return false if they are already
bool level_held_ends(const ModelData& model, Node& node, Flight& flight);

/// The gap below which a pair that rests at the node is pressed: it may not sink any further.
double floor_of(const Node& node, int pair);

}  // namespace saltus
