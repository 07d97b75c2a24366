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

/// A part that does not face the other at the arc's end: the node there has no such contact.
bool is_silent_at_end(const Scene& scene, const Pair& pair, ArcWork& work);

}  // namespace saltus
