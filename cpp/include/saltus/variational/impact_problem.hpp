// The user's own impact law: a function ImpactProblem -> p+.
#pragma once

#include <functional>
#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// An impact with dense arrays. It has all closed contacts, separating and resting ones too.
struct ImpactProblem {
  double t = 0;            ///< [s]
  VecX q;                  ///< (n_q)
  VecX p;                  ///< (n_v) momentum before
  VecX v;                  ///< (n_v) velocity before, M^-1 p
  MatX M;                  ///< (n_v, n_v) L_vv at q
  MatX N;                  ///< (m, n_v) rows phi_q
  VecX u;                  ///< (m) [m/s] gap rates N v before, negative for approaching ones
  VecX restitution;        ///< (m) e in [0, 1]
  VecX friction;           ///< (m) mu >= 0
  std::vector<int> pairs;  ///< (m) indices in model->pairs
};

/// @return (n_v) momentum after. No gap rate may be negative (beyond rounding); energy, friction
/// and the choice among several outcomes are not checked.
using ImpactFunction = std::function<VecX(const ImpactProblem&)>;

}  // namespace saltus
