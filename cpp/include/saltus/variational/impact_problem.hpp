// What a law of one's own is asked at an impact: a function ImpactProblem -> p+.
#pragma once

#include <functional>
#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// The instant of an impact, dense, for people. All pairs that touch, those that leave or rest too.
struct ImpactProblem {
  double t = 0;                ///< [s]
  VecX q, p, v;                ///< (n_q), (n_v), (n_v) before; v = M^-1 p
  MatX M;                      ///< (n_v, n_v) L_vv at q
  MatX N;                      ///< (m, n_v) rows phi_q
  VecX u;                      ///< (m) [m/s] gap rates N v before, negative where one approaches
  VecX restitution, friction;  ///< (m)
  std::vector<int> pairs;      ///< (m) numbers in model->pairs
};

/// @return (n_v) momentum after. No gap rate of it may be negative (beyond rounding); all else is
/// the law's own affair: energy, friction, which of many outcomes.
using ImpactFunction = std::function<VecX(const ImpactProblem&)>;

}  // namespace saltus
