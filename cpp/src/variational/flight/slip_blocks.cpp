#include "variational/flight/slip_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saltus/collision/slip.hpp"

namespace saltus {
namespace {

using Kind = ArcConstraint::Kind;

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

/// Rates of all holds at flight.arc.v. Needs the poses in the arc's middle.
void set_rates(const ModelData& model, const Node& node, Flight& f) {
  FrictionScratch& x = f.slip.friction;
  ArcScratch& s = f.scratch;
  integrate(model.tree, node.q, f.arc.tau, f.arc.v, s.q);
  place_end(model, s.q, s);
  x.u.resize(x.contact.size());
  for (std::size_t i = 0; i < x.contact.size(); ++i) {
    ArcConstraint& c = f.constraints[x.contact[i]];
    const Gap g = pair_gap_at_end(model, c.watched(), s);
    c.row.setZero();
    add_gap_gradient(model.tree, s.kin_end, c.watched(), g, c.row);
    x.u[i] = Vec3((g.phi - c.target) / f.arc.tau, 0, 0);
    if (!(contact_of(node, c).friction > 0)) continue;
    SlipRows& row = f.slip.row[i];
    add_slide_rows(model, c, s, row.t0, row.t1);
    x.u[i].tail<2>() << row.t0.dot(f.arc.v), row.t1.dot(f.arc.v);
  }
}

/// J^-1 of the rows of a hold's forces.
void set_columns(const ModelData& model, const Node& node, ArcConstraint& c, SlipRows& x,
                 ArcScratch& s) {
  const Contact& contact = contact_of(node, c);
  const auto set = [&](const ContactVector& force, VecX& column) {
    column.setZero();
    add(node.trees, 1, force, column);
    solve(model.tree, model.packed, s.J, column);
  };
  set(contact.n, c.column);
  if (!(contact.friction > 0)) return;
  set(contact.t[0], x.column0);
  set(contact.t[1], x.column1);
}

Mat3 block_of(const ArcConstraint& at, const SlipRows& row, bool at_slips, const ArcConstraint& by,
              const SlipRows& column, bool by_slips) {
  const std::array<const VecX*, 3> rows = {&at.row, &row.t0, &row.t1};
  const std::array<const VecX*, 3> columns = {&by.column, &column.column0, &column.column1};
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < (at_slips ? 3 : 1); ++i) {
    for (int j = 0; j < (by_slips ? 3 : 1); ++j) block(i, j) = rows[i]->dot(*columns[j]);
  }
  return block;
}

void clear_blocks(ContactBlocks& W) {
  for (auto* each : {&W.start, &W.contact}) each->clear();
  for (auto* each : {&W.friction, &W.rest}) each->clear();
  W.block.clear();
  W.own.clear();
}

}  // namespace

Lawlessness set_slip_rates(const ModelData& model, const StepOptions& options, const Node& node,
                           Flight& f) {
  FrictionScratch& x = f.slip.friction;
  f.slip.p = node.p;
  f.slip.size = node.p.cwiseAbs();
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::hold) f.slip.p += c.lambda * c.n;
  }
  for (std::size_t i = 0; i < x.contact.size(); ++i) {
    const Contact& contact = contact_of(node, f.constraints[x.contact[i]]);
    add(node.trees, x.p[i][0], contact.n, f.slip.p);
    add_sizes(node.trees, x.p[i][0], contact.n, f.slip.size);
    for (int k = 0; k < 2 && contact.friction > 0; ++k) {
      add(node.trees, x.p[i][k + 1], contact.t[k], f.slip.p);
      add_sizes(node.trees, x.p[i][k + 1], contact.t[k], f.slip.size);
    }
  }
  const ArcProblem problem{node.q, f.slip.p, f.arc.tau, {}, whole_step(options)};
  const double momentum = momentum_residual(model, problem, f.arc.v, f.scratch);
  Lawlessness out{momentum, momentum};
  if (std::isfinite(momentum)) {  // forces cancel, their rounding does not
    constexpr double tiny = std::numeric_limits<double>::min();
    const auto size = f.scratch.scale.array() + f.slip.size.array() + tiny;
    out.residual = out.excess = (f.scratch.r.array().abs() / size).maxCoeff();
  }
  f.arc.residual = out.residual;
  set_rates(model, node, f);
  if (x.W.size() != static_cast<int>(x.contact.size())) return out;
  const Lawlessness law = lawlessness(x.W, x.u, x.p);
  return {std::max(out.residual, law.residual), std::max(out.excess, law.excess)};
}

bool set_slip_blocks(const ModelData& model, const Node& node, Flight& f) {
  ArcScratch& s = f.scratch;
  FrictionScratch& x = f.slip.friction;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, f.arc.tau, s.J)) return false;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
  f.arc.v += s.dv;
  set_rates(model, node, f);
  for (const int i : x.contact) pull_back_end(model.packed, s.J, f.constraints[i].row);
  ContactBlocks& W = x.W;
  clear_blocks(W);
  const int m = static_cast<int>(x.contact.size());
  for (int i = 0; i < m; ++i) {
    ArcConstraint& c = f.constraints[x.contact[i]];
    W.friction.push_back(contact_of(node, c).friction);
    set_columns(model, node, c, f.slip.row[i], s);
    // a hundredth of what touches is closed, over the arc
    W.rest.push_back(std::max(contact_of(node, c).epsilon_u, 1e-2 * c.pair->touch / f.arc.tau));
  }
  for (int j = 0; j < m; ++j) {
    const ArcConstraint& by = f.constraints[x.contact[j]];
    const bool by_slips = W.friction[j] > 0;
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (int i = 0; i < m; ++i) {
      const ArcConstraint& at = f.constraints[x.contact[i]];
      if (!share_a_tree(contact_of(node, at).n, contact_of(node, by).n)) continue;
      const bool at_slips = W.friction[i] > 0;
      W.contact.push_back(i);
      W.block.push_back(block_of(at, f.slip.row[i], at_slips, by, f.slip.row[j], by_slips));
      if (i == j) W.own.push_back((W.block.back() + W.block.back().transpose()) / 2);
    }
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
  return true;
}

}  // namespace saltus
