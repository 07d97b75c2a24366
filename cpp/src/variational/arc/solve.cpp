#include "variational/arc/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/arc/row_blocks.hpp"
#include "variational/arc/row_rates.hpp"

namespace saltus {
namespace {

constexpr int most_rounds = 40;  ///< 2 to 6 are usual
constexpr int most_idle = 8;     ///< rounds that do not halve what is unlawful
constexpr int idle_at_once = 3;  ///< of them, where impulses do not either: 2 such are enough

/// To rounding, which grows with what holds each other; or where redundant contacts that turn keep
/// from it, as far as it will go.
/// @param before the residual of the round before
bool is_lawful(const Lawlessness& law, double before, std::size_t contacts) {
  if (law.residual <= 1e-15 * static_cast<double>(contacts)) return true;
  return law.residual > before / 2 && law.least() <= small_residual;
}

/// Lawful but for the rounding of gaps, which is much of a rate in a short arc.
bool is_rounding(const Node& node, const Rows& rows) {
  double size = 0;
  for (std::size_t k = 0; k < rows.active.size(); ++k) {
    size = std::max(size, rows.p[k].cwiseAbs().maxCoeff() / scale_of(rows.W.own[k]));
  }
  for (std::size_t k = 0; k < rows.active.size(); ++k) {
    const Row& row = rows.row[rows.active[k]];
    const double rounding = row.is_joint() ? 0 : gap_rounding(contact_of(node, row), *row.pair);
    const double off = lawlessness_of(rows.W, static_cast<int>(k), rows.u[k], rows.p[k]);
    if (!(off <= 1e-15 * size + scale_of(rows.W.own[k]) * rounding / rows.tau)) return false;
  }
  return true;
}

/// Impulses and what W has but blocks; of those W_ii, if all rows know theirs of the arc before.
void take_impulses(const Node& node, double tau, Rows& rows) {
  scale_impulses(tau, rows);
  rows.p.clear();
  ContactBlocks& W = rows.W;
  clear(W);
  for (std::size_t k = 0; k < rows.active.size(); ++k) {
    const Row& row = active_row(rows, k);
    const Contact& c = contact_of(node, row);
    rows.p.push_back(row.p);
    W.friction.push_back(c.friction);
    // a hundredth of what touches is closed, over the arc
    const double closed = row.is_joint() ? 0 : 1e-2 * row.pair->touch / tau;
    W.rest.push_back(std::max(c.epsilon_u, closed));
    W.bound.push_back(row.is_joint() ? tau / 2 * node.dry_force[row.dry] : 0);
    if (W.own.size() == k && !row.own.isZero(0)) W.own.push_back(row.own);
  }
  if (W.own.size() < rows.active.size()) W.own.clear();
}

/// Impulses to the rows; those too small to press are none.
void give_impulses(Rows& rows) {
  double size = 0;
  for (const Vec3& p : rows.p) size = std::max(size, p[0]);
  for (std::size_t k = 0; k < rows.active.size(); ++k) {
    Row& row = active_row(rows, k);
    row.own = rows.W.own[k];
    row.p = row.is_joint() || rows.p[k][0] > 1e-13 * size ? rows.p[k] : Vec3::Zero();
    const double most = rows.W.friction[k] * row.p[0];
    row.slides = most > 0 && row.p.tail<2>().norm() >= (1 - 1e-9) * most &&
                 rows.u[k].tail<2>().norm() > rows.W.rest[k];
  }
}

/// What a change of the impulses does to the arc's velocity, by the linearised arc.
void add_change(const Scene& scene, ArcWork& work) {
  Rows& rows = work.rows;
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    const Vec3 dp = rows.p[i] - rows.before[i];
    const Row& row = active_row(rows, i);
    const int rates = rows.W.friction[i] > 0 ? 3 : 1;
    for (int k = 0; k < rates; ++k) add(scene.trees, dp[k], row.column[k], work.arc.v);
    if (is_matched(&work.line)) {
      const double dlambda = row.by_launch.head(rates).dot(dp.head(rates));
      work.line.lambda += dlambda;
      work.arc.v += dlambda * work.line.column;
    }
    if (!work.scratch.loops) continue;
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

void note_unlawful(const Rows& rows, ArcWork& work) {
  if (rows.W.size() != static_cast<int>(rows.u.size())) return;
  const int worst = most_lawless(rows.W, rows.u, rows.p);
  work.unlawful = rows.row[rows.active[static_cast<std::size_t>(worst)]].slot;
}

bool solve_held(const Scene& scene, double tau, const Node& node, ArcWork& work) {
  Rows& rows = work.rows;
  Arc& arc = work.arc;
  take_impulses(node, tau, rows);
  arc.tau = tau;
  bool is_solved = false;  // that is, the impulses are lawful for the v that belongs to them
  Lawlessness law;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0, idle = 0;; ++round) {
    arc.iterations = round;
    set_row_residual(scene, node, work);
    if (round > 0 && !is_solved) {  // else rates are not known yet, or are those of v
      look_at_rates(scene, node, work);
      law = lawlessness(rows.W, rows.u, rows.p);
    }
    const Lawlessness now{std::max(arc.residual, law.residual), std::max(arc.residual, law.excess)};
    rows.residual = now.least();
    const bool ends = round == most_rounds || idle >= most_idle;
    const bool meets_arc = arc.residual <= most_residual;
    if (meets_arc && ends && rows.residual <= large_residual) break;
    if (meets_arc && is_solved && is_lawful(now, before, rows.active.size())) break;
    work.is_rough = round > 0 && now.residual <= work.rough;
    if (work.is_rough) break;
    if (ends || !std::isfinite(now.residual) || !step_row_rates(scene, node, work)) {
      note_unlawful(rows, work);
      return false;
    }
    const bool knows_sizes = rows.W.own.size() == rows.active.size();
    if (!knows_sizes) set_row_blocks(scene, node, work);
    law = lawlessness(rows.W, rows.u, rows.p);
    // what rests goes on with the velocity and the impulses of the arc before, most often
    is_solved = is_lawful(law, before, rows.active.size()) || is_rounding(node, rows);
    idle = law.residual > before / 2 ? idle + 1 : 0;
    before = law.residual;
    if (is_solved) continue;
    if (knows_sizes) set_row_blocks(scene, node, work);  // not for what is lawful already
    rows.before = rows.p;
    // the next round finds the rest, with twice the digits
    const Settled found =
        settle_for_sure(rows.W, rows.pile, rows.u, rows.p, std::min(1e-2, law.residual));
    // rates that no impulses can end: the next round meets the same
    if (found.residual > law.residual / 2) idle += idle_at_once;
    add_change(scene, work);
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

bool guess_from_momenta(const Scene& scene, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  ArcScratch& s = work.scratch;
  s.is_placed = false;
  set_coordinates(model.tree, model.packed, node.q, s.w_end);
  place(model.packed, s.w_end);
  mass_pass(model.packed, s.w_end);
  if (!factorize(model.tree, model.packed, s.w_end, 0, s.J)) return false;
  work.arc.v = node.p;
  solve(model.tree, model.packed, s.J, work.arc.v);
  return work.arc.v.allFinite();
}

bool solve(const Scene& scene, double tau, const Node& node, ArcWork& work) {
  work.is_rough = false;
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
