// What touches where another part of the two bodies bears it, and comes deeper on the arc.
//
// The gap of a rim that an edge, a corner or its cap bears is that of the other part, to rounding,
// and it is silent. So is an edge next to a corner that touches: its line goes through the corner.
// A chord search from a gap of 0 finds both to close in no time, arc after arc. They are hits where
// they come deeper than what touches: there the nearest point is another one, that no part holds.
// Edges far in each other face each other no more; so of these the two bodies as wholes are asked.
#pragma once

#include "variational/flight/impact_time.hpp"

namespace saltus {

/// True where the pair is a rim that touches at the node, and another part has the contact.
bool is_borne(int slot, const Node& node);

/// The hit of a rim that is borne, on the arc just solved, flight.dq its chord; none where it comes
/// no deeper, at the arc's end and in between.
std::optional<Hit> sinking_hit(const Scene& scene, int slot, const Node& node, Flight& flight);

/// Adds to flight.hits bodies that are deeper in each other at the arc's end than at the node,
/// where edges were near that did not face each other.
void find_sinking_bodies(const Scene& scene, const Node& node, Flight& flight);

/// Of two solids where the pair is one of their parts.
const Pair& whole_of(const Node& node, int slot);

/// Shortens flight.work.arc to where it has sunk by half of what touches.
ImpactTime find_sinking_time(const Scene& scene, const Hit& hit, const Node& node, Flight& flight);

}  // namespace saltus
