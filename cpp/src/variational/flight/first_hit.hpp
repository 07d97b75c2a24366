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

/// The lowest point of a rim that lies on an edge or a rim, in two places that touch both: it goes
/// from one to the other, and closes with them. Where one alone touches, the other is open and is
/// not watched before the two are level; so the rim says when that is.
bool grazes_with_crossings(const Scene& scene, int rim, const Node& node, ArcWork& work);

}  // namespace saltus
