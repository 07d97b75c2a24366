#include "rollout/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/rollout/simulate.hpp"

namespace saltus {

void measure(const ModelData& model, const State& state, double h, EnergyMeter& meter) {
  if (measure(model, state.q, state.p, h, meter)) return;
  throw StepError("the mass matrix is singular at this configuration", state.t, 0, 0);
}

Energies energies(const Model& model, const State& state, double h) {
  const VecX q = model.checked_q(state.q, "state.q");
  check_vector(state.p, model.n_v(), "state.p", "velocities");
  EnergyMeter meter(*model);
  measure(*model, {state.t, q, state.p}, h, meter);
  return meter.energy;
}

Trajectory empty_trajectory(const Model& model, Eigen::Index rows) {
  Trajectory run{.model = model};
  for (VecX* x : {&run.t, &run.kinetic, &run.potential, &run.shadow}) x->setZero(rows);
  run.q.setZero(rows, model.n_q());
  for (MatX* x : {&run.v, &run.p}) x->setZero(rows, model.n_v());
  run.control.setZero(rows, model->forces.n_u());
  run.work.setZero(rows, model->forces.n_u() + 3);
  return run;
}

void truncate(Trajectory& run, Eigen::Index rows) {
  for (VecX* x : {&run.t, &run.kinetic, &run.potential, &run.shadow}) x->conservativeResize(rows);
  for (MatX* x : {&run.q, &run.v, &run.p, &run.control, &run.work}) {
    x->conservativeResize(rows, Eigen::NoChange);
  }
}

void record(const State& state, const EnergyMeter& meter, Eigen::Index row, RunRows& rows) {
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
  run.settlings = std::move(outcome.settlings);
  run.fallbacks = std::move(outcome.fallbacks);
  run.certificates = std::move(outcome.certificates);
  run.contacts = std::move(outcome.contacts);
  if (run.contacts) {
    std::erase_if(*run.contacts,
                  [&](const RecordedContact& each) { return each.row >= outcome.rows; });
  }
  run.iterations = outcome.iterations;
  run.residual = outcome.residual;
  run.complete = outcome.complete;
}

double energy_error(const VecRef& kinetic, const VecRef& potential,
                    const Eigen::Ref<const MatX>& work) {
  if (kinetic.size() == 0) return 0;
  const VecX H = kinetic + potential - work.rowwise().sum();
  const double error = (H.array() - H[0]).abs().maxCoeff(), scale = kinetic.maxCoeff();
  // where nothing moves, both are the rounding of the potential
  const double rounding =
      32 * std::numeric_limits<double>::epsilon() * potential.cwiseAbs().maxCoeff();
  return error <= rounding && scale <= rounding ? 0 : error / scale;
}

double Trajectory::energy_error() const { return saltus::energy_error(kinetic, potential, work); }

}  // namespace saltus
