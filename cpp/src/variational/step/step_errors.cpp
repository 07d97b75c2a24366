// What a step that fails says.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "saltus/model/close_loops.hpp"
#include "saltus/tree/coordinates.hpp"
#include "variational/step/stepper_impl.hpp"

namespace saltus {

std::string Stepper::Impl::name_of(int slot) const {
  if (slot >= 0) return scene.shared.pair_name(pool.number(slot));
  // of a row that is a joint with dry friction: -2 - k
  const Contact& row = node.dry[static_cast<std::size_t>(-2 - slot)];
  int velocity = 0;
  for (int c = 0; c < scene.model.tree.n_v; ++c) {
    if (dot(scene.trees, row.n, VecX::Unit(scene.model.tree.n_v, c)) != 0) velocity = c;
  }
  return "the dry friction of " + scene.model.velocity_names[static_cast<std::size_t>(velocity)];
}

std::string Stepper::Impl::contact_list() const {
  std::vector<std::string> names;
  for (int i = 0; i < node.touching; ++i) names.push_back(name_of(node.contacts[i].slot));
  return list_names(names);
}

/// What the arc is held by.
std::string Stepper::Impl::held_list() const {
  std::vector<std::string> names;
  for (const int i : flight.work.rows.active) {
    names.push_back(name_of(flight.work.rows.row[i].slot));
  }
  return names.empty() ? "" : ", held by " + list_names(names);
}

/// The ball joint that turns farthest in an arc, if it is half a turn or more.
std::string Stepper::Impl::fast_joint() const {
  const FastestTurn fastest = fastest_turn(scene.model.tree, node.v, flight.work.arc.tau);
  if (!(fastest.angle > std::numbers::pi)) return {};
  const int velocity = scene.model.tree.balls[fastest.ball].velocity;
  std::ostringstream text;
  for (const JointInfo& joint : scene.model.joints) {
    const auto& own = joint.velocities;
    if (std::find(own.begin(), own.end(), velocity) == own.end()) continue;
    text << "; joint \"" << joint.name << "\" turns by " << fastest.angle << " rad in one arc of "
         << flight.work.arc.tau << " s, and can by less than 2 pi";
  }
  return text.str();
}

/// Where loops are: they may contradict each other, or what is told.
std::string Stepper::Impl::loops_in_words() const {
  if (!node.loops.some) return {};
  std::vector<std::string> names;
  for (const Equality& each : scene.model.equalities.all) names.push_back(each.name);
  return "; with the loops " + list_names(names) + ", which may contradict each other";
}

namespace {

/// Independent rows of the loops at q; the last that depends on others in `weak`.
Eigen::Index rank_of_loops(const ModelData& model, const VecX& q, double t, int& weak) {
  const EqualityValues values = loop_values(model, q, t);
  Eigen::ColPivHouseholderQR<MatX> qr(model.tree.n_v, model.equalities.rows);
  qr.setThreshold(1e-6);
  qr.compute(values.A);
  weak = qr.colsPermutation().indices()[std::min(qr.rank(), values.A.cols() - 1)];
  return qr.rank();
}

}  // namespace

/// A loop that has more freedom here than beside it, if one has.
std::string Stepper::Impl::weak_loop() const {
  if (!node.loops.some) return {};
  const ModelData& model = scene.model;
  VecX q = node.q, step(model.tree.n_v);
  for (Eigen::Index i = 0; i < step.size(); ++i) step[i] = 1e-2 * (1 + 0.1 * double(i % 7));
  integrate(model.tree, node.q, 1, step, q);
  try {  // only where the loops are closed their rows depend on each other as they do here
    q = close_loops(scene.shared, q, {}, node.t);
  } catch (const ModelError&) {
    return {};
  }
  int weak = -1, other = -1;
  if (rank_of_loops(model, node.q, node.t, weak) >= rank_of_loops(model, q, node.t, other)) {
    return {};
  }
  return "; loop \"" + equality_of(model, weak).name +
         "\" is where two motions branch: its rows depend on each other here, and nothing says "
         "which is the motion";
}

/// No impulse keeps the two apart.
void Stepper::Impl::fail_driven() {
  halves_help = blames_contact = false;
  std::ostringstream text;
  text << name_of(node.driven_together) << " closes at t = " << node.t
       << " s, and loops or prescribed motions drive it on";
  raise(text.str(), "let the motion end before, or exclude the pair", 0);
}

/// A step that fails: why, and what may help if shorter arcs have not been tried.
void Stepper::Impl::raise(const std::string& why, const std::string& advice, int count) {
  cause = why;
  throw StepError(why + "; " + advice, node.t, flight.work.arc.residual, count);
}

/// Rebounds that no end is found of may be left out where some contact takes energy anyhow.
bool Stepper::Impl::loses_energy() const {
  return std::any_of(node.contacts.begin(), node.contacts.begin() + node.touching,
                     [](const Contact& c) { return c.restitution < 1; });
}

void Stepper::Impl::fail(FlightOutcome outcome) {
  if (outcome == FlightOutcome::law_not_met) {
    fail_law(flight.work.unlawful, flight.work.rows.residual);
  }
  halves_help = true;
  blames_contact = outcome != FlightOutcome::not_converged || !flight.work.rows.active.empty();
  std::ostringstream text, h;
  h << "h = " << scene.options.h << " s";
  const Arc& arc = flight.work.arc;
  switch (outcome) {
    case FlightOutcome::impact_not_located:
      text << "the time after t = " << node.t << " s at which " << name_of(flight.closing)
           << " closes was not found";
      break;
    case FlightOutcome::no_progress:
      text << "contacts at t = " << node.t
           << " s keep closing and opening within one arc: " << contact_list();
      break;
    default:
      text << "DEL residual " << arc.residual << " after " << arc.iterations
           << " iterations at t = " << node.t << " s, arc of " << arc.tau << " s" << held_list()
           << fast_joint() << loops_in_words() << weak_loop();
  }
  raise(text.str(), "a smaller h helps where the motion is fast, " + h.str(), arc.iterations);
}

void Stepper::Impl::fail_law(int slot, double residual) {
  halves_help = blames_contact = true;
  std::ostringstream text;
  text << "contact at t = " << node.t << " s: " << name_of(slot)
       << (has_friction(node) ? " neither sticks nor slides, it is off Coulomb's law by "
                              : " neither opens nor is pressed, it is off the law by ")
       << residual << " of the largest impulse" << fast_joint();
  raise(text.str(), "a smaller h helps where it turns fast", flight.work.arc.iterations);
}

/// The error of the step as a whole: of the first attempt, and that shorter arcs were no help.
void Stepper::Impl::fail_at_last(const std::exception_ptr& first, const std::string& why) const {
  if (!(longest < scene.options.h)) std::rethrow_exception(first);
  try {
    std::rethrow_exception(first);
  } catch (const StepError& error) {
    std::ostringstream text;
    text << why << "; arcs of " << longest << " s fail as well";
    throw StepError(text.str(), error.t, error.residual, error.iterations);
  }
}

void Stepper::Impl::fail_jammed() {
  const int most = scene.options.max_impulses;
  std::ostringstream text;
  text << "the impact at t = " << node.t << " s does not end within " << most << " impulses: ";
  const bool opens = can_open(scene, node, impact);
  if (has_friction(node) && opens) {
    const auto begin = node.contacts.begin(), last_one = begin + node.touching;
    const auto fastest = std::min_element(
        begin, last_one, [](const Contact& a, const Contact& b) { return a.u < b.u; });
    blames_contact = true;
    text << "with friction " << name_of(fastest->slot) << " keeps approaching, with " << -fastest->u
         << " m/s before it";
    raise(text.str(), "more may do (max_impulses), or a restitution of 0", most);
  }
  blames_contact = loses_energy();
  text << (opens ? "more may do (max_impulses) at " : "no motion opens all of, jammed are ")
       << contact_list();
  cause = text.str();
  throw JammedError(cause, node.t, flight.work.arc.residual, most);
}

void Stepper::Impl::fail_impacts() {
  blames_contact = loses_energy();
  std::ostringstream text;
  text << "more than " << most_impacts() << " impacts in the step from t = " << last.t
       << " s, at t = " << node.t << " s between " << contact_list();
  raise(text.str(), "a smaller h, or a larger max_impacts if this is meant", most_impacts());
}

void Stepper::Impl::fail_energy(double gain) {
  halves_help = true;
  blames_contact = !flight.work.rows.active.empty();
  std::ostringstream text, h;
  text << "an arc by t = " << node.t << " s gains " << gain << " J to its kinetic " << kinetic
       << " J" << (blames_contact ? ", and contacts do no work" : "")
       << ": its equation was solved by another motion" << held_list();
  h << "a smaller h helps, h = " << scene.options.h << " s";
  raise(text.str(), h.str(), flight.work.arc.iterations);
}

void Stepper::Impl::fail_sinking(const Contact& contact) {
  halves_help = blames_contact = true;
  std::ostringstream text, h;
  text << name_of(contact.slot);
  const int pair = node.pool.number(contact.slot);
  if (scene.model.is_limit(pair)) {
    const int coordinate = scene.model.limit(pair).coordinate;
    const Unit unit = scene.model.coordinates[static_cast<std::size_t>(coordinate)].unit;
    text << " is passed by " << -contact.phi << (unit == Unit::metre ? " m" : " rad");
  } else {
    text << " overlap by " << -contact.phi << " m";
  }
  text << " where the arc up to t = " << node.t << " s ends";
  h << "a smaller h helps, h = " << scene.options.h << " s";
  raise(text.str(), h.str(), flight.work.arc.iterations);
}

void Stepper::Impl::fail_arcs() {
  halves_help = blames_contact = true;
  if (!scene.options.strict) ++grazes;
  std::ostringstream text;
  text << report.arcs << " arcs but " << report.impacts.size()
       << " impacts in the step from t = " << last.t << " s, the last arc of "
       << flight.work.arc.tau << " s at t = " << node.t << " s";
  if (flight.closing >= 0) {
    text << "; sought last was when " << name_of(flight.closing) << " closes";
  }
  raise(text.str(), "a smaller h or a slightly other start may pass by", report.arcs);
}

void Stepper::Impl::fail_work() {
  blames_contact = true;
  std::ostringstream text;
  text << report.iterations << " Newton iterations in " << report.arcs << " arcs and "
       << report.impacts.size() << " impacts of the step from t = " << last.t
       << " s, by t = " << node.t << " s";
  raise(text.str(), "a smaller h, or a larger max_impacts, whose tenfold is the bound",
        report.iterations);
}

}  // namespace saltus
