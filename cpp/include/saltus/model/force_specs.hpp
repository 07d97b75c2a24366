// Springs between points, and forces and potentials that are functions: what ModelBuilder gathers.
#pragma once

#include <string>
#include <vector>

#include "saltus/force/force_function.hpp"
#include "saltus/lagrangian/potentials.hpp"
#include "saltus/model/at.hpp"

namespace saltus {

/// A spring and a damper side by side between two points.
struct SpringSpec {
  std::string name;      ///< for messages
  At a;                  ///< its origin is one end
  At b;                  ///< its origin is the other
  double stiffness = 0;  ///< [N/m]
  double length = 0;     ///< [m] where it pulls no more
  double damping = 0;    ///< [N s/m]
};

/// A force of the user on some coordinates, by the names of their velocities; all where there are
/// none.
struct ForceSpec {
  std::string name;                      ///< for messages
  ForceFunction function;                ///< what is asked
  std::vector<std::string> coordinates;  ///< names of their velocities
};

}  // namespace saltus
