// Writes rows of a trajectory, with energies, without allocating.
#pragma once

#include "saltus/lagrangian/shadow.hpp"
#include "saltus/rollout/batch.hpp"
#include "saltus/rollout/trajectory.hpp"

namespace saltus {

/// Velocity and energies of one state; scratch.
struct EnergyMeter {
  explicit EnergyMeter(const ModelData& model);

  VecX v;           ///< (n_q) written by measure
  Energies energy;  ///< written by measure

  Packed w;
  PackedMatrix M;
  FreeMotion free;
};

/// @throws StepError where the mass matrix is singular
void measure(const ModelData& model, const State& state, double h, EnergyMeter& meter);

/// Shapes a trajectory for `rows` rows.
Trajectory empty_trajectory(const Model& model, Eigen::Index rows);

/// Cuts it to the first `rows` rows.
void truncate(Trajectory& run, Eigen::Index rows);

/// Where the rows of one run go: all of a trajectory's, or a batch's share.
struct Rows {
  Eigen::Ref<MatX> q, v, p;                     ///< (rows, n_q)
  Eigen::Ref<VecX> kinetic, potential, shadow;  ///< (rows) [J]
};

void record(const State& state, const EnergyMeter& meter, Eigen::Index row, Rows& rows);

void take_outcome(RunOutcome&& outcome, Trajectory& run);

/// As Trajectory::energy_error; both are (rows).
double energy_error(const VecRef& kinetic, const VecRef& potential);

}  // namespace saltus
