#include "variational/flight/launch.hpp"

#include <cmath>
#include <limits>

#include "variational/flight/friction_arc.hpp"
#include "variational/flight/impact_time.hpp"

namespace saltus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool match_arc(const ModelData& model, const StepOptions& options, double left, Node& node,
               Flight& f) {
  const double energy = arc_energy(model, arc_problem(options, left, node, f), f.arc, f.scratch);
  const double mismatch = std::abs(energy - node.launch.energy);
  if (node.launch.normal_energy <= mismatch || f.active == most_constraints) return false;
  next_constraint(f, ArcConstraint::Kind::launch, -1, node.launch.energy).n = node.launch.n;
  f.start_v = f.arc.v;
  if (solve_flight_arc(model, options, left, node, f)) return true;
  --f.active;  // no root after all: back to the nodal arc, which is its own guess
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
  if (f.active > 0 || !(node.launch.normal_energy > std::abs(start)) || !(slope > 0)) return false;
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

ArcConstraint fresh_constraint(const ModelData& model) {
  ArcConstraint c;
  c.face.chain.reserve(static_cast<std::size_t>(model.tree.joints()));
  for (VecX* x : {&c.n, &c.row, &c.column}) x->setZero(model.tree.n_v);
  return c;
}

ArcConstraint& next_constraint(Flight& f, ArcConstraint::Kind kind, int place, double target) {
  ArcConstraint& c = f.constraints[f.active++];
  c.kind = kind;
  c.place = place;
  c.target = target;
  c.lambda = 0;
  return c;
}

bool drop_launch(const Node& node, Flight& f) {
  for (int i = 0; i < f.active; ++i) {
    if (f.constraints[i].kind != ArcConstraint::Kind::launch) continue;
    std::swap(f.constraints[i], f.constraints[--f.active]);
    for (int k = 0; k < f.active; ++k) f.constraints[k].lambda = 0;
    f.arc.v = node.v;
    return true;
  }
  return false;
}

bool launch(const ModelData& model, const StepOptions& options, double left, Node& node,
            Flight& f) {
  node.launch.pending = false;
  if (needs_friction_arc(node)) return false;  // its impulses are all that is sought
  if (options.law == ImpactLaw::shadow_energy) return match_shadow(model, options, left, node, f);
  return match_arc(model, options, left, node, f);
}

}  // namespace saltus
