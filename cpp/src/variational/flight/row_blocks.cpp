#include "variational/flight/row_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/collision/slip.hpp"
#include "variational/flight/impact_time.hpp"

namespace saltus {
namespace {

int rates(const Contact& c) { return c.friction > 0 ? 3 : 1; }

/// Tangential rates in the middle of the arc, where rolling has its slip: T v.
void set_sliding(const ModelData& model, const Contact& c, const Arc& arc, Row& row, Vec3& u,
                 ArcScratch& s) {
  const Gap g = pair_gap_at_mid(model, row.watched(), s);
  const Tangents t = tangents(g.n_W, tangent_axis(c.n_W));
  const Vec3 P = contact_point(g);
  for (int k = 1; k < 3; ++k) {
    row.rate[k].setZero();
    add_motion_gradient(model.tree, s.kin_end, row.watched(), P, k == 1 ? t.t0 : t.t1, row.rate[k]);
    u[k] = row.rate[k].dot(arc.v);
  }
}

/// Tangential rates of a corner: its chord on the plane, as b's body sees it.
void set_chord(const ModelData& model, const Gap& g, double tau, Row& row, Vec3& u, ArcScratch& s) {
  const Pose X_WJ = s.kin_end.X_WJ(model.tree, row.frozen.on_b.joint);
  const Vec3 chord = g.p_WA - (X_WJ.p + X_WJ.R * row.point_B);
  for (int k = 1; k < 3; ++k) {
    const Vec3 t = X_WJ.R * row.t_B[k - 1];
    row.rate[k].setZero();
    add_motion_gradient(model.tree, s.kin_end, row.frozen, g.p_WA, t, row.rate[k]);
    u[k] = t.dot(chord) / tau;
  }
}

bool is_corner(const Row& row) { return row.is_frozen && !row.pair->inward.empty(); }

/// Rates of the active rows at flight.arc.v, and their gradients by the configuration they are of.
/// Needs the poses in the arc's middle.
void set_rates(const ModelData& model, const Node& node, Flight& f) {
  Rows& rows = f.rows;
  ArcScratch& s = f.scratch;
  integrate(model.tree, node.q, f.arc.tau, f.arc.v, s.q);
  place_end(model, s.q, s);
  rows.u.resize(rows.active.size());
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    Row& row = active_row(rows, i);
    const Contact& c = node.contacts[row.contact];
    const bool slides = c.friction > 0;
    Vec3& u = rows.u[i];
    u.setZero();
    if (slides && !is_corner(row)) set_sliding(model, c, f.arc, row, u, s);
    const Gap g = pair_gap_at_end(model, row.watched(), s);
    row.rate[0].setZero();
    add_gap_gradient(model.tree, s.kin_end, row.watched(), g, row.rate[0]);
    u[0] = (g.phi - row.target) / f.arc.tau;
    if (slides && is_corner(row)) set_chord(model, g, f.arc.tau, row, u, s);
  }
}

/// Rows and columns of the linearised arc, without what the launch takes up.
void linearize(const ModelData& model, const Node& node, Flight& f, Row& row) {
  const Contact& c = node.contacts[row.contact];
  const bool is_chord = is_corner(row);
  for (int k = 0; k < rates(c); ++k) {
    if (k == 0 || is_chord) pull_back_end(model.packed, f.scratch.J, row.rate[k]);
    VecX& column = row.column[k];
    column.setZero();
    add(node.trees, 1, k == 0 ? c.n : c.t[k - 1], column);
    solve(model.tree, model.packed, f.scratch.J, column);
    row.by_launch[k] = f.is_launched ? take_out_line(f.launch, column) : 0;
  }
}

Mat3 block_of(const Row& at, int at_rates, const Row& by, int by_rates) {
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < at_rates; ++i) {
    for (int j = 0; j < by_rates; ++j) block(i, j) = at.rate[i].dot(by.column[j]);
  }
  return block;
}

void set_blocks(const Node& node, bool is_launched, Rows& rows) {
  ContactBlocks& W = rows.W;
  const int m = static_cast<int>(rows.active.size());
  for (int j = 0; j < m; ++j) {
    const Row& by = active_row(rows, j);
    const Contact& c = node.contacts[by.contact];
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (int i = 0; i < m; ++i) {
      const Row& at = active_row(rows, i);
      const Contact& other = node.contacts[at.contact];
      if (!is_launched && !share_a_tree(other.n, c.n)) continue;
      W.contact.push_back(i);
      W.block.push_back(block_of(at, rates(other), by, rates(c)));
      if (i == j) W.own.push_back((W.block.back() + W.block.back().transpose()) / 2);
    }
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
}

/// momentum and size: the node's with all impulses.
void add_impulses(const Node& node, Rows& rows) {
  rows.momentum = node.p;
  rows.size = node.p.cwiseAbs();
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    const Contact& c = node.contacts[active_row(rows, i).contact];
    for (int k = 0; k < rates(c); ++k) {
      const ContactVector& force = k == 0 ? c.n : c.t[k - 1];
      add(node.trees, rows.p[i][k], force, rows.momentum);
      add_sizes(node.trees, rows.p[i][k], force, rows.size);
    }
  }
}

}  // namespace

Lawlessness set_row_rates(const ModelData& model, const StepOptions& options, const Node& node,
                          Flight& f) {
  Rows& rows = f.rows;
  add_impulses(node, rows);
  const ArcProblem problem = held_arc_problem(options, f.arc.tau, node, f);
  const double momentum = momentum_residual(model, problem, f.arc.v, f.scratch);
  Lawlessness out{momentum, momentum};
  if (std::isfinite(momentum)) {  // forces cancel, their rounding does not
    constexpr double tiny = std::numeric_limits<double>::min();
    const auto size = f.scratch.scale.array() + rows.size.array() + tiny;
    const double part = (f.scratch.r.array().abs() / size).maxCoeff();
    out.residual = out.excess = std::max(part, line_residual(model, problem, f.arc.v, f.scratch));
  }
  f.arc.residual = out.residual;
  set_rates(model, node, f);
  if (rows.W.size() != static_cast<int>(rows.active.size())) return out;
  const Lawlessness law = lawlessness(rows.W, rows.u, rows.p);
  return {std::max(out.residual, law.residual), std::max(out.excess, law.excess)};
}

bool set_row_blocks(const ModelData& model, const StepOptions& options, const Node& node,
                    Flight& f) {
  ArcScratch& s = f.scratch;
  Rows& rows = f.rows;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, f.arc.tau, s.J)) return false;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
  if (f.is_launched) {
    take_out_line(model, held_arc_problem(options, f.arc.tau, node, f), f.arc.v, s);
  }
  f.arc.v += s.dv;
  if (!f.arc.v.allFinite()) return false;
  set_rates(model, node, f);
  clear(rows.W);
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    Row& row = active_row(rows, i);
    const Contact& c = node.contacts[row.contact];
    linearize(model, node, f, row);
    rows.W.friction.push_back(c.friction);
    // a hundredth of what touches is closed, over the arc
    rows.W.rest.push_back(std::max(c.epsilon_u, 1e-2 * row.pair->touch / f.arc.tau));
  }
  set_blocks(node, f.is_launched, rows);
  return true;
}

}  // namespace saltus
