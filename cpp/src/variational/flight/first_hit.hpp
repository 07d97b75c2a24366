// The first gap that closes on the chord of an arc.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

struct FirstHit {
  int slot = -1;      ///< of the pair; none
  double s = 2;       ///< where on the chord
  bool hops = false;  ///< it touches at the node and leaves, yet closes along the chord from the
                      ///< start: it is back before the arc ends
};

/// Writes flight.dq, the chord. The pool may grow.
FirstHit first_hit(const Scene& scene, const Node& node, Flight& flight);

/// An end of a rod whose axis is held on an edge, where the edge comes to that end: the two touch
/// in the same point, and that of the end only grazes.
bool grazes_with_axis(const Scene& scene, int end, const Node& node, ArcWork& work);

}  // namespace saltus
