// What an arc has to keep to be a part of the step.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "saltus/model/close_loops.hpp"
#include "variational/step/stepper_impl.hpp"

namespace saltus {
namespace {

/// Arcs that end without an impact: gaps that graze, a few a step. With more, time stepping is
/// better, if it may be.
constexpr int most_arcs_idle = 100, few_arcs_idle = 20;

constexpr double sunk_touches = 100;     ///< touches (1e-10 of the shapes' size) that are sinking
constexpr double least_visible = 1e4;    ///< that are moved apart where no shorter arc helps
constexpr double visible_touches = 1e8;  ///< a hundredth of the shapes' size

}  // namespace

/// Of a step. Bodies that rebound in part may do so without end: then time stepping is better.
int Stepper::Impl::most_impacts() const {
  const int most = scene.options.max_impacts;
  if (scene.options.strict || !loses_energy()) return most;
  constexpr int few = 32;
  const int plenty = 100 + 10 * static_cast<int>(scene.model.links.size());
  return std::min(most, is_last_attempt ? few : plenty);
}

/// Newton iterations of an attempt, and of those before the last one.
int Stepper::Impl::most_work() const { return 10 * scene.options.max_impacts; }

/// Of all piles in this step, whatever its attempts were good for.
double Stepper::Impl::pile_work() const {
  return flight.work.rows.pile.work + kick.pile.work + impact.friction.pile.work;
}

void Stepper::Impl::forget_pile_work() {
  flight.work.rows.pile.work = kick.pile.work = impact.friction.pile.work = 0;
}

/// Shorter arcs can be tried yet, or time stepping.
bool Stepper::Impl::halves_left() const {
  return is_last_attempt || !scene.options.strict ||
         longest > std::ldexp(scene.options.h, -scene.options.max_halvings);
}

void Stepper::Impl::note_start() {
  deepest = lowest_gap(node);
  if (flight.work.rows.active.empty() && !node.loops.some) return;
  kinetic = 0.5 * node.p.dot(node.v);
  energy = node_energy(scene, node);
}

/// Contacts do no work. An arc that they hold and that gains energy is another root of the arc's
/// equation than the motion. Of 2062 arcs of fast chains the wrong roots had gained .86 of the
/// kinetic energy and more, and less than 1 % of the right ones swung by .3. As long as shorter
/// arcs can be tried less is enough for that: midpoints of an arc swing by (h omega)^2 / 8.
void Stepper::Impl::check_energy() {
  const bool is_held = !flight.work.rows.active.empty();
  if (!is_held && !node.loops.some) return;
  // where loops pass dead points another root may be near, and energy swings more
  const double most = is_held && halves_left() ? 0.02 : 0.3;
  // slower is rest: what a step's gravity gives, and what the rounding of gaps does
  const double h = scene.options.h;
  const double slow = h * scene.model.mass.gravity.norm() + most_touch(scene, node) / h;
  const double least = 0.5 * scene.total_mass * slow * slow;
  const double gain = node_energy(scene, node) - energy - done;
  if (gain > most * std::max({kinetic, 0.5 * node.p.dot(node.v), least, done_size})) {
    fail_energy(gain);
  }
}

/// The arc just flown has another energy, T + V in its middle, than the one before. Costs two sums.
bool Stepper::Impl::is_doubtful() {
  const ArcWork& work = flight.work;
  const double T = 0.5 * work.arc.v.dot(work.scratch.L_v);
  const MiddleEnergy now{T, T + potential_energy(scene.model.packed, work.scratch.w), done, true};
  const MiddleEnergy before = std::exchange(middle, now);
  if (!before.is_known) return false;
  const double gain = now.total - before.total - (now.work + before.work) / 2;
  constexpr double doubtful = 0.1;  // midpoints swing by (h omega)^2 / 8
  return std::abs(gain) > doubtful * std::max({T, before.kinetic, done_size});
}

/// Of bodies without contacts it is asked where Newton's method took long, a root near its guess
/// takes 2 to 4 iterations, and where energy jumps from arc to arc. The bound is that of
/// check_energy for the last attempt, for the reason there.
void Stepper::Impl::check_free_energy() {
  const ArcWork& work = flight.work;
  constexpr int usual_iterations = 5;
  if (!work.rows.active.empty() || node.loops.some) {  // loops' half kick comes yet: check_energy
    middle.is_known = false;
    return;
  }
  if (!is_doubtful() && work.arc.iterations <= usual_iterations) return;
  const double h = scene.options.h;
  if (!measure(scene.model, node.q, node.p, h, meter)) return;
  const double T = meter.energy.kinetic, H = T + meter.energy.potential;
  if (!measure(scene.model, work.arc.q_end, work.arc.p_end, h, meter)) return;
  const double T_end = meter.energy.kinetic, gain = T_end + meter.energy.potential - H - done;
  kinetic = T;
  if (std::abs(gain) > 0.3 * std::max({T, T_end, done_size})) fail_energy(gain);
}

/// Of a step that was made at any price, by what it was before: it may be an error, but no gain.
void Stepper::Impl::check_step_energy(double start) {
  if (!set_velocity_at_node(scene, node)) fail(FlightOutcome::not_converged);
  const double gain = node_energy(scene, node) - start - report.work.sum();
  kinetic = 0.5 * node.p.dot(node.v);
  if (gain > 0.3 * std::max(kinetic, report.work.cwiseAbs().sum())) fail_energy(gain);
}

/// No arc ends with bodies deeper in each other than it started. Where parts come to face each
/// other that overlap already no shorter arc helps: that is an error where anybody can see it.
void Stepper::Impl::check_gaps() {
  const double most = is_last_attempt ? least_visible
                      : halves_left() ? sunk_touches
                                      : visible_touches;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.phi < deepest - most * pool[c.slot].touch) fail_sinking(c);
  }
  lift_out();
}

/// Gaps that graze 0 may stop arc after arc where none closes.
void Stepper::Impl::check_idle_arcs() {
  const int most = scene.options.strict ? most_arcs_idle : few_arcs_idle;
  const double meant = scene.options.h / longest + std::min(scene.options.max_impacts, most);
  if (report.arcs - static_cast<int>(report.impacts.size()) > meant) fail_arcs();
}

/// An arc of time stepping leaves loops closed, and what they drive together apart, or there is
/// none.
/// @param lowest [m] gap before it
void Stepper::Impl::check_closed(double lowest) {
  if (!node.p.allFinite()) fail(FlightOutcome::not_converged);
  if (!node.loops.some) return;
  constexpr double rounding = 1e-10;
  const EqualityValues& values = node.loops.values;
  for (int k = 0; k < values.h.size(); ++k) {
    if (std::abs(values.h[k]) <= rounding * values.size[k]) continue;
    blames_contact = false;
    std::ostringstream text;
    text << "loop \"" << equality_of(scene.model, k).name
         << "\" cannot be kept closed after t = " << node.t << " s: it would open by "
         << std::abs(values.h[k]);
    raise(text.str(), "loops that contradict each other, or what is told, have no motion", 0);
  }
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.phi >= lowest - least_visible * pool[c.slot].touch) continue;
    node.driven_together = c.slot;
    fail_driven();
  }
}

}  // namespace saltus
