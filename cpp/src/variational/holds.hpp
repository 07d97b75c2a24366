// Complementarity of sustained contacts over an arc: which of the pairs that rest at its start it
// holds closed, 0 <= lambda_i and 0 <= phi_i(q + tau v), one of them 0 (theory, section 6).
//
// A sharp corner on a face is held in the plane of that face, within its border and beyond; so is
// the end of a rod that slides lengthwise over a border. What bears there at the arc's end is
// another pair (edges that cross, a second table), and that rests from the next node on; see
// arrival.hpp.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

/// Holds what the last arc held, if it rests. @return false: no room
bool start_holds(const ModelData& model, Node& node, Flight& flight);

enum class Holds { unchanged, changed, too_many };

/// Of the arc just solved: pressed pairs are held, held pairs that would have to be pulled are
/// released. Each pair may change its mind twice.
Holds update_holds(const ModelData& model, Node& node, Flight& flight);

/// For an arc without a solution: one that holds the round end of a rod on two flush tables can
/// follow neither round its border. All ends are held in the planes of their faces from now on.
/// @return false if they are already
bool level_held_ends(const ModelData& model, Node& node, Flight& flight);

/// The gap below which a pair that rests at the node is pressed: it may not sink any further.
double floor_of(const Node& node, int pair);

}  // namespace saltus
