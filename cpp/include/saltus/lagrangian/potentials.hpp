// Potentials beside gravity and the linear springs of single coordinates (theory, F2).
//
//   point spring   V = k/2 (d - l)^2, d = |r|, r = P_a - P_b; l = 0: k/2 r.r, smooth at d = 0
//   point force    V = -f.P, f constant in the world's axes
//   curve          V = integral of f over the displacement s = multiplier q + offset
//   function       V(q) with its derivatives along velocities, as partials.hpp defines them
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "saltus/lagrangian/curve.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// Fixed to a joint's frame; joint -1: to the world.
struct BodyPoint {
  int joint = -1;
  Vec3 p_J = Vec3::Zero();  ///< [m]
};

struct PointSpring {
  std::string name;
  BodyPoint a, b;
  double stiffness = 0;  ///< [N/m]
  double length = 0;     ///< [m] where it pulls no more
};

struct PointForce {
  BodyPoint at;
  Vec3 force = Vec3::Zero();  ///< [N] world axes
};

struct CurveSpring {
  int velocity = 0;  ///< of the coordinate
  double multiplier = 1, offset = 0;
  Curve curve;
};

/// Whoever writes these throws what it likes; callers let it through.
struct PotentialFunction {
  std::string name;
  std::function<double(const VecX& q)> value;              ///< [J]
  std::function<void(const VecX& q, VecX& V_q)> gradient;  ///< (n_v) [N m | N]
  std::function<void(const VecX& q, MatX& V_qq)> hessian;  ///< (n_v, n_v)
};

struct Potentials {
  std::vector<PointSpring> springs;
  std::vector<PointForce> forces;
  std::vector<CurveSpring> curves;
  std::vector<PotentialFunction> functions;

  bool empty() const {
    return springs.empty() && forces.empty() && curves.empty() && functions.empty();
  }
};

}  // namespace saltus
