// Writes rows of a trajectory, with energies, without allocating.
#pragma once

#include "saltus/rollout/batch.hpp"
#include "saltus/rollout/trajectory.hpp"
#include "variational/arc/energy_meter.hpp"

namespace saltus {

/// @throws StepError where the mass matrix is singular
void measure(const ModelData& model, const State& state, double h, EnergyMeter& meter);

/// Shapes a trajectory for `rows` rows.
Trajectory empty_trajectory(const Model& model, Eigen::Index rows);

/// Cuts it to the first `rows` rows.
void truncate(Trajectory& run, Eigen::Index rows);

/// Where the rows of one run go: all of a trajectory's, or a batch's share.
struct RunRows {
  Eigen::Ref<MatX> q, v, p;                     ///< (rows, n_q)
  Eigen::Ref<MatX> control, work;               ///< (rows, n_u), (rows, n_u + 3)
  Eigen::Ref<VecX> kinetic, potential, shadow;  ///< (rows) [J]
};

void record(const State& state, const EnergyMeter& meter, Eigen::Index row, RunRows& rows);

/// Contacts of steps after the last row are left out.
void take_outcome(RunOutcome&& outcome, Trajectory& run);

/// As Trajectory::energy_error; all are of as many rows.
double energy_error(const VecRef& kinetic, const VecRef& potential,
                    const Eigen::Ref<const MatX>& work);

}  // namespace saltus
