#include "variational/slip_blocks.hpp"

#include <array>
#include <cmath>

#include "saltus/collision/slip.hpp"
#include "variational/impact_time.hpp"

namespace saltus {
namespace {

using Kind = ArcConstraint::Kind;

const ArcConstraint* find_stick(const Flight& f, int place, int tangent) {
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind == Kind::stick && c.place == place && c.tangent == tangent) return &c;
  }
  return nullptr;
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

/// The same of the rows at the arc's start.
Mat3 start_block_of(const Node& node, const Contact& at, const ArcConstraint& by,
                    const SlipRows& column, bool by_slips) {
  const std::array<const ContactVector*, 3> rows = {&at.n, &at.t[0], &at.t[1]};
  const std::array<const VecX*, 3> columns = {&by.column, &column.column0, &column.column1};
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < (at.friction > 0 ? 3 : 1); ++i) {
    for (int j = 0; j < (by_slips ? 3 : 1); ++j)
      block(i, j) = dot(node.trees, *rows[i], *columns[j]);
  }
  return block;
}

/// An entry more of what an impulse at contact j does; its own block too.
void push_block(int i, int j, const Mat3& block, ContactBlocks& W) {
  if (i == j) W.own.push_back((block + block.transpose()) / 2);
  if (block.isZero(0)) return;
  W.contact.push_back(i);
  W.block.push_back(block);
}

void clear_blocks(ContactBlocks& W) {
  for (auto* each : {&W.start, &W.contact}) each->clear();
  for (auto* each : {&W.friction, &W.rest}) each->clear();
  W.block.clear();
  W.own.clear();
}

}  // namespace

Vec3 impulse_of(const Node& node, const ArcConstraint& c, Flight& f) {
  if (c.grip.mode == Grip::Mode::slides) {
    return c.lambda * slide_direction(c.grip, contact_of(node, c).friction);
  }
  Vec3 p(c.lambda, 0, 0);
  for (int k = 0; k < 2 && c.grip.mode == Grip::Mode::sticks; ++k) {
    const ArcConstraint* stick = find_stick(f, c.place, k);
    p[k + 1] = stick ? stick->lambda : c.carried[k];
  }
  return p;
}

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

bool set_slip_blocks(const ModelData& model, const StepOptions& options, Node& node, Flight& f) {
  ArcScratch& s = f.scratch;
  FrictionScratch& x = f.slip.friction;
  const ArcProblem problem = arc_problem(options, f.arc.tau, node, f);
  if (!std::isfinite(momentum_residual(model, problem, f.arc.v, s))) return false;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, f.arc.tau, s.J)) return false;
  s.dv = s.r;  // not 0 where a hold was let go since the arc was solved
  solve(model.tree, model.packed, s.J, s.dv);
  f.arc.v += s.dv;
  s.x = node.q + f.arc.tau * f.arc.v;
  place_end(model, s.x, s);
  ContactBlocks& W = x.W;
  ContactBlocks& at_start = f.slip.at_start;
  clear_blocks(W);
  clear_blocks(at_start);
  for (auto* each : {&x.u, &x.p}) each->clear();
  const int m = static_cast<int>(x.contact.size());
  for (int i = 0; i < m; ++i) linearise(model, node, x.contact[i], f.slip.row[i], f);
  for (int j = 0; j < m; ++j) {
    const ArcConstraint& by = f.constraints[x.contact[j]];
    const SlipRows& column = f.slip.row[j];
    W.start.push_back(static_cast<int>(W.contact.size()));
    at_start.start.push_back(static_cast<int>(at_start.contact.size()));
    for (int i = 0; i < m; ++i) {
      const ArcConstraint& at = f.constraints[x.contact[i]];
      const bool at_slips = W.friction[i] > 0, by_slips = W.friction[j] > 0;
      push_block(i, j, block_of(at, f.slip.row[i], at_slips, by, column, by_slips), W);
      push_block(i, j, start_block_of(node, contact_of(node, at), by, column, by_slips), at_start);
    }
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
  at_start.start.push_back(static_cast<int>(at_start.contact.size()));
  return true;
}

}  // namespace saltus
