// Many steps in a row, recorded.
#pragma once

#include <functional>

#include "saltus/rollout/control.hpp"
#include "saltus/rollout/trajectory.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus {

/// Of a run: of its steps, and what is recorded.
struct SimulateOptions {
  StepOptions step = {};         ///< of every step
  int record_every = 1;          ///< steps between recorded rows; the last is always one
  bool record_contacts = false;  ///< Trajectory::contacts, of all steps
  Policy policy = {};            ///< none: controls are 0
  int control_every = 1;         ///< steps between the times that it is asked
  /// Called about ten times a second of wall time with the part done in [0, 1]; false stops the
  /// run, which then holds what was done so far.
  std::function<bool(double)> progress = {};
};

/// Runs round(duration / h) steps from `start`; row 0 is `start`.
/// @throws ModelError on options of the step out of range, a duration that is not positive and
///         finite, or no whole number of steps (to 1e-9); rows and contacts of more than 16 GB;
///         what Stepper::advance throws.
SALTUS_EXPORT Trajectory simulate(const Model& model, const State& start, double duration,
                                  const SimulateOptions& options = {});

/// The same where nothing but the step has options: simulate(model, start, 10, {.h = 0.001}).
SALTUS_EXPORT Trajectory simulate(const Model& model, const State& start, double duration,
                                  const StepOptions& step);

/// The same, written to `out`. Where a step throws, `out` holds the rows up to the last before it
/// and is not `complete`; where the numbers make no run, `out` is as it was.
SALTUS_EXPORT void simulate(const Model& model, const State& start, double duration,
                            const SimulateOptions& options, Trajectory& out);

/// Energies at one state; the shadow energy H - h^2 kappa / 24 is what a fixed step h conserves to
/// O(h^4), kappa = a^T M a - v^T L_qq v with a the free acceleration (theory, section 5).
SALTUS_EXPORT Energies energies(const Model& model, const State& state, double h);

}  // namespace saltus
