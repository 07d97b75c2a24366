// When a gap closes on the true arc: one scalar root.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// How a gap that closes on the chord closes on the arc.
enum class ImpactTime {
  found,          ///< flight.arc ends at phi = 0
  missed,         ///< the chord grazes what the arc passes: no impact
  at_rest,        ///< the pair would hop lower than pair.touch: it rests
  settles,        ///< it bounces ever lower, and has come to rest before the arc ends
  not_converged,  ///< an arc on the way did not converge
  not_located,    ///< the root was not found in the bounded number of arcs
};

/// The arc of duration tau from the node: of what nothing holds, and with the impulses of the
/// active rows in rows.momentum.
ArcProblem arc_problem(const StepOptions& options, double tau, const Node& node, Flight& flight);
ArcProblem held_arc_problem(const StepOptions& options, double tau, const Node& node,
                            Flight& flight);

/// Solves the arc of duration tau from the node with the flight's active rows, and its launch.
bool solve_flight_arc(const ModelData& model, const StepOptions& options, double tau, Node& node,
                      Flight& flight);

/// @param place of the pair in the node's pool
/// @param s where on the chord of flight.arc (of duration tau) the gap closes; 0 for a pair that
/// touches at the node and leaves: then the time of its return is sought.
ImpactTime find_impact_time(const ModelData& model, const StepOptions& options, int place, double s,
                            Node& node, Flight& flight);

}  // namespace saltus
