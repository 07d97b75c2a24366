// A recorded motion.
#pragma once

#include <vector>

#include "saltus/model/model.hpp"
#include "saltus/variational/energies.hpp"
#include "saltus/variational/report.hpp"

namespace saltus {

/// Rows are recorded states. `impacts[i].first` counts into `impulses` of the whole trajectory.
struct SALTUS_EXPORT Trajectory {
  Model model;
  StepOptions options;
  VecX t;                       ///< (rows) [s]
  MatX q, v, p;                 ///< (rows, n_q), of v and p n_v
  VecX kinetic, potential;      ///< (rows) [J]
  VecX shadow;                  ///< (rows) [J] H - h^2 kappa / 24, see saltus::shadow_energy
  std::vector<Impact> impacts;  ///< in order of time
  std::vector<Impulse> impulses;
  std::vector<TangentialImpulse> friction;  ///< of those of `impulses` that had any
  std::vector<Settling> settlings;          ///< in order of time
  std::vector<std::string> certificates;    ///< (impacts) if StepOptions::certify
  long iterations = 0;                      ///< Newton iterations in all
  double residual = 0;                      ///< [largest momentum] the worst of any step
  bool complete = false;                    ///< false: stopped on request before `duration`

  VecX total() const { return kinetic + potential; }
  /// Greatest |H(t) - H(0)| over the greatest kinetic energy of the run (0 if nothing moves).
  double energy_error() const;
};

}  // namespace saltus
