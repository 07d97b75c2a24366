// What a description says of loops and couplings; constraint/equality.hpp says what they are.
#pragma once

#include <string>
#include <vector>

#include "saltus/constraint/equality.hpp"
#include "saltus/model/at.hpp"

namespace saltus {

/// A loop, as add_loop takes it.
struct LoopSpec {
  std::string name;                 ///< for messages
  LoopType type = LoopType::point;  ///< no coupling
  At a;                             ///< the frame that it ties
  At b;                             ///< to this one
  double distance = 0;              ///< [m] of type distance
};

/// The displacement of `joint` is a polynomial of that of another; both are of one coordinate.
struct CouplingSpec {
  std::string joint;               ///< that follows
  std::string of;                  ///< that it follows
  std::vector<double> polynomial;  ///< by rising powers
};

/// A joint of one coordinate that moves as it is told: by a cubic spline through values at times,
/// or by a function.
struct PrescribedSpec {
  std::string joint;                                        ///< by name
  std::vector<double> times;                                ///< [s]
  std::vector<double> values;                               ///< [rad | m] at each of them
  std::function<PrescribedMotion(double t)> function = {};  ///< in place of times and values
};

}  // namespace saltus
