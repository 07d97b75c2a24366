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
  int joint = -1;           ///< of the tree
  Vec3 p_J = Vec3::Zero();  ///< [m]
};

/// A spring between two points, without a damper.
struct PointSpring {
  std::string name;      ///< for messages
  BodyPoint a;           ///< one end
  BodyPoint b;           ///< the other
  double stiffness = 0;  ///< [N/m]
  double length = 0;     ///< [m] where it pulls no more
};

/// A constant force, such as a weight that is carried.
struct PointForce {
  BodyPoint at;               ///< where it acts
  Vec3 force = Vec3::Zero();  ///< [N] world axes
};

/// A spring of one coordinate that resists as a curve says.
struct CurveSpring {
  int velocity = 0;       ///< of the coordinate
  double multiplier = 1;  ///< of q in the displacement s
  double offset = 0;      ///< [rad | m] of s
  Curve curve;            ///< f
};

/// Whoever writes these throws what it likes; callers let it through.
struct PotentialFunction {
  std::string name;                                        ///< for messages
  std::function<double(const VecX& q)> value;              ///< [J]
  std::function<void(const VecX& q, VecX& V_q)> gradient;  ///< (n_v) [N m | N]
  std::function<void(const VecX& q, MatX& V_qq)> hessian;  ///< (n_v, n_v)
};

/// All of a model.
struct Potentials {
  std::vector<PointSpring> springs;          ///< between points
  std::vector<PointForce> forces;            ///< at points
  std::vector<CurveSpring> curves;           ///< of coordinates
  std::vector<PotentialFunction> functions;  ///< that users wrote

  /// None of any kind.
  bool empty() const {
    return springs.empty() && forces.empty() && curves.empty() && functions.empty();
  }
};

}  // namespace saltus
