// Damping that stops a joint within a step.
//
// Theory, F3. With z = h d (M^-1)_ii a step of the midpoint rule multiplies a momentum by
// (1 - z/2) / (1 + z/2): beyond z = 2 its sign changes each step, and a stiff damper's velocities
// zigzag for ever, though positions are right. Beyond z = 4 an arc opens with the part beta of the
// damping's impulse and closes with the rest,
//
//   p_start = L_v - tau/2 L_q - tau beta Q,  p_end = p_start + tau (L_q + Q)
//   (1 - (1 - beta) z) / (1 + beta z),  beta = 1 - 1 / z2, z2 the next power of 2
//
// which is in [0, 0.11]; up to z = 4 beta is 1/2, and the rule of second order.
#pragma once

#include "saltus/model/model.hpp"

namespace saltus {

inline constexpr double most_damping = 4;  ///< z up to which the midpoint rule is kept

/// 2 beta - 1 of damping z.
SALTUS_EXPORT double damping_shift(double z);

/// z (n_v) of the joints' own damping at q, of steps h [s]; 0 of balls, which keep the midpoint
/// rule.
SALTUS_EXPORT VecX damping_ratios(const Model& model, double h, const VecRef& q);

/// Joints with z > 4 at q: a smaller h, or less damping, makes their velocities exact.
SALTUS_EXPORT std::vector<std::string> stiff_joints(const Model& model, double h, const VecRef& q);

}  // namespace saltus
