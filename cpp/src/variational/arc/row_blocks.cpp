#include "variational/arc/row_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/arc/row_rates.hpp"

namespace saltus {
namespace {

/// Rows and columns of the linearised arc, without what the launch takes up.
void linearize(const Scene& scene, const Contact& c, ArcWork& work, Row& row) {
  const ModelData& model = scene.model;
  ArcScratch& s = work.scratch;
  Rows& rows = work.rows;
  const bool is_chord = row.is_point;
  for (int k = 0; k < c.rates(); ++k) {
    const bool is_of_end = (k == 0 && !row.is_joint()) || is_chord;
    if (is_of_end) pull_back_end(model, scene.trees, s.J, rows.column, row.rate[k]);
    ContactVector& column = row.column[k];
    solve(model, scene.trees, c.row(k), s.J, rows.column, column);
    if (s.loops) {
      add(scene.trees, 1, column, rows.dense);
      s.loops->solver.hold(rows.dense);
      take_from(scene.trees, rows.dense, column);
      row.by_loops[k] = s.loops->solver.mu;
    }
    row.by_launch[k] = row.of_launch[k] = 0;
    if (!is_matched(&work.line)) continue;
    row.by_launch[k] = -dot(scene.trees, column, work.line.row) / work.line.own;
    row.of_launch[k] = dot(scene.trees, row.rate[k], work.line.column);
  }
}

Mat3 block_of(const Row& at, int at_rates, const Row& by, int by_rates) {
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < at_rates; ++i) {
    for (int j = 0; j < by_rates; ++j) {
      block(i, j) = dot(at.rate[i], by.column[j]) + at.of_launch[i] * by.by_launch[j];
    }
  }
  return block;
}

/// A launch couples all rows.
void set_blocks(const Scene& scene, const Node& node, bool is_launched, Rows& rows) {
  ContactBlocks& W = rows.W;
  clear_blocks(W);
  const int m = static_cast<int>(rows.active.size());
  const auto row = [&](int i) -> const ContactVector& {
    return contact_of(node, active_row(rows, static_cast<std::size_t>(i))).n;
  };
  rows.neighbours.list(m, row);
  for (int j = 0; j < m; ++j) {
    const Row& by = active_row(rows, static_cast<std::size_t>(j));
    const int rates = contact_of(node, by).rates();
    const auto add_block = [&](int i) {
      const Row& at = active_row(rows, static_cast<std::size_t>(i));
      W.contact.push_back(i);
      W.block.push_back(block_of(at, contact_of(node, at).rates(), by, rates));
      if (i == j) W.own.push_back((W.block.back() + W.block.back().transpose()) / 2);
    };
    W.start.push_back(static_cast<int>(W.contact.size()));
    if (!is_launched) {
      const auto used = static_cast<std::size_t>(rates);
      const std::array<const ContactVector*, 3> C{&by.rate[0], &by.rate[1], &by.rate[2]};
      const std::array<const ContactVector*, 3> R{&by.column[0], &by.column[1], &by.column[2]};
      add_factors(scene.trees, std::span(C).first(used), std::span(R).first(used), W);
    }
    if (is_launched) {
      for (int i = 0; i < m; ++i) add_block(i);
    } else {
      for (const int i : rows.neighbours.of(row(j))) add_block(i);
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

double set_row_residual(const Scene& scene, const Node& node, ArcWork& work) {
  Rows& rows = work.rows;
  Arc& arc = work.arc;
  add_impulses(scene, node, rows);
  const ArcProblem problem = arc_problem(scene, arc.tau, node, work);
  arc.residual = momentum_residual(scene.model, problem, arc.v, work.scratch);
  if (!std::isfinite(arc.residual)) return arc.residual;
  // forces cancel, their rounding does not
  constexpr double tiny = std::numeric_limits<double>::min();
  const auto size = work.scratch.scale.array() + rows.size.array() + tiny;
  arc.residual = std::max((work.scratch.r.array().abs() / size).maxCoeff(),
                          line_residual(scene.model, problem, arc.v, work.scratch));
  if (problem.loops != nullptr) {
    arc.residual = std::max(arc.residual, loop_residual(scene.model, problem, arc.v, work.scratch));
  }
  return arc.residual;
}

bool step_row_rates(const Scene& scene, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  ArcScratch& s = work.scratch;
  Arc& arc = work.arc;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, arc.tau, s.J)) return false;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
  const ArcProblem problem = arc_problem(scene, arc.tau, node, work);
  if (is_matched(&work.line)) take_out_line(model, problem, arc.v, s);
  if (problem.loops != nullptr && !take_out_loops(model, problem, s)) return false;
  arc.v += s.dv;
  if (s.has_forces) shorten(model, problem, arc, s);
  if (!arc.v.allFinite()) return false;
  set_row_rates(scene, node, work);
  return true;
}

void set_row_blocks(const Scene& scene, const Node& node, ArcWork& work) {
  Rows& rows = work.rows;
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    Row& row = active_row(rows, i);
    linearize(scene, contact_of(node, row), work, row);
  }
  set_blocks(scene, node, is_matched(&work.line), rows);
}

}  // namespace saltus
