// What a step that fails says.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "variational/step/stepper_impl.hpp"

namespace saltus {

std::string Stepper::Impl::contact_list() const {
  std::vector<std::string> names;
  for (int i = 0; i < node.touching; ++i)
    names.push_back(model.pair_name(node.pool.number(node.contacts[i].pair)));
  return list_names(names);
}

/// What the arc is held by.
std::string Stepper::Impl::held_list() const {
  std::vector<std::string> names;
  for (const int i : flight.rows.active) {
    names.push_back(model.pair_name(node.pool.number(flight.rows.row[i].place)));
  }
  return names.empty() ? "" : ", held by " + list_names(names);
}

/// The ball joint that turns farthest in an arc, if it is half a turn or more.
std::string Stepper::Impl::fast_joint() const {
  const FastestTurn fastest = fastest_turn(model->tree, node.v, flight.arc.tau);
  if (!(fastest.angle > std::numbers::pi)) return {};
  const int velocity = model->tree.balls[fastest.ball].velocity;
  std::ostringstream text;
  for (const JointInfo& joint : model->joints) {
    const auto& own = joint.velocities;
    if (std::find(own.begin(), own.end(), velocity) == own.end()) continue;
    text << "; joint \"" << joint.name << "\" turns by " << fastest.angle << " rad in one arc of "
         << flight.arc.tau << " s, and can by less than 2 pi";
  }
  return text.str();
}

void Stepper::Impl::fail(FlightOutcome outcome) {
  halves_help = true;
  std::ostringstream text;
  const Arc& arc = flight.arc;
  switch (outcome) {
    case FlightOutcome::impact_not_located:
      text << "the time after t = " << node.t << " s at which "
           << model.pair_name(node.pool.number(flight.closing)) << " closes was not found";
      break;
    case FlightOutcome::law_not_met:
      text << "contact at t = " << node.t
           << " s: " << model.pair_name(node.pool.number(flight.closing))
           << (has_friction(node) ? " neither sticks nor slides, it is off Coulomb's law by "
                                  : " neither opens nor is pressed, it is off the law by ")
           << flight.rows.residual
           << " of the largest impulse; a smaller h helps where it turns fast" << fast_joint();
      break;
    case FlightOutcome::no_progress:
      text << "contacts at t = " << node.t
           << " s keep closing and opening within one arc: " << contact_list();
      break;
    default:
      text << "DEL residual " << arc.residual << " after " << arc.iterations
           << " iterations at t = " << node.t << " s, arc of " << arc.tau << " s" << held_list()
           << "; a smaller h helps where the motion is fast, h = " << options.h << " s"
           << fast_joint();
  }
  throw StepError(text.str(), node.t, arc.residual, arc.iterations);
}

/// The error of the step as a whole, and that shorter arcs were no help if they were tried.
void Stepper::Impl::fail_at_last(const std::exception_ptr& first) const {
  if (!(longest < options.h)) std::rethrow_exception(first);
  try {
    std::rethrow_exception(first);
  } catch (const StepError& error) {
    std::ostringstream text;
    text << error.what() << "; arcs of " << longest << " s fail as well";
    throw StepError(text.str(), error.t, error.residual, error.iterations);
  }
}

void Stepper::Impl::fail_jammed() {
  set_contact_matrix(*model, node);
  if (has_friction(node) && can_open(node)) {
    const auto begin = node.contacts.begin(), end = begin + node.touching;
    const auto fastest =
        std::min_element(begin, end, [](const Contact& a, const Contact& b) { return a.u < b.u; });
    flight.closing = fastest->pair;
    fail(FlightOutcome::law_not_met);
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

void Stepper::Impl::fail_energy(double gain) {
  halves_help = true;
  std::ostringstream text;
  text << "the arc up to t = " << node.t << " s gains " << gain << " J to its kinetic " << kinetic
       << " J, and contacts do no work: its equation was solved by another motion" << held_list()
       << "; a smaller h helps, h = " << options.h << " s";
  throw StepError(text.str(), node.t, flight.arc.residual, flight.arc.iterations);
}

void Stepper::Impl::fail_sinking(const Contact& contact) {
  halves_help = true;
  std::ostringstream text;
  text << model.pair_name(node.pool.number(contact.pair)) << " overlap by " << -contact.phi
       << " m where the arc up to t = " << node.t << " s ends; a smaller h helps, h = " << options.h
       << " s";
  throw StepError(text.str(), node.t, flight.arc.residual, flight.arc.iterations);
}

void Stepper::Impl::fail_arcs() {
  halves_help = true;
  std::ostringstream text;
  text << report.arcs << " arcs but " << report.impacts.size()
       << " impacts in the step from t = " << last.t << " s, the last arc of " << flight.arc.tau
       << " s at t = " << node.t << " s";
  if (flight.closing >= 0) {
    text << "; sought last was when " << model.pair_name(node.pool.number(flight.closing))
         << " closes";
  }
  text << "; a smaller h or a slightly other start may pass by";
  throw StepError(text.str(), node.t, flight.arc.residual, report.arcs);
}

}  // namespace saltus
