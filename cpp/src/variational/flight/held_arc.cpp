#include "variational/flight/held_arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/flight/impact_time.hpp"
#include "variational/flight/row_blocks.hpp"

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
    row.p = rows.p[k][0] > 1e-13 * size ? rows.p[k] : Vec3::Zero();
  }
}

/// What a change of the impulses does to the arc's velocity, by the linearised arc.
void add_change(Flight& f) {
  Rows& rows = f.rows;
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    const Vec3 dp = rows.p[i] - rows.before[i];
    const Row& row = active_row(rows, i);
    f.arc.v += dp[0] * row.column[0];
    if (rows.W.friction[i] > 0) f.arc.v += dp[1] * row.column[1] + dp[2] * row.column[2];
    if (f.is_launched) f.launch.lambda += row.by_launch.dot(dp);
  }
}

bool solve_rounds(const ModelData& model, const StepOptions& options, double tau, const Node& node,
                  Flight& f) {
  Rows& rows = f.rows;
  take_impulses(tau, rows);
  f.arc.tau = tau;
  bool is_solved = false;  // that is, the impulses are lawful for the v that belongs to them
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0, idle = 0;; ++round) {
    f.arc.iterations = round;
    const Lawlessness now = set_row_rates(model, options, node, f);
    rows.residual = now.least();
    const bool ends = round == most_rounds || idle == most_idle;
    const bool meets_arc = f.arc.residual <= most_residual;
    if (meets_arc && ends && rows.residual <= large_residual) break;
    if (meets_arc && is_solved && is_lawful(now, before, rows.active.size())) break;
    if (ends || !std::isfinite(now.residual) || !set_row_blocks(model, options, node, f)) {
      const int worst = most_lawless(rows.W, rows.u, rows.p);
      f.closing = active_row(rows, static_cast<std::size_t>(worst)).place;
      return false;
    }
    const Lawlessness law = lawlessness(rows.W, rows.u, rows.p);
    is_solved = is_lawful(law, before, rows.active.size());
    idle = law.residual > before / 2 ? idle + 1 : 0;
    before = law.residual;
    if (is_solved) continue;
    rows.before = rows.p;
    settle_for_sure(rows.W, rows.pile, rows.u, rows.p, 1e-4);  // the next round finds the rest
    add_change(f);
  }
  finish_arc(model, held_arc_problem(options, tau, node, f), f.arc, f.scratch);
  give_impulses(rows);
  return true;
}

}  // namespace

bool solve_held_arc(const ModelData& model, const StepOptions& options, double tau,
                    const Node& node, Flight& f) {
  if (solve_rounds(model, options, tau, node, f)) return true;
  forget_impulses(f.rows);
  f.launch.lambda = 0;
  f.arc.v = node.v;
  return solve_rounds(model, options, tau, node, f);
}

}  // namespace saltus
