// What controls change of the forces: Q_u.
#pragma once

#include "saltus/force/force_model.hpp"

namespace saltus {

/// Writes Q_u (n_v, n_u); `at` is what set_forces wrote. 0 where an actuator, its joint or its
/// control is at a limit.
SALTUS_EXPORT void set_control_slopes(const ForceModel& forces, const ForceInput& input,
                                      const ForceValues& at, MatX& Q_u);

}  // namespace saltus
