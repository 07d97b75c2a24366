#include "variational/arc/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/arc/row_blocks.hpp"

namespace saltus {
namespace {

constexpr int most_rounds = 40;  ///< 2 to 6 are usual
constexpr int most_idle = 8;     ///< rounds that do not halve what is unlawful

/// To rounding, which grows with what holds each other; or where redundant contacts that turn keep
/// from it, as far as it will go.
/// @param before the residual of the round before
bool is_lawful(const Lawlessness& law, double before, std::size_t contacts) {
  if (law.residual <= 1e-15 * static_cast<double>(contacts)) return true;
  return law.residual > before / 2 && law.least() <= small_residual;
}

void take_impulses(double tau, Rows& rows) {
  scale_impulses(tau, rows);
  rows.p.clear();
  rows.W.own.clear();
  for (std::size_t k = 0; k < rows.active.size(); ++k) rows.p.push_back(active_row(rows, k).p);
}

/// Impulses to the rows; those too small to press are none.
void give_impulses(Rows& rows) {
  double size = 0;
  for (const Vec3& p : rows.p) size = std::max(size, p[0]);
  for (std::size_t k = 0; k < rows.active.size(); ++k) {
    Row& row = active_row(rows, k);
    row.p = row.is_joint() || rows.p[k][0] > 1e-13 * size ? rows.p[k] : Vec3::Zero();
    const double most = rows.W.friction[k] * row.p[0];
    row.slides = most > 0 && row.p.tail<2>().norm() >= (1 - 1e-9) * most &&
                 rows.u[k].tail<2>().norm() > rows.W.rest[k];
  }
}

/// What a change of the impulses does to the arc's velocity, by the linearised arc.
void add_change(ArcWork& work) {
  Rows& rows = work.rows;
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    const Vec3 dp = rows.p[i] - rows.before[i];
    const Row& row = active_row(rows, i);
    work.arc.v += dp[0] * row.column[0];
    if (rows.W.friction[i] > 0) work.arc.v += dp[1] * row.column[1] + dp[2] * row.column[2];
    if (is_matched(&work.line)) work.line.lambda += row.by_launch.dot(dp);
    if (!work.scratch.loops) continue;
    const int rates = rows.W.friction[i] > 0 ? 3 : 1;
    for (int k = 0; k < rates; ++k) work.scratch.loops->mu += dp[k] * row.by_loops[k];
  }
}

void stand_still(const Scene& scene, const Node& node, ArcWork& work) {
  Rows& rows = work.rows;
  rows.sticking.assign(scene.trees.of.size(), 0);
  for (std::size_t k = 0; k < rows.active.size(); ++k) {
    const Row& row = active_row(rows, k);
    if (!row.is_joint()) continue;
    note_sticking(contact_of(node, row), rows.p[k][0], rows.W.bound_of(static_cast<int>(k)),
                  rows.u[k][0], rows.W.own[k](0, 0), rows.sticking);
  }
  still_trees(scene, rows.sticking, work.arc.v);
}

bool solve_held(const Scene& scene, double tau, const Node& node, ArcWork& work) {
  Rows& rows = work.rows;
  Arc& arc = work.arc;
  take_impulses(tau, rows);
  arc.tau = tau;
  bool is_solved = false;  // that is, the impulses are lawful for the v that belongs to them
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0, idle = 0;; ++round) {
    arc.iterations = round;
    const Lawlessness now = set_row_rates(scene, node, work);
    rows.residual = now.least();
    const bool ends = round == most_rounds || idle == most_idle;
    const bool meets_arc = arc.residual <= most_residual;
    if (meets_arc && ends && rows.residual <= large_residual) break;
    if (meets_arc && is_solved && is_lawful(now, before, rows.active.size())) break;
    if (ends || !std::isfinite(now.residual) || !set_row_blocks(scene, node, work)) {
      const int worst = most_lawless(rows.W, rows.u, rows.p);
      work.unlawful = active_row(rows, static_cast<std::size_t>(worst)).slot;
      return false;
    }
    const Lawlessness law = lawlessness(rows.W, rows.u, rows.p);
    is_solved = is_lawful(law, before, rows.active.size());
    idle = law.residual > before / 2 ? idle + 1 : 0;
    before = law.residual;
    if (is_solved) continue;
    rows.before = rows.p;
    settle_for_sure(rows.W, rows.pile, rows.u, rows.p, 1e-4);  // the next round finds the rest
    add_change(work);
  }
  if (!node.dry.empty()) stand_still(scene, node, work);
  finish_arc(scene.model, arc_problem(scene, tau, node, work), arc, work.scratch);
  give_impulses(rows);
  return true;
}

}  // namespace

ArcWork::ArcWork(const Scene& scene) : rows(scene), scratch(scene.model, scene.options.law) {
  const Tree& tree = scene.model.tree;
  for (VecX* x : {&arc.q_start, &arc.q_end}) x->setZero(tree.n_q);
  for (VecX* x : {&arc.v, &arc.p_end, &line.n, &line.row, &line.column}) x->setZero(tree.n_v);
}

ArcProblem arc_problem(const Scene& scene, double tau, const Node& node, ArcWork& work) {
  const bool has_line = work.line.use != LaunchLine::Use::none;
  const VecX& p = work.rows.active.empty() ? node.p : work.rows.momentum;
  ArcLoops* loops = nullptr;
  if (work.scratch.loops) {
    loops = &*work.scratch.loops;
    loops->A = &node.loops.values.A;
  }
  return {node.q, p, tau, has_line ? &work.line : nullptr, scene.whole_step(), node.t, loops};
}

bool solve(const Scene& scene, double tau, const Node& node, ArcWork& work) {
  if (work.scratch.loops) work.scratch.loops->mu.setZero();
  if (work.rows.active.empty()) {
    const bool converged = solve_arc(scene.model, arc_problem(scene, tau, node, work),
                                     scene.options.max_iterations, work.arc, work.scratch);
    work.iterations += work.arc.iterations;
    return converged;
  }
  bool converged = solve_held(scene, tau, node, work);
  work.iterations += work.arc.iterations;
  if (converged) return true;
  forget_impulses(work.rows);
  if (is_matched(&work.line)) work.line.lambda = 0;
  if (work.scratch.loops) work.scratch.loops->mu.setZero();
  work.arc.v = node.v;
  converged = solve_held(scene, tau, node, work);
  work.iterations += work.arc.iterations;
  return converged;
}

}  // namespace saltus
