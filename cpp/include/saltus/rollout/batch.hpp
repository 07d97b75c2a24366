// Many runs of one model from many starts, over threads.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saltus/rollout/simulate.hpp"

namespace saltus {

/// What becomes of the others where a run fails (StepError, or an overlap at its start).
enum class OnFailure {
  go_on,  ///< they go on; the message stands in RunOutcome::failure
  stop,   ///< the batch stops and throws the run's error, with "run <index>: " before it
};

/// Of a batch: of each run, and of all together.
struct BatchOptions {
  /// Of every run. `progress` is told the part of the whole batch, by the thread that called.
  SimulateOptions run = {};
  /// (runs) What drives each run, in place of run.policy; empty: that drives all, from several
  /// threads at once.
  std::vector<Policy> policies = {};
  int threads = 0;  ///< 0: as many as the machine runs at once. Bits do not depend on it.
  OnFailure on_failure = OnFailure::go_on;  ///< of one run
};

/// How one run went.
struct RunOutcome {
  std::vector<Impact> impacts;            ///< in order of time; `first` counts into `impulses`
  std::vector<ContactImpulse> impulses;   ///< of all its impacts
  std::vector<Settling> settlings;        ///< in order of time
  std::vector<Fallback> fallbacks;        ///< in order of time
  std::vector<std::string> certificates;  ///< (impacts) if StepOptions::certify
  /// As in Trajectory, if SimulateOptions::record_contacts; also of steps after the last row.
  std::optional<std::vector<RecordedContact>> contacts;
  long iterations = 0;    ///< Newton iterations in all
  double residual = 0;    ///< [largest momentum] the worst of any step
  Eigen::Index rows = 1;  ///< that were reached; the others are NaN
  bool complete = false;  ///< false: failed, or stopped on request before `duration`
  std::string failure;    ///< what its error says, "" if there was none
};

/// Run i has the rows [i * rows, (i + 1) * rows) of q, v and p, and row i of the energies. Rows
/// that a run did not reach are NaN. The first holds q and p also where a run never began.
struct SALTUS_EXPORT BatchTrajectory {
  Model model;                           ///< of all runs
  StepOptions options = {};              ///< of all steps
  VecX t = {};                           ///< (rows) [s] the same for all runs
  MatX q = {};                           ///< (runs * rows, n_q)
  MatX v = {};                           ///< (runs * rows, n_v)
  MatX p = {};                           ///< (runs * rows, n_v)
  MatX control = {};                     ///< (runs * rows, n_u) as in Trajectory
  MatX work = {};                        ///< (runs * rows, n_u + 3) [J] as in Trajectory
  MatX kinetic = {};                     ///< (runs, rows) [J]
  MatX potential = {};                   ///< (runs, rows) [J]
  MatX shadow = {};                      ///< (runs, rows) [J] as in Trajectory
  std::vector<RunOutcome> outcome = {};  ///< (runs)

  /// How many there are.
  int runs() const { return static_cast<int>(outcome.size()); }
  /// Run i alone (a copy), in the same bits as simulate gives it.
  /// @throws ModelError unless 0 <= i < runs()
  Trajectory run(int i) const;
  VecX energy_error() const;                    ///< (runs) Trajectory::energy_error of each
  std::map<int, std::string> failures() const;  ///< messages of the runs that failed
};

/// Starts from arrays of coordinates (runs, n_q) [rad | m] and velocities (runs, n_v) [rad/s |
/// m/s].
/// @throws ModelError on other shapes; on a value that is not finite, by row and coordinate.
SALTUS_EXPORT std::vector<State> states(const Model& model, const Eigen::Ref<const MatX>& q,
                                        const Eigen::Ref<const MatX>& v, double t = 0);

/// Runs round(duration / h) steps from every start. Each run gives the bits that `simulate` gives,
/// on however many threads. Exceptions of one run leave the others alone (see OnFailure); where
/// `progress` returns false, all stop after their step and what was done is kept.
/// @throws ModelError before anything runs: on no starts, starts that do not fit the model, are not
///         finite or not all at the same time, on what simulate refuses, on threads < 0, on more
///         than 16 GB of rows; contacts of a run, where they are recorded, may take its share of
///         what the rows leave. With OnFailure::stop the error of the first run, by index, that
///         fails. What `progress` throws.
SALTUS_EXPORT BatchTrajectory simulate_batch(const Model& model, std::span<const State> starts,
                                             double duration, const BatchOptions& options = {});

/// The same, written to `out`, which holds what was done also where a run's error is thrown, and is
/// as it was where nothing runs.
SALTUS_EXPORT void simulate_batch(const Model& model, std::span<const State> starts,
                                  double duration, const BatchOptions& options,
                                  BatchTrajectory& out);

}  // namespace saltus
