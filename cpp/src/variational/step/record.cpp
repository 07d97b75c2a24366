// Writes the tape of a step, where one is asked for.
#include "variational/step/stepper_impl.hpp"

namespace saltus {
namespace {

template <class T>
T& next_of(std::vector<T>& pool, int& used) {
  if (used == static_cast<int>(pool.size())) pool.emplace_back();
  return pool[static_cast<std::size_t>(used++)];
}

}  // namespace

void Stepper::Impl::refuse(const char* why) {
  if (recorded && recorded->refusal.empty()) recorded->refusal = why;
}

void Stepper::Impl::start_tape(const State& state) {
  if (!recorded) return;
  Tape& tape = *recorded;
  tape.pieces.clear();
  tape.n_arcs = tape.n_impacts = 0;
  tape.refusal.clear();
  tape.is_whole = false;
  tape.t = state.t;
  tape.h = scene.options.h;
  tape.q = last.q;
  tape.p = last.p;
  tape.input = input;
}

/// A row as it was held.
void Stepper::Impl::record_row(const Row& row, double lambda, TapeRow& to) {
  to.pair = pool.number(row.slot);
  to.is_frozen = row.is_frozen;
  to.lambda = lambda;
  if (!row.is_frozen) return;
  to.frozen = row.frozen;
  if (std::holds_alternative<Rim>(row.pair->kind)) refuse("a rim that is held at a point");
}

/// Of the arc just flown, whose node has not been left yet.
/// @param asked [s] its longest duration; @param left [s] of the step
void Stepper::Impl::record_arc(double asked, double left, const Launch* launch) {
  if (!recorded) return;
  Tape& tape = *recorded;
  const ArcWork& work = flight.work;
  tape.pieces.push_back({true, tape.n_arcs});
  TapeArc& to = next_of(tape.arcs, tape.n_arcs);
  to.t = node.t;
  to.tau = work.arc.tau;
  to.pair = -1;
  if (work.arc.tau < asked) {
    to.end = TapeArc::End::gap;
    to.pair = flight.ends_at >= 0 ? pool.number(flight.ends_at) : -1;
  } else {
    to.end = asked < left ? TapeArc::End::part : TapeArc::End::step;
    to.part = asked / scene.options.h;
  }
  to.q = node.q;
  to.p = node.p;
  to.v = work.arc.v;
  to.shift = work.scratch.shift;
  if (launch != nullptr && work.line.use != LaunchLine::Use::none) {
    refuse("an impact whose law matches energies");
  }
  to.n_held = to.n_kick = 0;
  for (const int i : work.rows.active) {
    const Row& row = work.rows.row[static_cast<std::size_t>(i)];
    if (row.is_joint()) {
      refuse("joints with dry friction");
    } else if (row.is_pressed()) {
      if (contact_of(node, row).friction > 0) {
        refuse("contacts with friction that are held");
      }
      record_row(row, row.p[0], next_of(to.held, to.n_held));
    }
  }
  if (work.scratch.loops) refuse("loops");
  if (!flight.settlings.empty()) refuse("bounces that come to rest within the step");
}

/// Where that arc ended, as the next one starts.
void Stepper::Impl::record_end() {
  if (!recorded) return;
  TapeArc& to = recorded->arcs[static_cast<std::size_t>(recorded->n_arcs - 1)];
  to.q_end = node.q;
  to.p_end = node.p;
  if (node.q != flight.work.arc.q_end) refuse("overlap that was moved apart");
  const Rows& rows = flight.work.rows;
  for (std::size_t k = 0; rows.count > 0 && k < kick.contacts.size(); ++k) {
    const Contact& c = *kick.contacts[k];
    if (c.bound > 0 || !(kick.p[k][0] > 0)) continue;
    if (c.friction > 0) refuse("contacts with friction that are held");
    for (int i = 0; i < rows.count; ++i) {
      const Row& row = rows.row[static_cast<std::size_t>(i)];
      if (row.slot != c.slot) continue;
      record_row(row, kick.p[k][0], next_of(to.kick, to.n_kick));
    }
  }
}

/// Of an impact that is to be resolved at the node.
void Stepper::Impl::record_contacts() {
  if (!recorded) return;
  Tape& tape = *recorded;
  tape.pieces.push_back({false, tape.n_impacts});
  TapeImpact& to = next_of(tape.impacts, tape.n_impacts);
  to.t = node.t;
  to.q = node.q;
  to.p = node.p;
  to.v = node.v;
  to.contacts.clear();
  to.impulses.clear();
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    to.contacts.push_back({pool.number(c.slot), c.u, c.epsilon_u, c.restitution, c.friction});
    if (c.friction > 0) refuse("an impact with friction");
  }
}

/// And of the same, resolved.
void Stepper::Impl::record_impulses() {
  if (!recorded) return;
  TapeImpact& to = recorded->impacts[static_cast<std::size_t>(recorded->n_impacts - 1)];
  to.law = report.impacts.back().law;
  if (scene.options.law == ImpactLaw::custom) {
    refuse("an impact by a law of your own, whose derivatives are not told");
  }
  for (const Impulse& each : impact.impulses) to.impulses.push_back({each.pair, each.lambda});
  const bool is_alone = to.contacts.size() == 1;
  bool all_plastic = true;
  for (const TapeContact& c : to.contacts) all_plastic = all_plastic && c.restitution == 0;
  if (!is_alone && !all_plastic && scene.options.order == ImpactOrder::symmetric) {
    refuse("an impact that is reflected in several contacts together");
  }
  to.is_together = !is_alone && all_plastic;
}

void Stepper::Impl::end_tape() {
  if (!recorded) return;
  recorded->q_end = last.q;
  recorded->p_end = last.p;
  recorded->is_whole = true;
}

void Stepper::record(bool on) {
  if (on && !impl_->recorded) impl_->recorded.emplace();
  if (!on) impl_->recorded.reset();
}

const Tape* Stepper::tape() const {
  return impl_->recorded && impl_->recorded->is_whole ? &*impl_->recorded : nullptr;
}

}  // namespace saltus
