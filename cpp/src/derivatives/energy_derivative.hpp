// Arcs that meet the energy from before an impact (theory, D3): discrete_energy, shadow_energy.
//
// The impulse of one contact is changed by delta so that the energy E of the arc, or of its end, is
// what it was. With the arc's derivative linear in z and R its answer to dp = n,
//
//   z.p += delta dn,   z <- arc z,   ddelta = (dE_before - dE) / E(R),   z += R ddelta
//
// discrete_energy: E_d of the arc, E_d of the one before. shadow_energy: H - h^2 kappa / 24 at the
// arc's end and at the step's start, with
//
//   H~_q = -L_q - h^2/24 (kappa_q - L_vq^T M^-1 kappa_v)     H~_p = v - h^2/24 M^-1 kappa_v
#pragma once

#include "derivatives/impulse_derivative.hpp"

namespace saltus {

/// Of an energy of a state. Empty vectors: none.
struct EnergyGradient {
  VecX q, p;     ///< (n_v)
  double h = 0;  ///< [J/s]

  double dot(const Tangent& z) const { return q.dot(z.q) + p.dot(z.p) + h * z.h; }
  void pull(double of_energy, Tangent& z) const;
};

/// H(q, p).
void set_energy_gradient(const ModelData& model, const Tape& tape, const VecX& q, const VecX& p,
                         EnergyGradient& out);
/// H - h^2 kappa / 24. @throws ModelError on balls and potentials that are functions
void set_shadow_gradient(const ModelData& model, const VecX& q, const VecX& p, double h,
                         EnergyGradient& out);

/// How an arc meets the energy.
struct MatchDerivative {
  bool is_set = false;
  GapDerivative gap;
  double delta = 0;
  Tangent R;
  EnergyGradient end;  ///< shadow_energy
};

/// Needs the arc. @throws ModelError where what the tape tells is not differentiated
void set_match(const ModelData& model, const Tape& tape, const TapeArc& told, ArcDerivative& arc,
               MatchDerivative& out);

/// push_forward and pull_back of an arc that may match an energy.
void push_matched(const ModelData& model, const MatchDerivative& match, ArcDerivative& arc,
                  const VecX& dQ, double dtau, Tangent& z);
double pull_matched(const ModelData& model, const MatchDerivative& match, ArcDerivative& arc,
                    VecX& Q, Tangent& z);

}  // namespace saltus
