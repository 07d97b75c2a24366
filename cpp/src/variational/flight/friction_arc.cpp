#include "variational/flight/friction_arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/flight/holds.hpp"
#include "variational/flight/impact_time.hpp"
#include "variational/flight/launch.hpp"
#include "variational/flight/slip_blocks.hpp"

namespace saltus {
namespace {

constexpr int most_rounds = 40;          ///< 2 to 6 are usual
constexpr int most_idle = 8;             ///< rounds that do not halve what is unlawful
constexpr double most_residual = 1e-12;  ///< of the arc's equation, quadratically less as a rule

/// To rounding, which grows with what holds each other; or where redundant contacts that turn keep
/// from it, as far as it will go.
/// @param before the residual of the round before
bool is_lawful(const Lawlessness& law, double before, std::size_t contacts) {
  if (law.residual <= 1e-15 * static_cast<double>(contacts)) return true;
  return law.residual > before / 2 && law.least() <= small_residual;
}

using Kind = ArcConstraint::Kind;

/// All that rests is held, in slip.friction.contact, with its impulses over tau in
/// slip.friction.p.
void hold_all(const ModelData& model, double tau, Node& node, Flight& f) {
  FrictionScratch& x = f.slip.friction;
  x.contact.clear();
  x.p.clear();
  x.W.own.clear();
  const double part = f.slip.tau > 0 ? tau / f.slip.tau : 1;
  f.slip.tau = tau;
  for (int i = 0; i < f.active; ++i) {
    ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::hold) continue;
    c.lambda *= part;
    c.tangential *= part;
    x.contact.push_back(i);
    x.p.push_back(impulse_of(c));
  }
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests || node.held[c.pair]) continue;
    x.contact.push_back(f.active);
    x.p.push_back(Vec3::Zero());
    hold(model, c.pair, node, f);
  }
}

/// Impulses to the holds; those that are not pressed are let go.
void give_to_holds(Node& node, Flight& f) {
  const FrictionScratch& x = f.slip.friction;
  double size = 0;
  for (const Vec3& p : x.p) size = std::max(size, p[0]);
  for (std::size_t k = 0; k < x.contact.size(); ++k) {
    ArcConstraint& c = f.constraints[x.contact[k]];
    c.lambda = x.p[k][0] > 1e-13 * size ? x.p[k][0] : 0;
    c.tangential = x.p[k].tail<2>();
  }
  for (int i = f.active - 1; i >= 0; --i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind == Kind::hold && !(c.lambda > 0)) release(i, node, f);
  }
}

/// What a change of the impulses does to the arc's velocity, by the linearised arc.
void add_change(const std::vector<Vec3>& before, Flight& f) {
  const FrictionScratch& x = f.slip.friction;
  for (std::size_t i = 0; i < x.contact.size(); ++i) {
    const Vec3 dp = x.p[i] - before[i];
    const SlipRows& row = f.slip.row[i];
    f.arc.v += dp[0] * f.constraints[x.contact[i]].column;
    if (x.W.friction[i] > 0) f.arc.v += dp[1] * row.column0 + dp[2] * row.column1;
  }
}

/// Newton's method from flight.arc.v and the impulses of the holds.
bool solve_rounds(const ModelData& model, const StepOptions& options, double tau, Node& node,
                  Flight& f) {
  FrictionScratch& x = f.slip.friction;
  hold_all(model, tau, node, f);
  f.arc.tau = tau;
  bool is_solved = false;  // that is, the impulses are lawful for the v that belongs to them
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0, idle = 0;; ++round) {
    f.arc.iterations = round;
    const Lawlessness now = set_slip_rates(model, options, node, f);
    f.slip.residual = now.least();
    const bool ends = round == most_rounds || idle == most_idle;
    if (f.arc.residual <= most_residual && ends && f.slip.residual <= large_residual) break;
    if (f.arc.residual <= most_residual && is_solved && is_lawful(now, before, x.contact.size()))
      break;
    if (ends || !std::isfinite(now.residual) || !set_slip_blocks(model, node, f)) {
      f.closing = f.constraints[x.contact[most_lawless(x)]].place;
      return false;
    }
    const Lawlessness law = lawlessness(x.W, x.u, x.p);
    is_solved = is_lawful(law, before, x.contact.size());
    idle = law.residual > before / 2 ? idle + 1 : 0;
    before = law.residual;
    if (is_solved) continue;
    f.slip.before = x.p;
    settle_for_sure(x.W, x.pile, x.u, x.p, 1e-4);  // what it leaves, the next round finds
    add_change(f.slip.before, f);
  }
  finish_arc(model, {node.q, f.slip.p, f.arc.tau, {}, whole_step(options)}, f.arc, f.scratch);
  give_to_holds(node, f);
  return true;
}

}  // namespace

bool needs_friction_arc(const Node& node) {
  if (!node.friction.any) return false;
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].motion == Contact::Motion::rests) return true;
  }
  return false;
}

void make_room(const ModelData& model, Node& node, Flight& f) {
  const auto contacts = static_cast<std::size_t>(node.touching);
  const std::size_t wanted = contacts + 2;  // a launch, and one for prepare_hold
  node.friction.reserve(contacts);
  f.slip.friction.reserve(contacts);
  f.slip.before.reserve(f.slip.friction.contact.capacity());
  while (f.constraints.size() < wanted) f.constraints.push_back(fresh_constraint(model));
  while (f.slip.row.size() < f.slip.friction.contact.capacity()) {
    SlipRows row;
    for (VecX* x : {&row.t0, &row.t1, &row.column0, &row.column1}) {
      x->setZero(model.tree.n_v);
    }
    f.slip.row.push_back(std::move(row));
  }
}

void recall_impulses(double left, Node& node, Flight& f) {
  const int flight = node.friction.flight++;
  f.slip.tau = left;
  for (int i = 0; i < f.active; ++i) {
    ArcConstraint& c = f.constraints[i];
    const ImpulseMemory& memory = node.friction.memory[c.place];
    if (memory.flight != flight) continue;
    c.lambda = left / memory.tau * memory.p[0];
    c.tangential = left / memory.tau * memory.p.tail<2>();
  }
}

void forget_impulses(Flight& f) {
  for (int i = 0; i < f.active; ++i) {
    f.constraints[i].lambda = 0;
    f.constraints[i].tangential.setZero();
  }
}

void remember_impulses(Node& node, const Flight& f) {
  if (!node.friction.any) return;
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::hold) continue;
    node.friction.memory[c.place] = {impulse_of(c), f.arc.tau, node.friction.flight};
  }
}

bool solve_friction_arc(const ModelData& model, const StepOptions& options, double tau, Node& node,
                        Flight& f) {
  if (solve_rounds(model, options, tau, node, f)) return true;
  forget_impulses(f);
  f.arc.v = node.v;
  return solve_rounds(model, options, tau, node, f);
}

}  // namespace saltus
