#include "saltus/variational/stepper.hpp"

#include <cmath>
#include <sstream>

#include "variational/arrival.hpp"
#include "variational/check_options.hpp"
#include "variational/contact_report.hpp"
#include "variational/friction_arc.hpp"
#include "variational/impact_time.hpp"

namespace saltus {

namespace {

/// [h] What an event so near the step's end leaves of it is not flown with contacts held: they
/// would take the rounding of gaps out within no time.
constexpr double no_duration = 1e-12;

}  // namespace

struct Stepper::Impl {
  Impl(const Model& with, const StepOptions& with_options)
      : model(with_options.collisions ? with : with.without_collisions()),
        options(with_options),
        node(*model),
        flight(*model, options, node.friction.any) {
    last.q.setZero(model.n_q());
    last.p.setZero(model.n_q());
    report.impacts.reserve(64);
    report.impulses.reserve(1024);
    if (node.friction.any) report.friction.reserve(1024);
    report.settlings.reserve(64);
    report.contacts.reserve(64);
  }

  void step(State& state);
  void start(const State& state);
  void check_overlap() const;
  void fly_one_arc(double left);
  void arrive(double t);
  double conserved_energy();
  void finish();
  [[noreturn]] void fail(FlightOutcome outcome) const;
  [[noreturn]] void fail_jammed();
  [[noreturn]] void fail_impacts() const;
  std::string contact_list() const;
  std::string singular_joint() const;

  Model model;
  StepOptions options;
  Node node;
  Flight flight;
  StepReport report;
  State last;  // where the step starts; the node still holds it if the last step ended there
  bool last_is_valid = false;
};

Stepper::Stepper(const Model& model, const StepOptions& options) {
  check_options(options);
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

// The step: fly to the first impact, resolve it, go on for the time left.
void Stepper::Impl::step(State& state) {
  report.iterations = report.arcs = report.sustained = 0;
  report.residual = report.friction_residual = node.friction.residual = 0;
  report.impacts.clear();
  report.impulses.clear();
  report.friction.clear();
  report.contacts.clear();
  node.closing.clear();
  report.settlings.clear();
  report.certificates.clear();
  flight.settlings.clear();
  if (!last_is_valid || !(state == last) || node.pool.is_full()) start(state);
  last_is_valid = false;  // until this step is done
  const double t_start = state.t, h = options.h;
  for (double left = h; left > 0;) {
    fly_one_arc(left);
    left = flight.arc.tau < left ? left - flight.arc.tau : 0;
    if (flight.active > 0 && left < no_duration * h) left = 0;
    arrive(t_start + (h - left));
  }
  finish();
  state = last;
}

void Stepper::Impl::start(const State& state) {
  check_vector(state.q, model.n_q(), "state.q");
  check_vector(state.p, model.n_q(), "state.p");
  if (!std::isfinite(state.t)) throw ModelError("state.t is not finite");
  last_is_valid = false;
  last = state;
  flight.history.clear();
  flight.has_rate = false;
  node.launch.pending = false;
  start_anew(node.broad);
  start_anew(flight.broad);
  if (node.pool.is_full()) forget_pairs(node);
  std::fill(node.held.begin(), node.held.end(), 0);
  ++node.friction.flight;  // what friction did before is no guess
  node.t = state.t;
  node.q = state.q;
  node.p = state.p;
  node.v.setZero();
  if (!find_contacts(*model, options, node)) fail(FlightOutcome::not_converged);
  check_overlap();
  if (impact_pending(node)) arrive(state.t);
}

void Stepper::Impl::check_overlap() const {
  std::ostringstream text;
  int found = 0;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    // 100 touches (1e-8 of the shapes' size): what a state written with 8 digits loses
    if (c.phi >= -100 * node.pool[c.pair].touch) continue;
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
  if (flight.active > 0) {
    report.friction_residual = std::max(report.friction_residual, flight.slip.residual);
  }
  ++report.arcs;
  report.sustained += flight.active;
  tell_holds(node, flight, report);
  flight.history.add(node.t + flight.arc.tau / 2, flight.arc.v);
}

// Ends the arc at a node, and resolves the impact there if there is one.
void Stepper::Impl::arrive(double t) {
  if (t > node.t || report.arcs > 0) {
    if (!arrive_at_node(*model, options, t, flight, node)) fail(FlightOutcome::not_converged);
    tell_closing(node, report);
    report.friction_residual = std::max(report.friction_residual, node.friction.residual);
    if (!(node.friction.residual <= large_residual)) {
      flight.closing = node.contacts[node.friction.contact[0]].pair;
      fail(FlightOutcome::friction_not_settled);
    }
  }
  if (!impact_pending(node)) return;
  if (static_cast<int>(report.impacts.size()) == options.max_impacts) fail_impacts();
  if (!resolve_node_impact(*model, options, conserved_energy(), node, report)) fail_jammed();
  flight.history.clear();
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
    flight.active = 0;
    flight.arc.v = node.v;
    if (!solve_flight_arc(*model, options, 0, node, flight)) fail(FlightOutcome::not_converged);
  }
  flight.n = node.q - flight.arc.tau * flight.arc.v;  // where the arc started
  const ArcProblem problem{flight.n, node.p, flight.arc.tau, {}, whole_step(options)};
  return arc_energy(*model, problem, flight.arc, flight.scratch);
}

// A launch that is pending at the end of the step is an arc of no duration: H(q, p+) = E_d.
void Stepper::Impl::finish() {
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

std::string Stepper::Impl::contact_list() const {
  std::vector<std::string> names;
  for (int i = 0; i < node.touching; ++i)
    names.push_back(model.pair_name(node.pool.number(node.contacts[i].pair)));
  return list_names(names);
}

/// The joint that is nearest to where its yaw and roll are one, if any is within half a radian.
std::string Stepper::Impl::singular_joint() const {
  std::ostringstream text;
  double least = 0.5;
  for (const JointInfo& joint : model->joints) {
    if (joint.type != JointType::floating && joint.type != JointType::spherical) continue;
    const double pitch = node.q[joint.coordinates[joint.coordinates.size() - 2]];
    if (!(std::abs(std::cos(pitch)) < least)) continue;
    least = std::abs(std::cos(pitch));
    text.str("");
    text << "; joint \"" << joint.name << "\" is at pitch = " << pitch
         << " rad, and singular at +-90 deg";
  }
  return text.str();
}

void Stepper::Impl::fail(FlightOutcome outcome) const {
  std::ostringstream text;
  const Arc& arc = flight.arc;
  switch (outcome) {
    case FlightOutcome::too_many_contacts:
      text << "more than " << most_constraints
           << " sustained contacts (three each where they stick) at t = " << node.t
           << " s: " << contact_list();
      break;
    case FlightOutcome::impact_not_located:
      text << "the time after t = " << node.t << " s at which "
           << model.pair_name(node.pool.number(flight.closing)) << " closes was not found";
      break;
    case FlightOutcome::friction_not_settled:
      text << "friction at t = " << node.t
           << " s: " << model.pair_name(node.pool.number(flight.closing))
           << " neither sticks nor slides, a smaller h helps where it turns fast";
      break;
    case FlightOutcome::no_progress:
      text << "contacts at t = " << node.t
           << " s keep closing and opening within one arc: " << contact_list();
      break;
    default:
      text << "DEL residual " << arc.residual << " after " << arc.iterations
           << " iterations at t = " << node.t << " s, arc of " << arc.tau
           << " s; a smaller h helps where the motion is fast, h = " << options.h << " s";
      text << singular_joint();
  }
  throw StepError(text.str(), node.t, arc.residual, arc.iterations);
}

void Stepper::Impl::fail_jammed() {
  set_contact_matrix(*model, node);
  if (has_friction(node) && can_open(node)) {
    flight.closing = node.contacts[0].pair;
    fail(FlightOutcome::friction_not_settled);
  }
  std::ostringstream text;
  text << "the impact at t = " << node.t << " s does not end within " << options.max_impulses
       << " impulses: "
       << (can_open(node) ? "more may do (max_impulses) at "
                          : "no motion opens all of, jammed are ")
       << contact_list();
  throw JammedError(text.str(), node.t, flight.arc.residual, options.max_impulses);
}

void Stepper::Impl::fail_impacts() const {
  std::ostringstream text;
  text << "more than " << options.max_impacts << " impacts in the step from t = " << last.t
       << " s, at t = " << node.t << " s between " << contact_list()
       << "; a smaller h, or a larger max_impacts if this is meant";
  throw StepError(text.str(), node.t, flight.arc.residual, options.max_impacts);
}

}  // namespace saltus
