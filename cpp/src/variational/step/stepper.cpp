#include "variational/step/stepper_impl.hpp"

#include <cmath>
#include <exception>
#include <sstream>
#include <utility>

#include "variational/flight/finish.hpp"
#include "variational/flight/impact_time.hpp"
#include "variational/step/contact_report.hpp"
#include "variational/terms/check_options.hpp"

namespace saltus {

namespace {

/// [h] What an event so near the step's end leaves of it is not flown with contacts held: they
/// would take the rounding of gaps out within no time.
constexpr double no_duration = 1e-12;

/// Arcs that end without an impact: gaps that graze, a few a step.
constexpr int most_arcs_idle = 100;

/// Arcs of attempts at one step that failed: with more it is the arcs that are many, not long.
constexpr int most_arcs_spent = 256;

/// Touches (1e-10 of the shapes' size) that are an overlap: what a state written with 8 digits
/// loses is none.
constexpr double overlap_touches = 100;
constexpr double visible_touches = 1e8;  ///< a hundredth of the shapes' size

/// The gradient of kappa is there for one-degree joints alone.
void check_law(const ModelData& model, ImpactLaw law) {
  if (law != ImpactLaw::compensated || model.tree.balls.empty()) return;
  for (const JointInfo& joint : model.joints) {
    if (joint.type != JointType::floating && joint.type != JointType::spherical) continue;
    throw ModelError("law compensated is not for floating and spherical joints, as \"" +
                         joint.name + "\" is; shadow_energy and discrete_energy are",
                     "joint", joint.name);
  }
}

}  // namespace

Stepper::Stepper(const Model& model, const StepOptions& options) {
  check_options(options);
  check_law(*model, options.law);
  impl_ = std::make_unique<Impl>(model, options);
}
Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;

const StepReport& Stepper::report() const { return impl_->report; }
const Model& Stepper::model() const { return impl_->model; }
const StepOptions& Stepper::options() const { return impl_->options; }

State Stepper::advance(const State& state) {
  State next = state;
  impl_->step(next);
  return next;
}

void Stepper::step(State& state) { impl_->step(state); }

void Stepper::forget() { impl_->last_is_valid = false; }

// A step that cannot be made is tried again from its start: if it was the guesses of the steps
// before that led astray, without them; then with shorter arcs.
void Stepper::Impl::step(State& state) {
  report.fallbacks.clear();
  const double t = state.t;
  const bool is_own = last_is_valid && state == last;  // where a step of ours ended
  bool has_guesses = is_own;
  std::exception_ptr first;
  int arcs = 0, iterations = 0;
  longest = options.h;
  for (int halvings = 0;;) {
    halves_help = false;
    try {
      step_once(state, is_own);
      report.iterations += iterations;
      if (halvings > 0) report.fallbacks.push_back({t, longest, Rung::halved});
      return;
    } catch (const StepError&) {
      if (!first) first = std::current_exception();
      arcs += report.arcs;
      iterations += report.iterations;
      if (!halves_help || arcs > most_arcs_spent) break;
    }
    if (std::exchange(has_guesses, false)) continue;
    if (halvings == options.max_halvings) break;
    ++halvings;
    longest /= 2;
  }
  fail_at_last(first);
}

// Fly to the first impact, resolve it, go on for the time left.
void Stepper::Impl::step_once(State& state, bool is_own) {
  report.iterations = report.arcs = report.sustained = 0;
  report.residual = report.friction_residual = 0;
  report.impacts.clear();
  report.impulses.clear();
  report.contacts.clear();
  report.settlings.clear();
  report.certificates.clear();
  flight.settlings.clear();
  if (!last_is_valid || !(state == last) || node.pool.is_full()) start(state, is_own);
  last_is_valid = false;  // until this step is done
  const double t_start = state.t, h = options.h;
  for (double left = h; left > 0;) {
    fly_one_arc(std::min(left, longest));
    left = flight.arc.tau < left ? left - flight.arc.tau : 0;
    if (!flight.rows.active.empty() && left < no_duration * h) left = 0;
    arrive(t_start + (h - left));
  }
  end_step();
  state = last;
}

void Stepper::Impl::start(const State& state, bool is_own) {
  const VecX q = model.checked_q(state.q, "state.q");
  check_vector(state.p, model.n_v(), "state.p", "velocities");
  if (!std::isfinite(state.t)) throw ModelError("state.t is not finite");
  last_is_valid = false;
  last = state;
  last.q = q;
  flight.history.clear();
  flight.has_rate = false;
  node.launch.pending = false;
  node.launch.change = 0;
  start_anew(node.broad);
  start_anew(flight.broad);
  if (node.pool.is_full()) forget_pairs(node);
  forget_memory(flight.rows);
  node.t = state.t;
  node.q = q;
  node.p = state.p;
  if (!start_from_momenta(*model, node)) fail(FlightOutcome::not_converged);
  place_node(*model, node);
  if (!find_contacts(*model, options, node)) fail(FlightOutcome::not_converged);
  if (!is_own) check_overlap();
  if (impact_pending(node)) arrive(state.t);
}

void Stepper::Impl::check_overlap() const {
  std::ostringstream text;
  int found = 0;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.phi >= -overlap_touches * node.pool[c.pair].touch) continue;
    if (++found <= 5) {
      text << (found > 1 ? ", " : "") << model.pair_name(node.pool.number(c.pair)) << " by "
           << -c.phi << " m";
    }
  }
  if (found == 0) return;
  if (found > 5) text << " and " << found - 5 << " pairs more";
  throw ModelError("bodies overlap at the start: " + text.str() +
                   "; move them apart (resolve_overlap does), exclude the pair, or step without "
                   "collisions");
}

void Stepper::Impl::fly_one_arc(double left) {
  bool fallback = false;
  const FlightOutcome outcome = fly(*model, options, left, node, flight, fallback);
  report.iterations += flight.iterations;
  flight.iterations = 0;
  report.residual = std::max(report.residual, flight.arc.residual);
  if (outcome != FlightOutcome::arrived) fail(outcome);
  for (const Settling& each : flight.settlings) {
    report.settlings.push_back({each.t, node.pool.number(each.pair)});
  }
  flight.settlings.clear();
  if (fallback && !report.impacts.empty()) {
    report.impacts.back().fallback = true;
    report.impacts.back().law = ImpactLaw::nodal_energy;
  }
  ++report.arcs;
  tell_launch(flight, node, report);
  flight.history.add(node.t + flight.arc.tau / 2, flight.arc.v);
  deepest = 0;
  for (int i = 0; i < node.touching; ++i) deepest = std::min(deepest, node.contacts[i].phi);
  if (flight.rows.active.empty()) return;
  tell_residual(flight.rows, report);
  tell_rows(node, flight, report);
  report.sustained += count_pressed(flight.rows);
  kinetic = 0.5 * node.p.dot(node.v);
  energy = node_energy(*model, node);
}

bool Stepper::Impl::is_last_attempt() const {
  return longest <= std::ldexp(options.h, -options.max_halvings);
}

/// Contacts do no work. An arc that they hold and that gains energy is another root of the arc's
/// equation than the motion. Of 2062 arcs of fast chains the wrong roots had gained .86 of the
/// kinetic energy and more, and less than 1 % of the right ones swung by .3. As long as shorter
/// arcs can be tried less is enough for that: midpoints of an arc swing by (h omega)^2 / 8.
void Stepper::Impl::check_energy() {
  if (flight.rows.active.empty() || node.launch.pending) return;
  const double most = is_last_attempt() ? 0.3 : 0.02;
  // slower is rest: what a step's gravity gives, and what the rounding of gaps does
  const double slow = options.h * model->mass.gravity.norm() + node.most_touch / options.h;
  const double least = 0.5 * node.total_mass * slow * slow;
  const double gain = node_energy(*model, node) - energy;
  if (gain > most * std::max({kinetic, 0.5 * node.p.dot(node.v), least})) fail_energy(gain);
}

/// No arc ends with bodies deeper in each other than it started. Where parts come to face each
/// other that overlap already no shorter arc helps: that is an error where anybody can see it.
void Stepper::Impl::check_gaps() {
  const double most = is_last_attempt() ? visible_touches : overlap_touches;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.phi < deepest - most * node.pool[c.pair].touch) fail_sinking(c);
  }
}

// Ends the arc at a node, and resolves the impact there if there is one.
void Stepper::Impl::arrive(double t) {
  if (t > node.t || report.arcs > 0) {
    if (!finish(*model, options, t, flight, node)) fail(FlightOutcome::not_converged);
    check_energy();
    check_gaps();
    tell_closing(flight, report);
    tell_residual(flight.rows, report);
    if (!(flight.rows.residual <= large_residual)) {
      const Rows& rows = flight.rows;
      flight.closing = rows.closing[most_lawless(rows.W, rows.u, rows.p)]->pair;
      fail(FlightOutcome::law_not_met);
    }
  }
  const int impacts = static_cast<int>(report.impacts.size());
  if (!impact_pending(node)) {  // gaps that graze 0 may stop arc after arc where none closes
    const double meant = options.h / longest + std::min(options.max_impacts, most_arcs_idle);
    if (report.arcs - impacts > meant) fail_arcs();
    return;
  }
  if (impacts == options.max_impacts) fail_impacts();
  if (!resolve_node_impact(*model, options, conserved_energy(), node, report)) fail_jammed();
  flight.history.clear();
  forget_memory(flight.rows);
}

// What the law conserves, at the node before the impact.
double Stepper::Impl::conserved_energy() {
  if (options.law == ImpactLaw::shadow_energy) {
    if (report.impacts.empty()) {  // what is left of it after the impacts of this step
      if (!measure(*model, last.q, last.p, options.h, *flight.meter)) {
        fail(FlightOutcome::not_converged);
      }
      node.launch.energy = flight.meter->energy.shadow;
    }
    return node.launch.energy;
  }
  if (options.law != ImpactLaw::discrete_energy && options.law != ImpactLaw::compensated) return 0;
  if (report.arcs == 0) {  // at the start: an arc of no duration
    flight.rows.active.clear();
    flight.arc.v = node.v;
    if (!solve_flight_arc(*model, options, 0, node, flight)) fail(FlightOutcome::not_converged);
  }
  const ArcProblem problem{flight.arc.q_start, node.p, flight.arc.tau, nullptr,
                           whole_step(options)};
  return arc_energy(*model, problem, flight.arc, flight.scratch);
}

// A launch that is pending at the end of the step is an arc of no duration: H(q, p+) = E_d.
void Stepper::Impl::end_step() {
  if (node.launch.pending) {
    fly_one_arc(0);
    node.p = flight.arc.p_end;
    node.v = flight.arc.v;
  }
  last.t = node.t;
  last.q = node.q;
  last.p = node.p;
  last_is_valid = true;
}

}  // namespace saltus
