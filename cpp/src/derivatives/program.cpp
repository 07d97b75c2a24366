#include "derivatives/program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {
namespace {

using Kind = StepProgram::Kind;

template <class T>
T& next_of(const ModelData& model, std::vector<std::unique_ptr<T>>& pool, int& used) {
  if (used == static_cast<int>(pool.size())) pool.push_back(std::make_unique<T>(model));
  return *pool[static_cast<std::size_t>(used++)];
}

Passing& next_passing(StepProgram& program) {
  if (program.n_passings == static_cast<int>(program.passings.size())) {
    program.passings.emplace_back();
  }
  return program.passings[static_cast<std::size_t>(program.n_passings++)];
}

/// b of an arc: what its end changes by with its duration.
void set_arrival(const ModelData& model, FlownArc& arc, const VecX& zero, Tangent& b) {
  b.q = zero;
  b.p = zero;
  b.energy = b.h = 0;
  push_flown(model, arc, zero, 1, {}, b);
}

/// A force that is a function of time has a derivative by time that nobody tells. Of what is
/// prescribed the acceleration may be told; nothing here asks for it.
void note_time(const ModelData& model, StepProgram& program) {
  program.tells_time = model.forces.functions.empty();
  if (!program.tells_time) {
    program.timed_kind = "force";
    program.timed = model.forces.functions.front().name;
    return;
  }
  for (const Equality& e : model.equalities.all) {
    if (e.type != LoopType::prescribed) continue;
    program.tells_time = false;
    program.timed_kind = "joint";
    program.timed = e.name;
  }
}

/// The impulses told are those that the step made.
void check_impulses(const TapeImpact& told, const ImpactPieces& impact) {
  double size = 0;
  for (const TapeImpulse& each : told.impulses) size = std::max(size, each.lambda);
  for (std::size_t k = 0; k < told.impulses.size(); ++k) {
    // rounding of the cascade; more is another law than the one differentiated
    if (std::abs(told.impulses[k].lambda - impact.impulses[k].lambda) <= 1e-6 * size) continue;
    throw ModelError("the step has no derivative yet: an impact at t = " + std::to_string(told.t) +
                     " s is not the cascade of its contacts");
  }
}

/// All at once: which gap moves the instant is that of the arc, or of the fastest.
void set_together(const ModelData& model, const Tape& tape, const TapeImpact& told, int pair,
                  const VecX& p_after, ImpactPieces& impact) {
  impact.kick.contacts.clear();
  for (const TapeImpulse& each : told.impulses) {
    if (!(each.lambda > 0)) continue;
    TapeRow row;
    row.pair = told.contacts[static_cast<std::size_t>(each.contact)].pair;
    row.friction = told.contacts[static_cast<std::size_t>(each.contact)].friction;
    row.axis = each.axis;
    row.P = each.P;
    impact.kick.contacts.push_back(contact_of(model, row));
  }
  impact.first = 0;
  for (std::size_t i = 0; i < told.contacts.size(); ++i) {
    const auto first = static_cast<std::size_t>(impact.first);
    if (told.contacts[i].pair == pair) {
      impact.first = static_cast<int>(i);
      break;
    }
    if (told.contacts[i].u < told.contacts[first].u) impact.first = static_cast<int>(i);
  }
  impact.p_after = p_after;
  if (impact.arrival.q.size() > 0) {
    impact.flow = impact.arrival;
  } else {
    set_flow(model, tape, told.p, impact.node, impact.flow);
  }
  impact.slope = impact.node.gaps[static_cast<std::size_t>(impact.first)].n.dot(impact.flow.q);
  Tangent after;
  set_flow(model, tape, impact.p_after, impact.node, after);
  set_kick(model, impact.node.q, impact.node.motion, impact.kick);
}

bool has_friction(const TapeImpact& told) {
  return std::any_of(told.contacts.begin(), told.contacts.end(),
                     [](const TapeContact& c) { return c.friction > 0; });
}

void set_rubbing(const ModelData& model, const Tape& tape, const TapeImpact& told,
                 ImpactPieces& impact) {
  impact.p_after = told.p;
  for (const TapeImpulse& each : told.impulses) {
    impact.rubbing.emplace_back();
    FrictionDerivative& to = impact.rubbing.back();
    set_friction_impulse(model, tape, told, each, impact.p_after, impact.node, to);
    if (impact.rubbing.size() > 1 || impact.arrival.q.size() == 0) continue;
    to.flow = impact.arrival;
    to.slope = impact.node.gaps[static_cast<std::size_t>(to.contact)].n.dot(to.flow.q);
  }
}

/// @param arrival the arc that a gap ended here, of pair `pair`; or nullptr
void add_impact(const ModelData& model, const Tape& tape, const TapeImpact& told, FlownArc* arrival,
                int pair, const VecX& p_after, StepProgram& program) {
  program.pieces.push_back({Kind::impact, program.n_impacts, 0});
  ImpactPieces& impact = next_of(model, program.impacts, program.n_impacts);
  set_node(model, tape, told, impact.node);
  impact.p_before = told.p;
  impact.arrival.q.resize(0);
  if (arrival != nullptr) set_arrival(model, *arrival, program.zero, impact.arrival);
  impact.is_together = told.is_together;
  impact.impulses.clear();
  impact.rubbing.clear();
  if (told.is_together) return set_together(model, tape, told, pair, p_after, impact);
  if (has_friction(told)) return set_rubbing(model, tape, told, impact);
  std::vector<int> order;
  for (const TapeImpulse& each : told.impulses) order.push_back(each.contact);
  set_impulses(model, tape, order, impact);
  check_impulses(told, impact);
}

void add_passing(const ModelData& model, const TapeArc& arc, FlownArc& arrival,
                 StepProgram& program) {
  program.pieces.push_back({Kind::pass, program.n_passings, 0});
  Passing& to = next_passing(program);
  to.pair = arc.pair;
  to.kin = Kinematics(model.tree);
  set_configuration(model.tree, arc.q_end, to.kin);
  set_gap_derivative(model, to.kin, arc.pair, to.gap);
  set_arrival(model, arrival, program.zero, to.arrival);
  to.slope = to.gap.n.dot(to.arrival.q);
}

const TapeArc* arc_of(const Tape& tape, std::size_t piece) {
  if (piece >= tape.pieces.size() || !tape.pieces[piece].is_arc) return nullptr;
  return &tape.arcs[static_cast<std::size_t>(tape.pieces[piece].index)];
}

/// Where the next piece starts.
const VecX& momenta_after(const Tape& tape, std::size_t piece) {
  const TapeArc* next = arc_of(tape, piece + 1);
  return next != nullptr ? next->p : tape.p_end;
}

void add_arc(const ModelData& model, const Tape& tape, std::size_t piece, StepProgram& program) {
  const TapeArc& told = *arc_of(tape, piece);
  const Kind kind = told.end == TapeArc::End::step   ? Kind::rest
                    : told.end == TapeArc::End::part ? Kind::part
                                                     : Kind::to_gap;
  program.pieces.push_back({kind, program.n_arcs, told.part});
  FlownArc& arc = next_of(model, program.arcs, program.n_arcs);
  set_flown_arc(model, tape, told, arc);
  program.has_rest = kind != Kind::rest;
  if (kind != Kind::to_gap) return;
  check_time(program, "through an impact");
  const bool is_impact = piece + 1 < tape.pieces.size() && !tape.pieces[piece + 1].is_arc;
  if (!is_impact) add_passing(model, told, arc, program);
}

bool has_match(const Tape& tape) {
  return std::any_of(tape.arcs.begin(), tape.arcs.begin() + tape.n_arcs,
                     [](const TapeArc& arc) { return arc.matched >= 0; });
}

/// The last motion, along which time is left at the end of the step.
void set_motion(const ModelData& model, const Tape& tape, StepProgram& program) {
  if (!program.has_rest) return;
  ImpactPieces scratch(model);
  scratch.node.t = tape.t + tape.h;
  scratch.node.q = tape.q_end;
  set_node_derivative(model, tape, scratch.node.t, tape.q_end, program.zero, scratch.node.motion);
  set_flow(model, tape, tape.p_end, scratch.node, program.motion);
}

}  // namespace

void check_time(const StepProgram& program, const std::string& what) {
  if (program.tells_time) return;
  const std::string is =
      program.timed_kind == "force" ? "may be a function of time" : "moves as it is told";
  throw ModelError("the step has no derivative " + what + ": " + program.timed_kind + " \"" +
                       program.timed + "\" " + is + ", and does not tell its derivative by it",
                   program.timed_kind, program.timed);
}

void set_impulses(const ModelData& model, const Tape& tape, const std::vector<int>& contacts,
                  ImpactPieces& impact) {
  impact.impulses.resize(contacts.size());
  impact.p_after = impact.p_before;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    ImpulseDerivative& to = impact.impulses[k];
    set_impulse(model, tape, contacts[k], impact.p_after, impact.node, to);
    if (k > 0 || impact.arrival.q.size() == 0) continue;
    to.flow = impact.arrival;
    to.slope = impact.node.gaps[static_cast<std::size_t>(to.contact)].n.dot(to.flow.q);
  }
}

void set_program(const ModelData& model, const Tape& tape, StepProgram& program) {
  if (!tape.refusal.empty()) {
    throw ModelError("the step has no derivative yet: it has " + tape.refusal);
  }
  program.pieces.clear();
  program.start = {};
  program.has_match = has_match(tape);
  if (program.has_match && tape.law == ImpactLaw::shadow_energy) {
    set_shadow_gradient(model, tape.q, tape.p, tape.h, program.start);
  } else if (program.has_match && !tape.pieces.front().is_arc) {
    set_energy_gradient(model, tape, tape.q, tape.p, program.start);
  }
  program.n_arcs = program.n_impacts = program.n_passings = 0;
  program.has_rest = true;
  program.zero.setZero(model.tree.n_v);
  list_rubbing(tape, program.friction.pairs);
  note_time(model, program);
  for (std::size_t k = 0; k < tape.pieces.size(); ++k) {
    if (tape.pieces[k].is_arc) {
      add_arc(model, tape, k, program);
      continue;
    }
    const TapeArc* before = k > 0 ? arc_of(tape, k - 1) : nullptr;
    const bool arrives = before != nullptr && before->end == TapeArc::End::gap;
    FlownArc* arc =
        arrives ? program.arcs[static_cast<std::size_t>(program.n_arcs - 1)].get() : nullptr;
    check_time(program, "through an impact");
    add_impact(model, tape, tape.impacts[static_cast<std::size_t>(tape.pieces[k].index)], arc,
               before != nullptr ? before->pair : -1, momenta_after(tape, k), program);
    program.has_rest = true;
  }
  set_motion(model, tape, program);
}

}  // namespace saltus
