#include "variational/flight/launch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/flight/impact_time.hpp"

namespace saltus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Something rests with friction.
bool has_friction_rows(const Node& node, const Flight& f) {
  return std::any_of(f.rows.active.begin(), f.rows.active.end(),
                     [&](int i) { return node.contacts[f.rows.row[i].contact].friction > 0; });
}

bool match_arc(const ModelData& model, const StepOptions& options, double left, Node& node,
               Flight& f) {
  const double energy = arc_energy(model, arc_problem(options, left, node, f), f.arc, f.scratch);
  const double mismatch = std::abs(energy - node.launch.energy);
  if (node.launch.normal_energy <= mismatch) return false;
  f.launch.n = node.launch.n;
  f.launch.energy = node.launch.energy;
  f.launch.lambda = 0;
  f.is_launched = true;
  f.start_v = f.arc.v;
  if (solve_flight_arc(model, options, left, node, f)) return true;
  f.is_launched = false;  // no root after all: back to the nodal arc, which is its own guess
  f.arc.v = f.start_v;
  solve_flight_arc(model, options, left, node, f);
  return false;
}

/// How far the end of the arc just solved, the step's, is from the energy to match; infinity where
/// there is no number.
double shadow_mismatch(const ModelData& model, const StepOptions& options, const Node& node,
                       Flight& f) {
  if (!measure(model, f.arc.q_end, f.arc.p_end, options.h, *f.meter)) return infinity;
  return f.meter->energy.shadow - node.launch.energy;
}

/// A change of the momentum at the node by delta n.
void kick(const ModelData& model, double delta, Node& node, Flight& f) {
  node.p += delta * node.launch.n;
  node.launch.change += delta;
  f.n = node.launch.n;
  solve(model.tree, model.packed, node.M, f.n);
  node.v += delta * f.n;
  f.arc.v += delta * f.n;
}

/// Secant method on delta. The slope of H at the impact, n.v, is a good first one: the energy that
/// differs is of order h^2.
bool match_shadow(const ModelData& model, const StepOptions& options, double left, Node& node,
                  Flight& f) {
  constexpr int most_iterations = 8;
  const double start = shadow_mismatch(model, options, node, f);
  double slope = node.launch.n.dot(node.v), mismatch = start, total = 0;
  // 1e-15: the rounding of the energies that the mismatch is a difference of
  const auto is_rounding = [&](double x) {
    return std::abs(x) <= 1e-15 * (f.meter->energy.kinetic + std::abs(f.meter->energy.potential));
  };
  if (is_rounding(start)) return true;
  if (!f.rows.active.empty() || !(node.launch.normal_energy > std::abs(start)) || !(slope > 0))
    return false;
  for (int k = 0; k < most_iterations; ++k) {
    const double delta = -mismatch / slope;
    kick(model, delta, node, f);
    total += delta;
    const bool solved = solve_flight_arc(model, options, left, node, f);
    const double after = solved ? shadow_mismatch(model, options, node, f) : infinity;
    const bool done = is_rounding(after) || !(std::abs(after) < std::abs(mismatch) / 2);
    slope = (after - mismatch) / delta;
    mismatch = after;
    if (done) break;
  }
  if (is_rounding(mismatch) || std::abs(mismatch) <= 1e-3 * std::abs(start)) return true;
  kick(model, -total, node, f);
  solve_flight_arc(model, options, left, node, f);
  return false;
}

}  // namespace

bool drop_launch(const Node& node, Flight& f) {
  if (!f.is_launched) return false;
  f.is_launched = false;
  forget_impulses(f.rows);
  f.arc.v = node.v;
  return true;
}

bool launch(const ModelData& model, const StepOptions& options, double left, Node& node,
            Flight& f) {
  node.launch.pending = false;
  if (has_friction_rows(node, f)) return false;  // their impulses are all that is sought
  if (options.law == ImpactLaw::shadow_energy) return match_shadow(model, options, left, node, f);
  return match_arc(model, options, left, node, f);
}

}  // namespace saltus
