#include "saltus/force/control_slopes.hpp"

#include <cmath>

namespace saltus {

void set_control_slopes(const ForceModel& forces, const ForceInput& input, const ForceValues& at,
                        MatX& Q_u) {
  Q_u.setZero();
  for (int k = 0; k < forces.n_u(); ++k) {
    const Actuator& a = forces.actuators[static_cast<std::size_t>(k)];
    const double u = input.control.size() > 0 ? input.control[k] : 0;
    if (u < a.lower || u > a.upper || std::abs(at.effort[k]) >= a.effort) continue;
    const int c = a.gears.front().velocity;
    const bool has_limit = a.is_single() && forces.effort.size() > 0;
    if (has_limit && std::abs(at.single[c]) >= forces.effort[c]) continue;
    for (const Gear& gear : a.gears) Q_u(gear.velocity, k) += gear.ratio * a.gain;
  }
}

}  // namespace saltus
