// The bodies of a tree, gravity and other potentials.
#pragma once

#include <vector>

#include "saltus/export.hpp"
#include "saltus/lagrangian/potentials.hpp"

namespace saltus {

/// Mass of all bodies that move with one joint, in the joint's frame.
struct BodyInertia {
  double mass = 0;          ///< [kg]
  Vec3 c_J = Vec3::Zero();  ///< [m] centre of mass
  Mat3 I_J = Mat3::Zero();  ///< [kg m^2] about the centre of mass, axes of J
};

/// Two bodies welded together.
SALTUS_EXPORT BodyInertia weld(const BodyInertia& a, const BodyInertia& b);

/// The same body, seen from frame P when it is given in frame B.
SALTUS_EXPORT BodyInertia transform(const Pose& X_PB, const BodyInertia& body_B);

struct MassModel {
  std::vector<BodyInertia> body;     ///< (n) by joint
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s^2]
  /// What a coordinate has of its own: a motor's rotor, T = armature v^2 / 2, and a spring,
  /// V = stiffness (q - rest)^2 / 2. By velocity, 0 of balls; empty where no coordinate has any.
  VecX armature = {};   ///< (n_v) [kg m^2 | kg]
  VecX stiffness = {};  ///< (n_v) [N m/rad | N/m]
  VecX rest = {};       ///< (n_v) [rad | m]
  Potentials potentials = {};
};

}  // namespace saltus
