#include "variational/flight_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "variational/holds.hpp"
#include "variational/impact_time.hpp"
#include "variational/launch.hpp"
#include "variational/slip_blocks.hpp"
#include "variational/slip_law.hpp"

namespace saltus {
namespace {

constexpr int most_rounds = 40;  ///< 2 to 6 are usual

/// What is lawful after so many rounds. Where bodies turn, impulses that hold each other in
/// redundant contacts may go on changing, and keep the arc from its last digits.
double lawful(int round) { return round < 8 ? 1e-11 : round < 20 ? 1e-10 : 10 * small_residual; }

using Kind = ArcConstraint::Kind;

/// Holds (and a launch) first, then what sticks.
/// @return how many come first
int put_sticks_last(Flight& f) {
  int first = 0;
  for (int i = 0; i < f.active; ++i) {
    if (f.constraints[i].kind == Kind::stick) continue;
    if (i != first) std::swap(f.constraints[i], f.constraints[first]);
    ++first;
  }
  return first;
}

/// Impulses along tangents that are no unknowns of the arc.
void sum_carried(const Node& node, Flight& f) {
  f.slip.carries = false;
  f.slip.carried.setZero();
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::hold || c.carried.isZero(0)) continue;
    f.slip.carries = true;
    const auto& t = contact_of(node, c).t;
    for (int k = 0; k < 2; ++k) add(node.trees, c.carried[k], t[k], f.slip.carried);
  }
}

/// Force directions and impulses of a hold that does as c.grip says.
/// @param solved the tangents whose impulse is an unknown, where it sticks
void set_forces(const Node& node, int i, const Vec3& p, const std::array<bool, 2>& solved,
                Flight& f) {
  ArcConstraint& c = f.constraints[i];
  const Contact& contact = contact_of(node, c);
  c.lambda = p[0];
  c.carried.setZero();
  c.n.setZero();
  add(node.trees, 1, contact.n, c.n);
  if (c.grip.mode == Grip::Mode::slides) {
    const Vec3 along = slide_direction(c.grip, contact.friction);
    for (int k = 0; k < 2; ++k) add(node.trees, along[k + 1], contact.t[k], c.n);
  }
  if (c.grip.mode != Grip::Mode::sticks) return;
  for (int k = 0; k < 2; ++k) {
    if (!solved[k]) {
      c.carried[k] = p[k + 1];
      continue;
    }
    ArcConstraint& stick = f.constraints[f.active++];
    stick.kind = Kind::stick;
    stick.place = c.place;
    stick.pair = c.pair;
    stick.in_face = c.in_face;
    if (c.in_face) stick.face = c.face;  // no allocation: room for the deepest is reserved
    stick.axis = c.axis;
    stick.tangent = k;
    stick.lambda = p[k + 1];
    stick.n.setZero();
    add(node.trees, 1, contact.t[k], stick.n);
  }
}

/// All that rests is held, in slip.friction.contact, with its impulses in slip.friction.p. Nothing
/// sticks.
void hold_all(const ModelData& model, int first, Node& node, Flight& f) {
  FrictionScratch& x = f.slip.friction;
  x.contact.clear();
  x.p.clear();
  x.W.own.clear();
  for (int i = 0; i < first; ++i) {
    if (f.constraints[i].kind != Kind::hold) continue;
    x.contact.push_back(i);
    x.p.push_back(impulse_of(node, f.constraints[i], f));
  }
  f.active = first;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests || node.held[c.pair]) continue;
    x.contact.push_back(f.active);
    x.p.push_back(Vec3::Zero());
    hold(model, c.pair, node, f);
  }
}

/// Lets go of what is not pressed.
void release_idle(Node& node, Flight& f) {
  FrictionScratch& x = f.slip.friction;
  double size = 0;
  for (const Vec3& p : x.p) size = std::max(size, p[0]);
  for (std::size_t k = x.contact.size(); k-- > 0;) {
    if (x.p[k][0] > 1e-13 * size) continue;
    const int last = f.active - 1;
    for (int& other : x.contact) {
      if (other == last) other = x.contact[k];
    }
    release(x.contact[k], node, f);
    x.contact[k] = -1;
  }
}

/// Unknowns of what sticks: all tangents, or if they are many those that follow from no others.
void set_grips(const Node& node, Flight& f) {
  FrictionScratch& x = f.slip.friction;
  const bool few = 3 * static_cast<int>(x.contact.size()) <= most_constraints;
  IndependentRates& rates = x.polish.rates;
  rates.start();
  for (int i = 0; i < x.W.size() && !few; ++i) {
    if (x.contact[i] >= 0) rates.take(x.W, i, 0);
  }
  for (int i = 0; i < x.W.size(); ++i) {
    if (x.contact[i] < 0) continue;
    ArcConstraint& c = f.constraints[x.contact[i]];
    c.grip = grip_of(x.u[i], x.p[i], x.W.friction[i], x.W.rest[i]);
    const Mat3& own = x.W.own[i];
    std::array<bool, 2> solved = {};
    for (int k = 1; k < 3 && c.grip.mode == Grip::Mode::sticks; ++k) {
      const bool moves = own(k, k) > 1e-20 * own(0, 0);
      solved[k - 1] = moves && (few || rates.take(x.W, i, k));
    }
    set_forces(node, x.contact[i], x.p[i], solved, f);
  }
  sum_carried(node, f);
}

/// Newton's method for the arc with Coulomb's law in it: linearised, it is settle_pile's problem.
/// @param first how many constraints are none of `stick`
Grips solve_with_law(const ModelData& model, const StepOptions& options, int first, Node& node,
                     Flight& f) {
  FrictionScratch& x = f.slip.friction;
  hold_all(model, first, node, f);
  f.closing = f.constraints[x.contact[0]].place;
  bool is_solved = false;  // that is, the impulses are lawful for the v that belongs to them
  for (int round = 0;; ++round) {
    const Lawlessness now = set_slip_rates(model, options, node, f);
    if (is_solved && f.arc.residual <= 1e-11 && now.least() <= lawful(round)) break;
    if (round == most_rounds || !std::isfinite(now.residual)) return Grips::not_settled;
    if (!set_slip_blocks(model, node, f)) return Grips::not_settled;
    is_solved = lawlessness(x.W, x.u, x.p).least() <= lawful(round);
    if (is_solved) continue;
    f.slip.before = x.p;
    settle_pile(x.W, x.pile, x.u, x.p, 1e-4);  // what it leaves, the next round finds
    for (std::size_t i = 0; i < x.contact.size(); ++i) {
      const Vec3 dp = x.p[i] - f.slip.before[i];
      const SlipRows& row = f.slip.row[i];
      f.arc.v += dp[0] * f.constraints[x.contact[i]].column;
      if (x.W.friction[i] > 0) f.arc.v += dp[1] * row.column0 + dp[2] * row.column1;
    }
    ++f.iterations;
  }
  finish_arc({node.q, f.slip.p, f.arc.tau, {}, whole_step(options)}, f.arc, f.scratch);
  release_idle(node, f);
  set_grips(node, f);
  return Grips::settled;
}

}  // namespace

bool rests_with_friction(const Node& node) {
  if (!node.friction.any) return false;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion == Contact::Motion::rests && c.friction > 0) return true;
  }
  return false;
}

void make_room(const ModelData& model, Node& node, Flight& f) {
  const auto contacts = static_cast<std::size_t>(node.touching);
  const std::size_t wanted = 3 * contacts + 2;  // a launch, and one for prepare_hold
  node.friction.reserve(contacts);
  f.slip.friction.reserve(contacts);
  f.slip.before.reserve(f.slip.friction.contact.capacity());
  f.scratch.many.reserve(static_cast<int>(wanted));
  while (f.constraints.size() < wanted) f.constraints.push_back(fresh_constraint(model));
  while (f.slip.row.size() < f.slip.friction.contact.capacity()) {
    SlipRows row;
    for (VecX* x : {&row.t0, &row.t1, &row.column0, &row.column1}) {
      x->setZero(model.tree.coordinates);
    }
    f.slip.row.push_back(std::move(row));
  }
}

int count_holds(const Flight& f) {
  int count = 0;
  for (int i = 0; i < f.active; ++i) count += f.constraints[i].kind != Kind::stick;
  return count;
}

void start_grips(double left, Node& node, Flight& f) {
  const int flight = node.friction.flight++;
  f.slip.restarted = false;
  const int holds = f.active;
  for (int i = 0; i < holds; ++i) {
    ArcConstraint& c = f.constraints[i];
    const GripMemory& memory = node.friction.memory[c.place];
    if (memory.flight != flight || !(contact_of(node, c).friction > 0)) continue;
    c.grip = memory.grip;
    set_forces(node, i, left / memory.tau * memory.p, memory.solved, f);
  }
  sum_carried(node, f);
}

Grips update_grips(const ModelData& model, const StepOptions& options, Node& node, Flight& f) {
  const int first = put_sticks_last(f);
  if (lawlessness(model, node, f) <= strict) return Grips::settled;
  return solve_with_law(model, options, first, node, f);
}

bool drop_sticks(Flight& f) {
  f.slip.carries = false;
  const int before = f.active;
  f.active = put_sticks_last(f);
  return f.active < before;
}

bool restart(const ModelData& model, const StepOptions& options, double tau, Node& node,
             Flight& f) {
  if (f.active == 0 || f.slip.restarted || !rests_with_friction(node)) return false;
  f.slip.restarted = true;
  for (int i = 0; i < f.active; ++i) {
    if (f.constraints[i].kind == Kind::hold) node.held[f.constraints[i].place] = 0;
  }
  f.active = 0;
  f.slip.carries = false;
  f.arc.v = node.v;
  return solve_flight_arc(model, options, tau, node, f);
}

void remember_grips(Node& node, const Flight& f) {
  if (!node.friction.any) return;
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::hold) continue;
    GripMemory& memory = node.friction.memory[c.place];
    memory = {
        c.grip, Vec3(c.lambda, c.carried[0], c.carried[1]), {}, f.arc.tau, node.friction.flight};
    if (c.grip.mode != Grip::Mode::slides) continue;
    memory.p = c.lambda * slide_direction(c.grip, contact_of(node, c).friction);
  }
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::stick) continue;
    GripMemory& memory = node.friction.memory[c.place];
    memory.p[c.tangent + 1] = c.lambda;
    memory.solved[static_cast<std::size_t>(c.tangent)] = true;
  }
}

}  // namespace saltus
