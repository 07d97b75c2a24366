// The state of a model: a value. Keep it, compare it, go back to it by copying it.
#pragma once

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// Time, coordinates and momenta.
struct State {
  double t = 0;  ///< [s]
  VecX q;        ///< (n_q) [rad | m], of balls a unit quaternion x y z w
  VecX p;        ///< (n_v) [kg m^2 rad/s | kg m/s] conjugate momenta, p = L_v

  /// Equal to the bit.
  bool operator==(const State& other) const { return t == other.t && q == other.q && p == other.p; }
};

}  // namespace saltus
