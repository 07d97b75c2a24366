// Closings that no step can follow: a pair comes to rest where it meets.
//
// A pair that touches, hops and is back rests when its next hops would take less time than the step
// has (theory, section 6, Zeno). So does a pair that closes at u = g'(tau*) with the acceleration a
// of the gap, where it would be back from its rebound within half a step, 2 e |u| / a <= h / 2, and
// where |u| <= a h, what forces change of it in one step. Neither is located: the law of the arc
// lets the gap close by the arc's end, with all that rests. What that is off by is O(h^2) of
// positions, as the arc itself.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// The closing pair of a hop, by the arc's end.
struct Return {
  double drop = 0;  ///< [m] how far the gap's end is below where its rate would lead it; < 0
  double back = 0;  ///< [s] when it is closed again, about
  bool settles = false;
};

/// Of a pair that touches, leaves and comes back within the arc just solved: g(0) = 0 is the root
/// not wanted. From g ~ u tau + a tau^2 / 2 through the arc's end, the return is near -2 u / a.
Return return_of(const Scene& scene, int slot, const Node& node, ArcWork& work);

/// [s] When all further hops of it would be over.
double settling_time(const Return& hop, double restitution);

/// Lets those rest at once that came to rest in an arc of this step which an impact of others cut,
/// and by their gaps' rates at the node would again: of what an arc is needed to see of others it
/// is known already.
void rest_as_before(const Scene& scene, double left, const Node& node, Flight& f);

/// Lets all hits that are so rest from now on, and takes them out of f.hits.
/// @return true where there are some
bool rest_soft_hits(const Scene& scene, const Node& node, Flight& f);

}  // namespace saltus
