// What drives a run: controls and forces, told before steps and held over them.
#pragma once

#include <functional>

#include "saltus/force/force_model.hpp"
#include "saltus/model/state.hpp"
#include "saltus/variational/report.hpp"

namespace saltus {

/// Where a run is when its policy is asked.
struct Moment {
  long step;                 ///< steps done
  const State& state;        ///< (t, q, p)
  const VecX& v;             ///< (n_v) M^-1 p
  const StepReport& report;  ///< of the step before; empty at first
};

/// Changes what drives the steps from now on; the same as before where it changes nothing. It is
/// asked before a step, as a digital controller is: a continuous law is late by h/2. Servos of the
/// model act inside the step, and are stable at any gain (up to 1e12 times what they move, by h).
using Policy = std::function<void(const Moment&, ForceInput&)>;

/// The same controls (n_u) in all steps.
SALTUS_EXPORT Policy constant_control(const VecX& u);

/// Row k of (steps, n_u) in step k, the last row in all after it.
SALTUS_EXPORT Policy control_rows(MatX rows);

}  // namespace saltus
