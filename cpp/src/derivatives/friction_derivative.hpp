// The derivative of an impulse with friction: compression, then expansion, each in its mode
// (coulomb.hpp says what they are).
#pragma once

#include "derivatives/held_derivative.hpp"

namespace saltus {

struct FrictionDerivative {
  int contact = -1;  ///< index in the impact's contacts
  double restitution = 0;
  double lambda = 0;                      ///< [N s] of the compression
  KickDerivative compression, expansion;  ///< the second without contacts where e = 0
  Tangent flow;                           ///< b before it
  double slope = 0;                       ///< n.b_q
  double u = 0, closing = 0;              ///< gap rate before, and its derivative along the motion

  /// It is at the edge of its cone in one of the phases.
  bool is_at_edge() const {
    return compression.is_at_edge || (expansion.size() > 0 && expansion.is_at_edge);
  }
};

/// Of the impulse told, at momenta p, which it changes; node.motion is written.
/// @throws ModelError where the impulse is not that of the contact alone
void set_friction_impulse(const ModelData& model, const Tape& tape, const TapeImpact& told,
                          const TapeImpulse& impulse, VecX& p, NodeDerivative& node,
                          FrictionDerivative& out);

void push_friction(const FrictionDerivative& impulse, double de, const Rubbing& friction,
                   Tangent& z);
/// z <- before it; adds to the covector of friction. @return the covector of e. @param to
/// parameters, or nullptr
double pull_friction(const ModelData& model, const FrictionDerivative& impulse,
                     NodeDerivative& node, Tangent& z, Rubbing& friction, ParameterGradient* to);

}  // namespace saltus
