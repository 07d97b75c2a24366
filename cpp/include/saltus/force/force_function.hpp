// Forces that a user writes as a function of t, q and v.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// Where a force is asked for: the middle of an arc.
struct ForceMoment {
  double t;       ///< [s]
  const VecX& q;  ///< (n_q)
  const VecX& v;  ///< (n_v)
};

/// What a function answers; Q_q and Q_v may be left empty: Newton's method then does without them.
/// Derivatives by q are along velocities (partials.hpp).
struct ForceAnswer {
  VecX Q;    ///< (m) [N m | N]
  MatX Q_q;  ///< (m, n_v), or empty
  MatX Q_v;  ///< (m, n_v), or empty
};

/// Asked with an empty answer. What it throws comes through to who asked for the step.
using ForceFunction = std::function<void(const ForceMoment& now, ForceAnswer& answer)>;

/// A function and the m coordinates that it pushes.
struct FunctionForce {
  std::string name;             ///< for messages
  std::vector<int> velocities;  ///< (m) indices in v
  ForceFunction function;       ///< what is asked
};

/// Asks, and checks the answer.
/// @throws ModelError that names the force, where a shape is wrong or a number not finite
SALTUS_EXPORT void ask(const FunctionForce& force, const ForceMoment& now, ForceAnswer& answer);

}  // namespace saltus
