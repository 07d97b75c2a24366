// Writes the tape of a step, where one is asked for.
#include <cmath>

#include "saltus/collision/slip.hpp"
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
  tape.has_settled = false;
  tape.law = scene.options.law;
  tape.is_whole = false;
  tape.t = state.t;
  tape.h = scene.options.h;
  tape.q = last.q;
  tape.p = last.p;
  tape.input = input;
}

/// An arc that meets the energy from before the impact.
void Stepper::Impl::record_match(const Launch& launch, TapeArc& to) {
  const TapeImpact& last_impact =
      recorded->impacts[static_cast<std::size_t>(recorded->n_impacts - 1)];
  const int k = launch.impulse - report.impacts.back().first;
  to.matched = last_impact.impulses[static_cast<std::size_t>(k)].contact;
  to.delta = flight.work.line.lambda;
  if (count_pressed(flight.work.rows) > 0) {
    refuse("contacts that are held after an impact whose law matches energies");
  }
  if (scene.options.law == ImpactLaw::compensated) refuse("the impact law compensated");
}

/// A row as it was held, and pushed with P along its tangents.
void Stepper::Impl::record_row(const Row& row, double friction, const Vec3& P, TapeRow& to) {
  to.pair = pool.number(row.slot);
  to.joint = to.loop = -1;
  to.is_frozen = row.is_frozen;
  to.is_point = row.is_point;
  to.friction = friction;
  to.P = P;
  to.axis = row.axis;
  to.slides = row.slides;
  to.is_along = false;
  if (!row.is_frozen) return;
  to.frozen = row.frozen;
  if (friction > 0) to.t_B = row.t_B;
  to.point_B = row.point_B;
  if (std::holds_alternative<Rim>(row.pair->kind)) refuse("a rim that is held at a point");
  if (row.is_point && std::holds_alternative<Crossing>(row.pair->kind)) {
    refuse("two edges that are held at a point");
  }
}

/// Joint number `dry` of those with dry friction, which slides where it pushes all it can.
void Stepper::Impl::record_joint(int dry, double P, double tau, TapeRow& to) {
  const auto k = static_cast<std::size_t>(dry);
  VecX row = VecX::Zero(scene.model.tree.n_v);
  add(scene.trees, 1, node.dry[k].n, row);
  Eigen::Index velocity = 0;
  row.cwiseAbs().maxCoeff(&velocity);
  to.pair = to.loop = -1;
  to.joint = static_cast<int>(velocity);
  to.is_frozen = to.is_point = to.is_along = false;
  to.friction = 0;
  to.P = Vec3(P, 0, 0);
  to.slides = std::abs(P) >= (1 - 1e-9) * tau / 2 * node.dry_force[k];
}

/// What loops pushed, by rows.
void Stepper::Impl::record_loops(const VecX& P, std::vector<TapeRow>& rows, int& used) {
  for (Eigen::Index k = 0; k < P.size(); ++k) {
    TapeRow& to = next_of(rows, used);
    to.pair = to.joint = -1;
    to.loop = static_cast<int>(k);
    to.is_frozen = to.is_point = to.is_along = to.slides = false;
    to.friction = 0;
    to.P = Vec3(P[k], 0, 0);
  }
}

/// Of the kick that closes the arc: its impulse in the frame that the arc's row has there.
void Stepper::Impl::record_kick(std::size_t k, TapeArc& arc) {
  const Contact& c = *kick.contacts[k];
  const Rows& rows = flight.work.rows;
  for (int i = 0; i < rows.count; ++i) {
    const Row& row = rows.row[static_cast<std::size_t>(i)];
    if (row.slot != c.slot) continue;
    Vec3 P = kick.p[k];
    if (c.friction > 0) {
      const Vec3 push = across(c, kick.p[k]);
      std::array<Vec3, 2> t;
      if (row.is_frozen) {
        const Mat3 R = node.kin.X_WJ(scene.model.tree, row.pair->on_b.joint).R;
        t = {R * row.t_B[0], R * row.t_B[1]};
      } else {
        const Tangents own = tangents(c.n_W, row.axis);
        t = {own.t0, own.t1};
      }
      P = Vec3(kick.p[k][0], push.dot(t[0]), push.dot(t[1]));
    }
    TapeRow& to = next_of(arc.kick, arc.n_kick);
    record_row(row, c.friction, P, to);
    to.is_along = c.friction > 0 && !kick.push[k].isZero(0) && row.is_pressed();
    for (int held = 0; held < arc.n_held; ++held) {
      if (arc.held[static_cast<std::size_t>(held)].pair == to.pair) to.held = held;
    }
    return;
  }
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
  to.matched = -1;
  if (launch != nullptr && work.line.use != LaunchLine::Use::none) record_match(*launch, to);
  to.n_held = to.n_kick = 0;
  for (const int i : work.rows.active) {
    const Row& row = work.rows.row[static_cast<std::size_t>(i)];
    if (row.is_joint()) {
      record_joint(row.dry, row.p[0], work.rows.tau, next_of(to.held, to.n_held));
    } else if (row.is_pressed()) {
      record_row(row, contact_of(node, row).friction, row.p, next_of(to.held, to.n_held));
    }
  }
  if (work.scratch.loops) record_loops(work.scratch.loops->mu, to.held, to.n_held);
  tape.has_settled = tape.has_settled || !flight.settlings.empty();
}

/// Where that arc ended, as the next one starts.
void Stepper::Impl::record_end() {
  if (!recorded) return;
  TapeArc& to = recorded->arcs[static_cast<std::size_t>(recorded->n_arcs - 1)];
  to.q_end = node.q;
  to.p_end = node.p;
  if (node.q != flight.work.arc.q_end) refuse("overlap that was moved apart");
  if (node.loops.some) record_loops(node.loops.impulse, to.kick, to.n_kick);
  if (flight.work.rows.count == 0) return;
  for (std::size_t k = 0; k < kick.contacts.size(); ++k) {
    const Contact& c = *kick.contacts[k];
    if (c.bound > 0) {
      const int dry = -2 - c.slot;
      record_joint(dry, kick.p[k][0], flight.work.rows.tau, next_of(to.kick, to.n_kick));
    } else if (kick.p[k][0] > 0) {
      record_kick(k, to);
    }
  }
}

/// Of an impact that is to be resolved at the node.
void Stepper::Impl::record_contacts() {
  if (!recorded) return;
  Tape& tape = *recorded;
  if (node.loops.some) refuse("an impact of bodies with loops or prescribed motions");
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
  if (has_friction(node) && scene.options.law != ImpactLaw::custom) {
    for (const FrictionImpulse& each : impact.friction.impulses) {
      const Contact& c = node.contacts[static_cast<std::size_t>(each.contact)];
      to.impulses.push_back({each.contact, each.p[0], each.p, tangent_axis(c.n_W)});
    }
  } else {
    for (const Impulse& each : impact.impulses) {
      to.impulses.push_back({each.pair, each.lambda, Vec3(each.lambda, 0, 0), 0});
    }
  }
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
