#include "variational/step/stepper_impl.hpp"

#include <cmath>
#include <exception>
#include <utility>

#include "saltus/model/check_derivatives.hpp"
#include "variational/step/contact_report.hpp"
#include "variational/terms/check_options.hpp"

namespace saltus {

namespace {

/// [h] What an event so near the step's end leaves of it is not flown with contacts held: they
/// would take the rounding of gaps out within no time.
constexpr double no_duration = 1e-12;

/// Arcs of attempts at one step that failed: with more it is the arcs that are many, not long.
constexpr int most_arcs_spent = 256;

/// Attempts at a step with many arcs that graze: those by shorter arcs graze as well.
constexpr int most_grazing = 3;

/// Of the step, for arcs of time stepping where the step is a large pile's.
constexpr int few_halvings = 2;

}  // namespace

Stepper::Stepper(const Model& model, const StepOptions& options) {
  check_options(options);
  check_law(*model, options.law);
  impl_ = std::make_unique<Impl>(model, options);
}
Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;

State Stepper::advance(const State& state, const ForceInput& input) {
  State next = state;
  impl_->step(next, input);
  return next;
}

void Stepper::step(State& state, const ForceInput& input) { impl_->step(state, input); }

void Stepper::forget() { impl_->last_is_valid = false; }

// A step that cannot be made is tried again from its start: if it was the guesses of the steps
// before that led astray, without them; then with shorter arcs; at last by time stepping where
// nothing else is found.
void Stepper::Impl::step(State& state, const ForceInput& with) {
  take(with);
  if (stands_on(state)) return stand(state);
  report.fallbacks.clear();
  forget_pile_work();
  const double t = state.t;
  const bool is_own = last_is_valid && state == last;  // where a step of ours ended
  bool has_guesses = is_own;
  std::exception_ptr first;
  std::string why;
  int arcs = 0, iterations = 0;
  longest = scene.options.h;
  is_last_attempt = false;
  grazes = 0;
  for (int halvings = 0;;) {
    halves_help = blames_contact = false;
    try {
      is_last_attempt ? step_at_any_price(state, is_own) : step_once(state, is_own);
      report.iterations += iterations;
      if (halvings > 0) report.fallbacks.push_back({t, longest, Rung::halved, 0, -1});
      return;
    } catch (const StepError&) {
      if (!first) {
        first = std::current_exception();
        why = cause;
      }
      arcs += report.arcs;
      iterations += report.iterations;
      if (is_last_attempt || !(halves_help || blames_contact)) break;
    }
    if (std::exchange(has_guesses, false)) continue;
    const bool is_large = pile_work() > most_pile_work;
    const bool is_spent =
        is_large || arcs > most_arcs_spent || iterations > most_work() || grazes >= most_grazing;
    if (!halves_help || is_spent || halvings == scene.options.max_halvings) {
      if (scene.options.strict || !blames_contact) break;
      is_last_attempt = true;
      // nothing but time stepping is left to what is spent: a few arcs of it are enough
      halvings = is_large ? std::min(few_halvings, scene.options.max_halvings)
                          : scene.options.max_halvings;
    } else {
      ++halvings;
    }
    longest = std::ldexp(scene.options.h, -halvings);
  }
  fail_at_last(first, why);
}

// The last step changed nothing, and this one is the same; nor has the report anything that is of
// one step alone.
bool Stepper::Impl::stands_on(const State& state) const {
  const bool is_plain =
      report.impacts.empty() && report.settlings.empty() && report.fallbacks.empty();
  return standing.steps_on && is_plain && last_is_valid && input_is_same && !recorded &&
         state == last;
}

void Stepper::Impl::stand(State& state) {
  report.iterations = 0;
  node.t = last.t = state.t += scene.options.h;
}

// Fly to the first impact, resolve it, go on for the time left.
void Stepper::Impl::step_once(State& state, bool is_own) {
  clear(report);
  if (!last_is_valid || !(state == last) || pool.is_full()) start(state, is_own);
  last_is_valid = false;  // until this step is done
  start_tape(state);
  start_step(flight);
  set_shift();
  const double t_start = state.t, h = scene.options.h;
  const Launch* launch = has_approach(node) ? collide() : nullptr;
  for (double left = h; left > 0;) {
    const double asked = std::min(left, longest);
    fly_one_arc(asked, launch);
    record_arc(asked, left, launch);
    left = flight.work.arc.tau < left ? left - flight.work.arc.tau : 0;
    if (!flight.work.rows.active.empty() && left < no_duration * h) left = 0;
    end_arc(t_start + (h - left));
    record_end();
    launch = has_approach(node) ? collide() : nullptr;
  }
  end_step(launch);
  state = last;
}

void Stepper::Impl::start(const State& state, bool is_own) {
  const VecX q = scene.shared.checked_q(state.q, "state.q");
  check_vector(state.p, scene.shared.n_v(), "state.p", "velocities");
  if (!std::isfinite(state.t)) throw ModelError("state.t is not finite");
  check_derivatives_once(scene.shared, q, state.t);
  last_is_valid = false;
  last = state;
  last.q = q;
  saltus::forget(memory);
  middle.is_known = false;
  start_anew(node.broad);
  start_anew(flight.broad);
  saltus::forget(standing);
  if (pool.is_full()) forget_pairs(node);
  place_node(scene, state.t, q, state.p, node);
  if (!scene.model.has_gaps()) place_frames(scene, node);  // for its velocity
  if (!set_velocity_at_node(scene, node) || !find_contacts(scene, node)) {
    fail(FlightOutcome::not_converged);
  }
  if (node.driven_together >= 0) fail_driven();
  if (is_own) return;
  check_overlap();
  if (node.loops.some) check_loops();
}

void Stepper::Impl::fly_one_arc(double left, const Launch* launch) {
  const FlightOutcome outcome = fly(scene, left, launch, node, memory, flight);
  const ArcWork& work = flight.work;
  report.iterations += std::exchange(flight.work.iterations, 0);
  report.residual = std::max(report.residual, work.arc.residual);
  if (outcome != FlightOutcome::arrived) fail(outcome);
  add_work();
  add_shift_work();
  add_dry_work();
  if (work.scratch.loops) {
    report.loops += work.scratch.loops->mu;
    add_loop_work(work.scratch.loops->mu);
  }
  if (launch == nullptr) {
    check_free_energy();
  } else {
    middle.is_known = false;
  }
  note_start();
  ++report.arcs;
  remember(work.arc, node.t, work.rows, memory);
  tell_settlings(pool, flight, report);
  if (launch != nullptr) tell_launch(*launch, flight, report);
  if (!work.rows.active.empty()) tell_rows(node, work.rows, report);
}

// Ends the arc at a node.
void Stepper::Impl::end_arc(double t) {
  if (!finish(scene, t, flight.broad.motion, flight.work, node, kick))
    fail(FlightOutcome::not_converged);
  if (!node.p.allFinite()) fail(FlightOutcome::not_converged);
  remember(kick, memory);
  if (node.driven_together >= 0) fail_driven();
  if (!(kick.residual <= large_residual)) fail_law(kick.unlawful, kick.residual);
  tell_half_kick(kick, report);
  if (node.loops.some) {
    report.loops += node.loops.impulse;
    add_loop_work(node.loops.impulse);
  }
  report.work[scene.model.forces.n_u() + 1] += kick.dry_work;
  check_energy();
  check_gaps();
  if (!has_approach(node)) check_idle_arcs();
  if (report.iterations > most_work() || (!is_last_attempt && pile_work() > most_pile_work)) {
    fail_work();
  }
}

// Resolves the impact at the node. @return what the next arc has to meet, or nullptr
const Launch* Stepper::Impl::collide() {
  if (static_cast<int>(report.impacts.size()) >= most_impacts()) fail_impacts();
  const Launch* launch = nullptr;
  const double energy_before = conserved_energy();
  node.loops.impulse.setZero();
  record_contacts();
  if (!resolve_impact_at(scene, energy_before, node, impact, report, launch)) fail_jammed();
  record_impulses();
  if (node.loops.some) add_loop_work(node.loops.impulse);
  forget_velocities(memory);
  middle.is_known = false;
  return launch;
}

// What the law conserves, at the node before the impact.
double Stepper::Impl::conserved_energy() {
  const ImpactLaw law = scene.options.law;
  if (law == ImpactLaw::shadow_energy) {
    if (node.loops.some) return 0;
    // after the first impact of a step what is left of it
    if (!report.impacts.empty()) return impact.launch.energy;
    if (!measure(scene.model, last.q, last.p, scene.options.h, *flight.meter)) {
      fail(FlightOutcome::not_converged);
    }
    return flight.meter->energy.shadow;
  }
  if (law != ImpactLaw::discrete_energy && law != ImpactLaw::compensated) return 0;
  if (node.loops.some) return 0;
  ArcWork& work = flight.work;
  work.line.use = LaunchLine::Use::none;
  if (report.arcs == 0) {  // at the start: an arc of no duration
    work.rows.active.clear();
    work.arc.v = node.v;
    if (!solve(scene, 0, node, work)) fail(FlightOutcome::not_converged);
  }
  const Arc& arc = work.arc;
  const ArcProblem problem{arc.q_start,        node.p,          arc.tau, nullptr,
                           scene.whole_step(), node.t - arc.tau};
  return arc_energy(scene.model, problem, arc, work.scratch);
}

// A launch that is left at the end of the step is an arc of no duration: H(q, p+) = E_d.
void Stepper::Impl::end_step(const Launch* launch) {
  if (launch != nullptr) {
    fly_one_arc(0, launch);
    refuse("an impact at its end whose law matches energies");
    node.p = flight.work.arc.p_end;
    node.v = flight.work.arc.v;
  }
  if (launch == nullptr && report.fallbacks.empty()) {
    stand_still(scene, last, kick, node, standing);
  } else {
    saltus::forget(standing);
  }
  last.t = node.t;
  last.q = node.q;
  last.p = node.p;
  last_is_valid = true;
  end_tape();
}

}  // namespace saltus
