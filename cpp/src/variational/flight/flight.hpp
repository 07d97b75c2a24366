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

#include "variational/arc/energy_meter.hpp"
#include "variational/arc/memory.hpp"
#include "variational/arc/solve.hpp"
#include "variational/flight/held_path.hpp"
#include "variational/impact/impact.hpp"

namespace saltus {

/// Pairs that no impact is sought of, as long as contacts hold as they do: they graze, or rest.
class Skips {
 public:
  struct Pass {
    int slot;
    int times;  ///< in this flight
    bool now;
  };

  void start();
  void let_pass(int slot);
  bool passes(int slot) const;
  void watch_again();  ///< what may pass on one arc is watched on one that others hold
  const std::vector<Pass>& some() const { return some_; }

 private:
  std::vector<Pass> some_;  ///< few
};

/// A gap that closes on the chord of an arc.
struct Hit {
  int slot;   ///< of the pair
  double s;   ///< where on the chord
  bool hops;  ///< it touches at the node and leaves, yet closes along the chord from the start: it
              ///< is back before the arc ends
  bool sinks = false;  ///< a part that another bears at the node, and not on the arc
  double target = 0;   ///< [m] what a gap that sinks is sought at
};

/// A pair that came to rest in an arc of this step.
struct Soft {
  int slot;
  double acceleration;  ///< [m/s^2] of its gap, towards 0
};

/// Written by `start_step` and `fly`.
struct Flight {
  explicit Flight(const Scene& scene);

  ArcWork work;                     ///< the arc flown, and what held contacts closed in it
  int closing = -1;                 ///< slot of the pair whose impact was sought last
  int ends_at = -1;                 ///< slot of the pair whose impact ended the last shorter arc
  std::vector<Settling> settlings;  ///< of this flight; `pair` is a slot
  std::vector<Soft> softs;          ///< of all flights of the step
  bool has_missed_energy = false;   ///< the launch could not be met: nodal_energy was used

  // scratch
  Skips skips;
  BroadPhase broad;
  std::vector<Hit> hits;             ///< on the chord of the arc, in no order
  std::optional<EnergyMeter> meter;  ///< where the law is shadow_energy
  Contact closing_contact;           ///< of a pair that is open at the node
  HeldPath path;
  VecX dq, start_v, before_v, n;
};

/// No pair has come to rest yet.
inline void start_step(Flight& flight) { flight.softs.clear(); }

enum class FlightOutcome {
  arrived,
  not_converged,
  no_progress,
  impact_not_located,  ///< of the pair flight.closing
  law_not_met,         ///< of the pair flight.work.unlawful
};

/// Flies from the node for at most `left` [s].
/// @param launch what the arc after an impact has to meet, or nullptr
FlightOutcome fly(const Scene& scene, double left, const Launch* launch, const Node& node,
                  Memory& memory, Flight& flight);

}  // namespace saltus
