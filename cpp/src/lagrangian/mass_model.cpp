#include "saltus/lagrangian/mass_model.hpp"

namespace saltus {

BodyInertia weld(const BodyInertia& a, const BodyInertia& b) {
  if (a.mass + b.mass == 0) return {0, Vec3::Zero(), a.I_J + b.I_J};
  BodyInertia both;
  both.mass = a.mass + b.mass;
  both.c_J = (a.mass * a.c_J + b.mass * b.c_J) / both.mass;
  both.I_J = inertia_about(a.mass, a.c_J - both.c_J, a.I_J).I +
             inertia_about(b.mass, b.c_J - both.c_J, b.I_J).I;
  return both;
}

BodyInertia transform(const Pose& X_PB, const BodyInertia& body_B) {
  return {body_B.mass, X_PB * body_B.c_J, X_PB.R * body_B.I_J * X_PB.R.transpose()};
}

}  // namespace saltus
