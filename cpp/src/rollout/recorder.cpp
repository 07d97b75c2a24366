#include "rollout/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/rollout/simulate.hpp"

namespace saltus {

EnergyMeter::EnergyMeter(const ModelData& model)
    : energy{0, 0, 0},
      w(model.packed),
      M(model.tree, model.packed),
      free(model.tree, model.packed) {
  v.setZero(model.tree.coordinates);
}

void measure(const ModelData& model, const State& state, double h, EnergyMeter& m) {
  const Tree& tree = model.tree;
  const PackedTree& packed = model.packed;
  set_coordinates(tree, packed, state.q, m.w);
  place(packed, m.w);
  mass_pass(packed, m.w);
  if (!factorize(tree, packed, m.w, 0, m.M)) {
    throw StepError("the mass matrix is singular at this configuration", state.t, 0, 0);
  }
  m.v = state.p;
  solve(tree, packed, m.M, m.v);

  set_rates(tree, packed, m.v, m.w);
  move(packed, m.w);
  first_pass(packed, m.w);
  second_pass(packed, m.w);
  free_motion(tree, packed, m.w, m.M, m.free);

  m.energy.kinetic = 0.5 * state.p.dot(m.v);
  m.energy.potential = potential_energy(packed, m.w);
  m.energy.shadow = m.energy.kinetic + m.energy.potential - h * h * m.free.kappa / 24;
}

Energies energies(const Model& model, const State& state, double h) {
  check_vector(state.q, model.n_q(), "state.q");
  check_vector(state.p, model.n_q(), "state.p");
  EnergyMeter meter(*model);
  measure(*model, state, h, meter);
  return meter.energy;
}

Trajectory empty_trajectory(const Model& model, Eigen::Index rows) {
  Trajectory run{model, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, 0, 0, false};
  for (VecX* x : {&run.t, &run.kinetic, &run.potential, &run.shadow}) x->setZero(rows);
  for (MatX* x : {&run.q, &run.v, &run.p}) x->setZero(rows, model.n_q());
  return run;
}

void truncate(Trajectory& run, Eigen::Index rows) {
  for (VecX* x : {&run.t, &run.kinetic, &run.potential, &run.shadow}) x->conservativeResize(rows);
  for (MatX* x : {&run.q, &run.v, &run.p}) x->conservativeResize(rows, Eigen::NoChange);
}

void record(const State& state, const EnergyMeter& meter, Eigen::Index row, Rows& rows) {
  rows.q.row(row) = state.q;
  rows.v.row(row) = meter.v;
  rows.p.row(row) = state.p;
  rows.kinetic[row] = meter.energy.kinetic;
  rows.potential[row] = meter.energy.potential;
  rows.shadow[row] = meter.energy.shadow;
}

void take_outcome(RunOutcome&& outcome, Trajectory& run) {
  run.impacts = std::move(outcome.impacts);
  run.impulses = std::move(outcome.impulses);
  run.iterations = outcome.iterations;
  run.residual = outcome.residual;
  run.complete = outcome.complete;
}

double energy_error(const VecRef& kinetic, const VecRef& potential) {
  if (kinetic.size() == 0) return 0;
  const VecX H = kinetic + potential;
  const double error = (H.array() - H[0]).abs().maxCoeff(), scale = kinetic.maxCoeff();
  // where nothing moves, both are the rounding of the potential
  const double rounding =
      32 * std::numeric_limits<double>::epsilon() * potential.cwiseAbs().maxCoeff();
  return error <= rounding && scale <= rounding ? 0 : error / scale;
}

double Trajectory::energy_error() const { return saltus::energy_error(kinetic, potential); }

}  // namespace saltus
