// Writes rows of a trajectory, with energies, without allocating.
#pragma once

#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/rollout/trajectory.hpp"

namespace saltus {

/// Velocity and energies of one state; scratch.
struct EnergyMeter {
  explicit EnergyMeter(const ModelData& model);

  VecX v;           ///< (n_q) written by measure
  Energies energy;  ///< written by measure

  Packed w;
  PackedMatrix M;
  PackedProducts products;
  VecX L_q, L_vq_v, L_qq_v, force, a;
};

/// @throws StepError where the mass matrix is singular
void measure(const ModelData& model, const State& state, double h, EnergyMeter& meter);

/// Shapes a trajectory for `rows` rows.
Trajectory empty_trajectory(const Model& model, Eigen::Index rows);

/// Cuts it to the first `rows` rows.
void truncate(Trajectory& run, Eigen::Index rows);

void record(const State& state, double t, const EnergyMeter& meter, Eigen::Index row,
            Trajectory& run);

}  // namespace saltus
