// A recorded motion.
#pragma once

#include <optional>
#include <vector>

#include "saltus/model/model.hpp"
#include "saltus/variational/energies.hpp"
#include "saltus/variational/report.hpp"

namespace saltus {

/// An impulse between two bodies, in the list of all that acted in a run.
struct RecordedContact {
  Eigen::Index row;        ///< of the trajectory: the first at or after the end of the step
  double t;                ///< [s] of the impact; of what held a pair closed, the end of the step
  int impact;              ///< index in the trajectory's `impacts`; -1: it held the pair closed
  ContactImpulse impulse;  ///< pair, size, place
};

/// Rows are recorded states. `impacts[i].first` counts into `impulses` of the whole trajectory.
struct SALTUS_EXPORT Trajectory {
  Model model;               ///< what moved
  StepOptions options = {};  ///< of the steps
  VecX t = {};               ///< (rows) [s]
  MatX q = {};               ///< (rows, n_q)
  MatX v = {};               ///< (rows, n_v)
  MatX p = {};               ///< (rows, n_v)
  VecX kinetic = {};         ///< (rows) [J]
  VecX potential = {};       ///< (rows) [J]
  VecX shadow = {};          ///< (rows) [J] H - h^2 kappa / 24, see saltus::energies
  MatX control = {};         ///< (rows, n_u) of the steps from this row on; the last: before it
  MatX work = {};            ///< (rows, n_u + 3) [J] until then, as StepReport::work
  std::vector<Impact> impacts = {};            ///< in order of time
  std::vector<ContactImpulse> impulses = {};   ///< of all impacts, in order
  std::vector<Settling> settlings = {};        ///< in order of time
  std::vector<Fallback> fallbacks = {};        ///< of steps that had to be made otherwise
  std::vector<std::string> certificates = {};  ///< (impacts) if StepOptions::certify
  /// All impulses, row by row: those of impacts, in order, then those that held pairs closed over
  /// the step. If SimulateOptions::record_contacts.
  std::optional<std::vector<RecordedContact>> contacts = {};
  long iterations = 0;    ///< Newton iterations in all
  double residual = 0;    ///< [largest momentum] the worst of any step
  bool complete = false;  ///< false: stopped on request, or failed, before `duration`

  /// (rows) [J] H
  VecX total() const { return kinetic + potential; }
  /// Greatest |H(t) - H(0) - work| over the greatest kinetic energy of the run (0 if nothing
  /// moves).
  double energy_error() const;
};

/// What rows are that somebody else computed.
enum class RowsOf { velocities, momenta };

/// A run of states that somebody else computed: rows at times t (rows) [s], q (rows, n_q), and
/// v or p (rows, n_v). Energies are computed; impacts and all else of a run are absent. `h` [s] is
/// the step of the shadow energy.
/// @throws ModelError where shapes do not fit, times decrease, or a value is none that a state has;
///         StepError where a mass matrix is singular.
SALTUS_EXPORT Trajectory from_states(const Model& model, const VecRef& t,
                                     const Eigen::Ref<const MatX>& q,
                                     const Eigen::Ref<const MatX>& v_or_p, RowsOf kind, double h);

}  // namespace saltus
