// A flight: the arc from a node up to the first impact, or to the end of the step.
//
// Paper, section III-B, III-C; theory, section 4. The arc over the whole remaining time is tried;
// if a gap closes on its chord, the time of the impact is the root of
//
//   g(tau) = phi(q (+) tau v(tau)) = 0,   g' = n.(v + tau v'),   v' = -J^-1 dp_start/dtau
//
// with v(tau) from the arc equation itself, by safeguarded Newton. The shortened arc is tried
// again, until its chord is clear: no impact inside a step is missed, and none is taken too late.
#pragma once

#include <optional>
#include <vector>

#include "saltus/variational/options.hpp"
#include "variational/arc/arc.hpp"
#include "variational/arc/energy_meter.hpp"
#include "variational/arc/guess.hpp"
#include "variational/flight/rows.hpp"

namespace saltus {

struct Flight {
  Flight(const ModelData& model, const StepOptions& options, bool with_friction);

  Arc arc;  ///< the result
  GuessHistory history;
  int closing = -1;          ///< place of the pair whose impact was sought last
  int iterations = 0;        ///< Newton iterations of all arcs tried
  double settling_time = 0;  ///< [s] from the node, of the pair that settles
  bool has_rate = false;     ///< `rate` is v' of the arc, which ends where a gap closes

  std::vector<Settling> settlings;       ///< appended to; `pair` is a place in the pool
  std::vector<ContactImpulse> closings;  ///< of the half kick at the end of the arc before
  Rows rows;
  LaunchLine launch;         ///< of the arc, if
  bool is_launched = false;  ///< it has one

  // scratch
  ArcScratch scratch;
  BroadPhase broad;
  std::optional<EnergyMeter> meter;  ///< where the law is shadow_energy
  VecX rate, start_v, before_v, n;
  std::vector<char> passed;  ///< (pairs) no impact to be found, as long as contacts hold as now
  std::vector<char> passes;  ///< (pairs) how often that was so in this flight
};

enum class FlightOutcome {
  arrived,
  not_converged,
  no_progress,
  impact_not_located,  ///< of the pair flight.closing
  law_not_met,         ///< likewise
};

/// Flies from the node for at most `left` [s]. On `arrived`, flight.arc is the arc flown, and
/// flight.rows what held contacts closed in it.
/// @param fallback set where options.law could not be met and nodal_energy was used
FlightOutcome fly(const ModelData& model, const StepOptions& options, double left, Node& node,
                  Flight& flight, bool& fallback);

}  // namespace saltus
