// What a description says of loops and couplings; constraint/equality.hpp says what they are.
#pragma once

#include <string>
#include <vector>

#include "saltus/constraint/equality.hpp"
#include "saltus/model/at.hpp"

namespace saltus {

struct LoopSpec {
  std::string name;
  LoopType type = LoopType::point;  ///< no coupling
  At a, b;
  double distance = 0;  ///< [m] of type distance
};

/// The displacement of `joint` is a polynomial of that of another; both are of one coordinate.
struct CouplingSpec {
  std::string joint, of;
  std::vector<double> polynomial;  ///< by rising powers
};

/// A joint of one coordinate that moves as it is told: by a cubic spline through values at times,
/// or by a function.
struct PrescribedSpec {
  std::string joint;
  std::vector<double> times, values;  ///< [s], [rad | m]
  std::function<PrescribedMotion(double t)> function = {};
};

}  // namespace saltus
