// One run, wherever its rows go: what simulate and simulate_batch share.
#pragma once

#include <functional>

#include "rollout/recorder.hpp"
#include "saltus/rollout/batch.hpp"
#include "saltus/rollout/simulate.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus {

/// What the caller's numbers come to; every run of a batch has the same.
struct Plan {
  StepOptions step;
  long steps = 0;
  int record_every = 1;
  bool record_contacts = false;
  int control_every = 1;
  double most_contacts = 0;  ///< that a run may record, written by check_memory
  Eigen::Index rows = 0;     ///< the start, every n-th step and the last
};

/// @throws ModelError on numbers that make no run
Plan make_plan(double duration, const SimulateOptions& options);

/// @throws ModelError where the rows of `runs` runs would take more than 16 GB. What they leave is
/// shared out to contacts, whose number shows as they come.
void check_memory(const Model& model, Plan& plan, Eigen::Index runs);

/// Times of the rows, (rows) [s]: t0 + k h, not the sum of k times h, so that they are round.
VecX row_times(const Plan& plan, double t0);

/// Is asked before every step with the number of steps done; false stops the run.
using GoOn = std::function<bool(long)>;

/// Runs from `start` and writes rows and outcome; these hold what was done also where it throws
/// what Stepper::advance throws. The stepper is made with plan.step; what it did before has no
/// influence, nor has the meter's.
void run(const Model& model, const Plan& plan, const State& start, const GoOn& go_on,
         const Policy& policy, Stepper& stepper, EnergyMeter& meter, RunRows rows,
         RunOutcome& outcome);

}  // namespace saltus
