// The gaps that close on the chord of an arc.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Writes flight.dq, the chord, and flight.hits of all pairs watched. The pool may grow.
void find_hits(const Scene& scene, const Node& node, Flight& flight);

/// Takes the one away that is first on the chord.
std::optional<Hit> take_first(std::vector<Hit>& hits);

/// An end of a rod whose axis is held on an edge, where the edge comes to that end: the two touch
/// in the same point, and that of the end only grazes.
bool grazes_with_axis(const Scene& scene, int end, const Node& node, ArcWork& work);

/// An axis of a round shape whose line meets another's beyond an end at the arc's end: on the chord
/// the ends are round, and it is their own part that meets the other.
bool meets_beyond_ends(const Scene& scene, int slot, const Node& node, ArcWork& work);

/// A rim whose gap closes at the arc's end where other parts of the two bodies touch from the node
/// on: within its cap, which a corner or a rim of the other is on; or on an edge or a rim, in one
/// of the two places that its lowest point goes between. Where the other of these is not watched,
/// as before the two are level, the rim says when it closes.
bool is_of_other_parts(const Scene& scene, int rim, const Node& node, ArcWork& work);

}  // namespace saltus
