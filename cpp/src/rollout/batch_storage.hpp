// Where a batch's starts are checked and its rows are kept.
#pragma once

#include <span>

#include "rollout/run.hpp"

namespace saltus {

/// @throws ModelError on the first start that makes no run, as simulate_batch says
void check_starts(const Model& model, std::span<const State> starts);

/// All rows, allocated; only what a start tells is filled in, all else is NaN.
BatchTrajectory empty_batch(const Model& model, const Plan& plan, std::span<const State> starts);

/// The part that run i writes to.
RunRows rows_of(BatchTrajectory& batch, Eigen::Index i);

}  // namespace saltus
