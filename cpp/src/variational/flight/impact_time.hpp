// When a gap closes on the true arc: one scalar root.
#pragma once

#include "variational/flight/first_hit.hpp"

namespace saltus {

/// How a gap that closes on the chord closes on the arc.
enum class ImpactTime {
  found,          ///< the arc ends at phi = 0
  missed,         ///< the chord grazes what the arc passes: no impact
  at_rest,        ///< the pair would hop lower than pair.touch: it rests
  not_converged,  ///< an arc on the way did not converge
  not_located,    ///< the root was not found in the bounded number of arcs
};

/// Of a gap at the end of an arc that contacts hold: that is no sharper.
constexpr double noisy_touches = 100;

/// [m] of the pair, at the end of the arc.
double phi_at_end(const Scene& scene, const Pair& pair, ArcWork& work);

/// Contacts hold the arc, and no rim, whose lowest point leaps where it passes level.
bool has_smooth_path(const Pair& pair, const ArcWork& work);

/// Shortens flight.work.arc to where the pair that the chord hits closes; of one that hops, to its
/// return. Writes memory.rate.
ImpactTime find_impact_time(const Scene& scene, const Hit& hit, const Node& node, Memory& memory,
                            Flight& flight);

}  // namespace saltus
