// The gradient of a cost of a run: the adjoint of its steps, from the last to the first.
#pragma once

#include <functional>

#include "saltus/derivatives/step_derivative.hpp"

namespace saltus {

/// Of a cost of a run, by what the run was made from.
struct RunGradient {
  VecX q;               ///< (n_v) of the state that it started from, along velocities
  VecX p;               ///< (n_v) of the same
  MatX control;         ///< (rows - 1, n_u), or (steps, n_u) where it was told by step
  MatX qfrc;            ///< (rows - 1, n_v) [1/(N m) | 1/N] by forces on the coordinates
  MatX forces;          ///< (rows - 1, 3 wrenches) [1/N] by the force of each wrench
  MatX torques;         ///< (rows - 1, 3 wrenches) [1/(N m)] by its torque
  double h = 0;         ///< [1/s] by the duration of all steps alike
  ModelGradient model;  ///< by what the model is made of, p of the start held
};

/// The rows of a run: its start, one each so many steps, and its end.
struct RunRows {
  VecX t;        ///< (rows) [s]
  MatX q;        ///< (rows, n_q)
  MatX p;        ///< (rows, n_v)
  MatX control;  ///< (rows, n_u) of the steps from this row on; the last is not used
  VecX qfrc;     ///< (n_v) applied in all steps, or empty: 0
  std::vector<AppliedWrench> wrenches;  ///< likewise
  Eigen::Index every = 1;               ///< steps from row to row
  Eigen::Index steps = 0;               ///< of the run; 0: `every` times rows - 1
  MatX by_step;  ///< (steps, n_u) the controls of each step, or empty: as `control` says
};

/// q_hat and p_hat (rows, n_v) are the derivatives of the cost by each row's state. The steps are
/// made once more, forwards, and their tapes kept for as long as they take little memory: of a
/// longer run part by part, each from the run's own row. Two steps of work a step, about. Rows that
/// are many steps apart are checkpoints: where more steps are between them than tapes are kept of,
/// these are made twice more, with a state kept for each part.
/// @param goes_on asked every 256 steps: what it throws ends all; may be empty
/// @throws ModelError on rows that do not fit the model, or what was applied; where a step has no
/// derivative, which one and why; what Stepper::advance throws
SALTUS_EXPORT RunGradient adjoint(const Model& model, const StepOptions& options,
                                  const RunRows& rows, const MatX& q_hat, const MatX& p_hat,
                                  const std::function<void()>& goes_on = {});

}  // namespace saltus
