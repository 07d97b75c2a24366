#include "variational/flight/launch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Something rests with friction.
bool has_friction_rows(const Node& node, const Rows& rows) {
  return std::any_of(rows.active.begin(), rows.active.end(), [&](int i) {
    const Row& row = rows.row[i];
    return row.is_joint() || contact_of(node, row).friction > 0;
  });
}

bool match_arc(const Scene& scene, double left, const Launch& launch, const Node& node, Flight& f) {
  ArcWork& work = f.work;
  const ArcProblem problem = arc_problem(scene, left, node, work);
  const double energy = arc_energy(scene.model, problem, work.arc, work.scratch);
  if (launch.normal_energy <= std::abs(energy - launch.energy)) return false;
  work.line.n = launch.n;
  work.line.energy = launch.energy;
  work.line.lambda = 0;
  work.line.use = LaunchLine::Use::matched;
  f.start_v = work.arc.v;
  if (solve(scene, left, node, work)) return true;
  work.line.use = LaunchLine::Use::none;  // no root: back to the nodal arc, which is its own guess
  work.arc.v = f.start_v;
  solve(scene, left, node, work);
  return false;
}

/// How far the end of the arc just solved, the step's, is from the energy to match; infinity where
/// there is no number.
double shadow_mismatch(const Scene& scene, const Launch& launch, Flight& f) {
  const Arc& arc = f.work.arc;
  if (!measure(scene.model, arc.q_end, arc.p_end, scene.options.h, *f.meter)) return infinity;
  return f.meter->energy.shadow - launch.energy;
}

/// Secant method on delta. The slope of H at the impact, n.v, is a good first one: the energy that
/// differs is of order h^2.
bool match_shadow(const Scene& scene, double left, const Launch& launch, const Node& node,
                  Flight& f) {
  constexpr int most_iterations = 8;
  ArcWork& work = f.work;
  const double start = shadow_mismatch(scene, launch, f);
  double slope = launch.n.dot(node.v), mismatch = start;
  // 1e-15: the rounding of the energies that the mismatch is a difference of
  const auto is_rounding = [&](double x) {
    return std::abs(x) <= 1e-15 * (f.meter->energy.kinetic + std::abs(f.meter->energy.potential));
  };
  if (is_rounding(start)) return true;
  if (!work.rows.active.empty() || !(launch.normal_energy > std::abs(start)) || !(slope > 0)) {
    return false;
  }
  work.line.n = launch.n;
  work.line.lambda = 0;
  work.line.use = LaunchLine::Use::given;
  f.start_v = work.arc.v;
  for (int k = 0; k < most_iterations; ++k) {
    const double delta = -mismatch / slope;
    work.line.lambda += delta;
    work.arc.v += delta * launch.response;
    const bool solved = solve(scene, left, node, work);
    const double after = solved ? shadow_mismatch(scene, launch, f) : infinity;
    const bool done = is_rounding(after) || !(std::abs(after) < std::abs(mismatch) / 2);
    slope = (after - mismatch) / delta;
    mismatch = after;
    if (done) break;
  }
  if (is_rounding(mismatch) || std::abs(mismatch) <= 1e-3 * std::abs(start)) return true;
  work.line.use = LaunchLine::Use::none;
  work.arc.v = f.start_v;
  solve(scene, left, node, work);
  return false;
}

}  // namespace

bool meet(const Scene& scene, double left, const Launch& launch, const Node& node, Flight& f) {
  // with friction its impulses are all that is sought, and forces do work on both sides
  if (has_friction_rows(node, f.work.rows) || f.work.scratch.has_forces) return false;
  if (scene.options.law == ImpactLaw::shadow_energy) {
    return match_shadow(scene, left, launch, node, f);
  }
  return match_arc(scene, left, launch, node, f);
}

void give_up(const Node& node, Flight& f) {
  f.work.line.use = LaunchLine::Use::none;
  f.has_missed_energy = true;
  forget_impulses(f.work.rows);
  f.work.arc.v = node.v;
}

}  // namespace saltus
