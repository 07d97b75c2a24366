#include "variational/flight_friction.hpp"

#include <algorithm>
#include <cmath>

#include "variational/impact_time.hpp"
#include "variational/slip_blocks.hpp"

namespace saltus {
namespace {

/// Every round meets the law better by a factor of order h, once who sticks is known.
constexpr int most_rounds = 30;
constexpr int strict_rounds = 12;
constexpr double strict = 1e-10, loose = 1e-7;  ///< lawlessness that is none

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

/// Sticks of pairs that are not held any more. Holds stay where they are.
void drop_orphans(const Node& node, int first, Flight& f) {
  for (int i = f.active - 1; i >= first; --i) {
    if (node.held[f.constraints[i].place]) continue;
    std::swap(f.constraints[i], f.constraints[f.active - 1]);
    --f.active;
  }
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
/// @return false: no room
bool set_forces(const Node& node, int i, const Vec3& p, const std::array<bool, 2>& solved,
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
  if (c.grip.mode != Grip::Mode::sticks) return true;
  for (int k = 0; k < 2; ++k) {
    if (!solved[k]) {
      c.carried[k] = p[k + 1];
      continue;
    }
    if (f.active == most_constraints) return false;
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
  return true;
}

/// How far a hold is from Coulomb's law: by a part of the forces, or of the speeds that there are.
double lawlessness(const ModelData& model, const Node& node, double size, const ArcConstraint& c,
                   Flight& f) {
  const Contact& contact = contact_of(node, c);
  if (!(c.lambda > 1e-12 * size)) return 0;
  if (c.grip.mode == Grip::Mode::none) return 1;
  if (c.grip.mode == Grip::Mode::sticks) {
    const double limit = contact.friction * c.lambda;
    return (impulse_of(node, c, f).tail<2>().norm() - limit) / (contact.friction * size);
  }
  add_slide_rows(model, c, f.scratch, f.slip.row[0].t0, f.slip.row[0].t1);
  const Vec2 slide(f.slip.row[0].t0.dot(f.arc.v), f.slip.row[0].t1.dot(f.arc.v));
  const double speed = slide.norm();
  // of the speeds that there are: what hardly slides has hardly a direction
  const double least = std::max(contact.epsilon_u, 1e-14);
  return strict * (slide - speed * c.grip.slide).norm() / least;
}

/// The most lawless hold, and by how much.
double worst(const ModelData& model, const Node& node, Flight& f) {
  double most = 0, size = 0;
  for (int i = 0; i < f.active; ++i) {
    if (f.constraints[i].kind == Kind::hold) size = std::max(size, f.constraints[i].lambda);
  }
  for (const int i : f.slip.friction.contact) {
    const ArcConstraint& c = f.constraints[i];
    if (!(contact_of(node, c).friction > 0)) continue;
    const double each = lawlessness(model, node, size, c, f);
    if (!(each > most)) continue;
    most = each;
    f.closing = c.place;
  }
  return most;
}

/// Who sticks and who slides from the law solved for the linearised arc.
/// @param first how many constraints are none of `stick`
Grips resettle(const ModelData& model, const StepOptions& options, int first, Node& node,
               Flight& f) {
  FrictionScratch& x = f.slip.friction;
  f.closing = f.constraints[x.contact[0]].place;
  sum_carried(node, f);
  if (!set_slip_blocks(model, options, node, f)) return Grips::not_settled;
  f.slip.before = x.p;
  settle(x.W, most_sweeps, x.u, x.p);
  for (std::size_t i = 0; i < x.contact.size(); ++i) {
    const Vec3 dp = x.p[i] - f.slip.before[i];
    ArcConstraint& c = f.constraints[x.contact[i]];
    const SlipRows& row = f.slip.row[i];
    f.arc.v += dp[0] * c.column;
    if (x.W.friction[i] > 0) f.arc.v += dp[1] * row.column0 + dp[2] * row.column1;
    c.grip = grip_of(x.u[i], x.p[i], x.W.friction[i], x.W.rest[i]);
  }
  f.active = first;
  const auto sticks = [&](int i) {
    return f.constraints[x.contact[i]].grip.mode == Grip::Mode::sticks;
  };
  int wanted = 0;  // three a contact, if all that rest here come to be held and stick
  for (int i = 0; i < node.touching; ++i) {
    wanted += node.contacts[i].motion == Contact::Motion::rests ? 3 : 0;
  }
  IndependentRates rates(f.slip.at_start);  // where not all find room
  for (int i = 0; i < x.W.size() && wanted > most_constraints; ++i) rates.take(i, 0);
  for (int i = 0; i < x.W.size(); ++i) {
    const Mat3& own = f.slip.at_start.own[i];
    std::array<bool, 2> solved = {};
    for (int k = 1; k < 3; ++k) {
      const bool moves = own(k, k) > 1e-20 * own(0, 0);
      solved[k - 1] = sticks(i) && moves && (wanted <= most_constraints || rates.take(i, k));
    }
    if (!set_forces(node, x.contact[i], x.p[i], solved, f)) return Grips::too_many;
  }
  sum_carried(node, f);
  return Grips::changed;
}

/// The holds, in flight.slip.friction.contact. @return true where some of them has friction
bool list_holds(const Node& node, Flight& f) {
  bool any = false;
  f.slip.friction.contact.clear();
  for (int i = 0; i < f.active; ++i) {
    if (f.constraints[i].kind != Kind::hold) continue;
    f.slip.friction.contact.push_back(i);
    any = any || contact_of(node, f.constraints[i]).friction > 0;
  }
  return any;
}

}  // namespace

SlipScratch::SlipScratch(bool with_friction, int n_q) : friction(with_friction) {
  if (!with_friction) return;
  row.resize(most_constraints);
  for (SlipRows& each : row) {
    for (VecX* x : {&each.t0, &each.t1, &each.column0, &each.column1}) x->setZero(n_q);
  }
  before.reserve(most_constraints);
  reserve_blocks(at_start);
  for (VecX* x : {&carried, &p}) x->setZero(n_q);
}

int count_holds(const Flight& f) {
  int count = 0;
  for (int i = 0; i < f.active; ++i) count += f.constraints[i].kind != Kind::stick;
  return count;
}

bool start_grips(double left, Node& node, Flight& f) {
  const int flight = node.friction.flight++;
  f.slip.rounds = 0;
  const int holds = f.active;
  for (int i = 0; i < holds; ++i) {
    ArcConstraint& c = f.constraints[i];
    const GripMemory& memory = node.friction.memory[c.place];
    if (memory.flight != flight || !(contact_of(node, c).friction > 0)) continue;
    c.grip = memory.grip;
    if (!set_forces(node, i, left / memory.tau * memory.p, memory.solved, f)) return false;
  }
  sum_carried(node, f);
  return true;
}

Grips update_grips(const ModelData& model, const StepOptions& options, bool changed, Node& node,
                   Flight& f) {
  if (!node.friction.any) return Grips::unchanged;
  const int first = put_sticks_last(f);
  drop_orphans(node, first, f);
  if (!list_holds(node, f)) {
    f.slip.carries = false;
    return Grips::unchanged;
  }
  if (!changed) {
    if (worst(model, node, f) <= (f.slip.rounds < strict_rounds ? strict : loose)) {
      f.slip.rounds = 0;
      return Grips::unchanged;
    }
    if (f.slip.rounds == most_rounds) return Grips::not_settled;
  }
  ++f.slip.rounds;
  return resettle(model, options, first, node, f);
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
