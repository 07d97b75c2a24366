#include "variational/flight_friction.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/collision/slip.hpp"
#include "variational/impact_time.hpp"

namespace saltus {
namespace {

/// Every round meets the law better by a factor of order h, once who sticks is known.
constexpr int most_rounds = 30;
constexpr int strict_rounds = 12;

using Kind = ArcConstraint::Kind;

const Contact& contact_of(const Node& node, const ArcConstraint& c) {
  return node.contacts[node.contact_of[c.place]];
}

ArcConstraint* find_stick(Flight& f, int place, int tangent) {
  for (int i = 0; i < f.active; ++i) {
    ArcConstraint& c = f.constraints[i];
    if (c.kind == Kind::stick && c.place == place && c.tangent == tangent) return &c;
  }
  return nullptr;
}

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

/// Force directions and impulses of a hold that does as c.grip says. @return false: no room
bool set_forces(const Node& node, int i, const Vec3& p, Flight& f) {
  ArcConstraint& c = f.constraints[i];
  const Contact& contact = contact_of(node, c);
  c.lambda = p[0];
  c.n.setZero();
  add(node.trees, 1, contact.n, c.n);
  if (c.grip.mode == Grip::Mode::slides) {
    const Vec3 along = slide_direction(c.grip, contact.friction);
    for (int k = 0; k < 2; ++k) add(node.trees, along[k + 1], contact.t[k], c.n);
  }
  if (c.grip.mode != Grip::Mode::sticks) return true;
  for (int k = 0; k < 2; ++k) {
    const auto& row = contact.t[k].value;
    if (std::all_of(row.begin(), row.end(), [](double x) { return std::abs(x) < 1e-14; })) continue;
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

/// Impulse of a hold over the arc, in its tangents.
Vec3 impulse_of(const Node& node, const ArcConstraint& c, Flight& f) {
  if (c.grip.mode == Grip::Mode::slides) {
    return c.lambda * slide_direction(c.grip, contact_of(node, c).friction);
  }
  Vec3 p(c.lambda, 0, 0);
  for (int k = 0; k < 2 && c.grip.mode == Grip::Mode::sticks; ++k) {
    if (const ArcConstraint* stick = find_stick(f, c.place, k)) p[k + 1] = stick->lambda;
  }
  return p;
}

/// Rows T of a hold in the middle of the arc.
void add_slide_rows(const ModelData& model, const ArcConstraint& c, ArcScratch& s, VecX& t0,
                    VecX& t1) {
  const Gap g = pair_gap_at_mid(model, c.watched(), s);
  const Tangents t = tangents(g.n_W, c.axis);
  const Vec3 P = contact_point(g);
  t0.setZero();
  t1.setZero();
  add_motion_gradient(model.tree, s.kin_end, c.watched(), P, t.t0, t0);
  add_motion_gradient(model.tree, s.kin_end, c.watched(), P, t.t1, t1);
}

/// How far a hold is from Coulomb's law: part of its force, or of its direction. No more than 1.
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
  if (speed <= contact.epsilon_u) return 0;
  return std::min(1.0, (slide / speed - c.grip.slide).norm());
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

/// Rows and columns of one hold for the arc just solved; its rates and impulse.
void linearise(const ModelData& model, const Node& node, int i, SlipRows& x, Flight& f) {
  ArcConstraint& c = f.constraints[i];
  ArcScratch& s = f.scratch;
  const Contact& contact = contact_of(node, c);
  const Gap g = pair_gap_at_end(model, c.watched(), s);
  c.row.setZero();
  add_gap_gradient(model.tree, s.kin_end, c.watched(), g, c.row);
  c.column.setZero();
  add(node.trees, 1, contact.n, c.column);
  solve(model.tree, model.packed, s.J, c.column);
  Vec3 u((g.phi - c.target) / f.arc.tau, 0, 0);
  if (contact.friction > 0) {
    add_slide_rows(model, c, s, x.t0, x.t1);
    u.tail<2>() << x.t0.dot(f.arc.v), x.t1.dot(f.arc.v);
    x.column0.setZero();
    x.column1.setZero();
    add(node.trees, 1, contact.t[0], x.column0);
    add(node.trees, 1, contact.t[1], x.column1);
    solve(model.tree, model.packed, s.J, x.column0);
    solve(model.tree, model.packed, s.J, x.column1);
  }
  f.slip.friction.u.push_back(u);
  f.slip.friction.p.push_back(impulse_of(node, c, f));
  f.slip.friction.W.friction.push_back(contact.friction);
  f.slip.friction.W.rest.push_back(contact.epsilon_u);
}

Mat3 block_of(const ArcConstraint& at, const SlipRows& row, bool at_slips, const ArcConstraint& by,
              const SlipRows& column, bool by_slips) {
  Mat3 block = Mat3::Zero();
  block(0, 0) = at.row.dot(by.column);
  if (by_slips) block.row(0).tail<2>() << at.row.dot(column.column0), at.row.dot(column.column1);
  if (at_slips) block.col(0).tail<2>() << row.t0.dot(by.column), row.t1.dot(by.column);
  if (at_slips && by_slips) {
    block.bottomRightCorner<2, 2>() << row.t0.dot(column.column0), row.t0.dot(column.column1),
        row.t1.dot(column.column0), row.t1.dot(column.column1);
  }
  return block;
}

/// What impulses at the holds change in the arc: W, rates and impulses now.
bool set_blocks(const ModelData& model, const StepOptions& options, Node& node, Flight& f) {
  ArcScratch& s = f.scratch;
  FrictionScratch& x = f.slip.friction;
  const ArcProblem problem = arc_problem(options, f.arc.tau, node, f);
  if (!std::isfinite(momentum_residual(model, problem, f.arc.v, s))) return false;
  second_pass(model.packed, s.w);
  if (!factorize(model.tree, model.packed, s.w, f.arc.tau, s.J)) return false;
  s.dv = s.r;  // not 0 where a hold was let go since the arc was solved
  solve(model.tree, model.packed, s.J, s.dv);
  f.arc.v += s.dv;
  s.x = node.q + f.arc.tau * f.arc.v;
  place_end(model, s.x, s);
  ContactBlocks& W = x.W;
  for (auto* each : {&W.start, &W.contact}) each->clear();
  for (auto* each : {&W.friction, &W.rest}) each->clear();
  for (auto* each : {&x.u, &x.p}) each->clear();
  W.block.clear();
  W.own.clear();
  const int m = static_cast<int>(x.contact.size());
  for (int i = 0; i < m; ++i) linearise(model, node, x.contact[i], f.slip.row[i], f);
  for (int j = 0; j < m; ++j) {
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (int i = 0; i < m; ++i) {
      const Mat3 block = block_of(f.constraints[x.contact[i]], f.slip.row[i], W.friction[i] > 0,
                                  f.constraints[x.contact[j]], f.slip.row[j], W.friction[j] > 0);
      if (block.isZero(0)) continue;
      W.contact.push_back(i);
      W.block.push_back(block);
      if (i == j) W.own.push_back((block + block.transpose()) / 2);
    }
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
  return true;
}

/// Who sticks and who slides from the law solved for the linearised arc.
/// @param first how many constraints are none of `stick`
Grips resettle(const ModelData& model, const StepOptions& options, int first, Node& node,
               Flight& f) {
  FrictionScratch& x = f.slip.friction;
  if (!set_blocks(model, options, node, f)) return Grips::not_settled;
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
  for (std::size_t i = 0; i < x.contact.size(); ++i) {
    if (!set_forces(node, x.contact[i], x.p[i], f)) return Grips::too_many;
  }
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
    if (!set_forces(node, i, left / memory.tau * memory.p, f)) return false;
  }
  return true;
}

Grips update_grips(const ModelData& model, const StepOptions& options, bool changed, Node& node,
                   Flight& f) {
  if (!node.friction.any) return Grips::unchanged;
  const int first = put_sticks_last(f);
  drop_orphans(node, first, f);
  if (!list_holds(node, f)) return Grips::unchanged;
  if (!changed) {
    const double tolerance = f.slip.rounds < strict_rounds ? 1e-10 : 1e-7;
    if (worst(model, node, f) <= tolerance) {
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
    memory = {c.grip, Vec3(c.lambda, 0, 0), f.arc.tau, node.friction.flight};
    if (c.grip.mode != Grip::Mode::slides) continue;
    memory.p = c.lambda * slide_direction(c.grip, contact_of(node, c).friction);
  }
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind == Kind::stick) node.friction.memory[c.place].p[c.tangent + 1] = c.lambda;
  }
}

}  // namespace saltus
