#include "variational/arc/row_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/collision/slip.hpp"

namespace saltus {
namespace {

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

/// Tangential rates of a point: its chord on the plane, as b's body sees it.
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

/// The rate of a joint: its velocity.
void set_joint_rate(const Scene& scene, const Contact& c, const Arc& arc, Row& row, Vec3& u) {
  row.rate[0].setZero();
  add(scene.trees, 1, c.n, row.rate[0]);
  u = Vec3(dot(scene.trees, c.n, arc.v), 0, 0);
}

/// Rates of the active rows at arc.v, and their gradients by the configuration they are of. Needs
/// the poses in the arc's middle.
void set_rates(const Scene& scene, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  Rows& rows = work.rows;
  ArcScratch& s = work.scratch;
  const double tau = work.arc.tau;
  integrate(model.tree, node.q, tau, work.arc.v, s.q);
  place_end(model, s.q, s);
  rows.u.resize(rows.active.size());
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    Row& row = active_row(rows, i);
    const Contact& c = contact_of(node, row);
    if (row.is_joint()) {
      set_joint_rate(scene, c, work.arc, row, rows.u[i]);
      continue;
    }
    const bool slides = c.friction > 0;
    Vec3& u = rows.u[i];
    u.setZero();
    if (slides && !row.is_point) set_sliding(model, c, work.arc, row, u, s);
    const Gap g = pair_gap_at_end(model, row.watched(), s);
    row.rate[0].setZero();
    add_gap_gradient(model.tree, s.kin_end, row.watched(), g, row.rate[0]);
    u[0] = (g.phi - row.target) / tau;
    if (slides && row.is_point) set_chord(model, g, tau, row, u, s);
  }
}

/// Rows and columns of the linearised arc, without what the launch takes up.
void linearize(const Scene& scene, const Contact& c, ArcWork& work, Row& row) {
  const ModelData& model = scene.model;
  ArcScratch& s = work.scratch;
  const bool is_chord = row.is_point;
  for (int k = 0; k < c.rates(); ++k) {
    const bool is_of_end = (k == 0 && !row.is_joint()) || is_chord;
    if (is_of_end) pull_back_end(model.packed, s.J, row.rate[k]);
    VecX& column = row.column[k];
    column.setZero();
    add(scene.trees, 1, c.row(k), column);
    solve(model.tree, model.packed, s.J, column);
    if (s.loops) {
      s.loops->solver.hold(column);
      row.by_loops[k] = s.loops->solver.mu;
    }
    row.by_launch[k] = is_matched(&work.line) ? take_out_line(work.line, column) : 0;
  }
}

Mat3 block_of(const Row& at, int at_rates, const Row& by, int by_rates) {
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < at_rates; ++i) {
    for (int j = 0; j < by_rates; ++j) block(i, j) = at.rate[i].dot(by.column[j]);
  }
  return block;
}

/// A launch couples all rows.
void set_blocks(const Node& node, bool is_launched, Rows& rows) {
  ContactBlocks& W = rows.W;
  const int m = static_cast<int>(rows.active.size());
  for (int j = 0; j < m; ++j) {
    const Row& by = active_row(rows, j);
    const Contact& c = contact_of(node, by);
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (int i = 0; i < m; ++i) {
      const Row& at = active_row(rows, i);
      const Contact& other = contact_of(node, at);
      if (!is_launched && !share_a_tree(other.n, c.n)) continue;
      W.contact.push_back(i);
      W.block.push_back(block_of(at, other.rates(), by, c.rates()));
      if (i == j) W.own.push_back((W.block.back() + W.block.back().transpose()) / 2);
    }
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
}

/// momentum and size: the node's with all impulses.
void add_impulses(const Scene& scene, const Node& node, Rows& rows) {
  rows.momentum = node.p;
  rows.size = node.p.cwiseAbs();
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    const Contact& c = contact_of(node, active_row(rows, i));
    for (int k = 0; k < c.rates(); ++k) {
      add(scene.trees, rows.p[i][k], c.row(k), rows.momentum);
      add_sizes(scene.trees, rows.p[i][k], c.row(k), rows.size);
    }
  }
}

/// Motors' forces have kinks where they are limited, and Newton's method may turn in circles there:
/// its step s.dv, which arc.v has taken, is shortened until the arc's equation is met better.
void shorten(const ModelData& model, const ArcProblem& problem, Arc& arc, ArcScratch& s) {
  constexpr double tiny = std::numeric_limits<double>::min();
  constexpr double near = 1e-8;  // from there on no kink is in the way, and rounding would be
  const auto size = s.scale.array() + problem.p.array().abs() + tiny;
  const double before = (s.r.array().abs() / size).maxCoeff();
  for (int k = 0; k < 12 && before > near; ++k) {
    if (momentum_residual(model, problem, arc.v, s, true) < before) return;
    halve_step(s);
    arc.v -= s.dv;
  }
}

}  // namespace

Lawlessness set_row_rates(const Scene& scene, const Node& node, ArcWork& work) {
  Rows& rows = work.rows;
  Arc& arc = work.arc;
  add_impulses(scene, node, rows);
  const ArcProblem problem = arc_problem(scene, arc.tau, node, work);
  arc.residual = momentum_residual(scene.model, problem, arc.v, work.scratch);
  if (std::isfinite(arc.residual)) {  // forces cancel, their rounding does not
    constexpr double tiny = std::numeric_limits<double>::min();
    const auto size = work.scratch.scale.array() + rows.size.array() + tiny;
    arc.residual = std::max((work.scratch.r.array().abs() / size).maxCoeff(),
                            line_residual(scene.model, problem, arc.v, work.scratch));
    if (problem.loops != nullptr) {
      arc.residual =
          std::max(arc.residual, loop_residual(scene.model, problem, arc.v, work.scratch));
    }
  }
  set_rates(scene, node, work);
  const Lawlessness out{arc.residual, arc.residual};
  if (rows.W.size() != static_cast<int>(rows.active.size())) return out;
  const Lawlessness law = lawlessness(rows.W, rows.u, rows.p);
  return {std::max(out.residual, law.residual), std::max(out.excess, law.excess)};
}

bool set_row_blocks(const Scene& scene, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  ArcScratch& s = work.scratch;
  Rows& rows = work.rows;
  Arc& arc = work.arc;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, arc.tau, s.J)) return false;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
  const bool is_launched = is_matched(&work.line);
  const ArcProblem problem = arc_problem(scene, arc.tau, node, work);
  if (is_launched) take_out_line(model, problem, arc.v, s);
  if (problem.loops != nullptr && !take_out_loops(model, problem, s)) return false;
  arc.v += s.dv;
  if (s.has_forces) shorten(model, problem, arc, s);
  if (!arc.v.allFinite()) return false;
  set_rates(scene, node, work);
  clear(rows.W);
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    Row& row = active_row(rows, i);
    const Contact& c = contact_of(node, row);
    linearize(scene, c, work, row);
    rows.W.friction.push_back(c.friction);
    // a hundredth of what touches is closed, over the arc
    const double closed = row.is_joint() ? 0 : 1e-2 * row.pair->touch / arc.tau;
    rows.W.rest.push_back(std::max(c.epsilon_u, closed));
    rows.W.bound.push_back(row.is_joint() ? arc.tau / 2 * node.dry_force[-1 - row.contact] : 0);
  }
  set_blocks(node, is_launched, rows);
  return true;
}

}  // namespace saltus
