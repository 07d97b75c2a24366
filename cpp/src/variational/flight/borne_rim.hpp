// A rim that touches where another part of the two bodies bears it: an edge or a rim that crosses
// it, a corner, its cap.
//
// Its gap is that of the other part, to rounding, as long as that has the contact, and it is
// silent. A chord search from a gap of 0 finds it to close in no time, arc after arc. It is a hit
// where it comes deeper than what touches: there its nearest point is another one, that no part
// holds.
#pragma once

#include "variational/flight/impact_time.hpp"

namespace saltus {

/// True where the pair is a rim that touches at the node, and another part has the contact.
bool is_borne(int slot, const Node& node);

/// The hit of a rim that is borne, on the arc just solved, flight.dq its chord; none where it comes
/// no deeper, at the arc's end and in between.
std::optional<Hit> sinking_hit(const Scene& scene, int slot, const Node& node, Flight& flight);

/// Shortens flight.work.arc to where it has sunk by half of what touches.
ImpactTime find_sinking_time(const Scene& scene, const Hit& hit, const Node& node, Flight& flight);

}  // namespace saltus
