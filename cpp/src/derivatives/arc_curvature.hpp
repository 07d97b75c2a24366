// Second derivatives of a smooth arc, contracted with a covector: a product in O(n) (theory, D7).
//
// The covector's way back over the arc (arc_derivative.hpp, without balls) is, with T the
// transposed Hessian product at (q_m, v) and w = J^-T (...),
//
//   q_hat + T(tau p_hat + tau/2 w, -w)_q          p_hat + w
//
// Along a direction of the arc's inputs, which moves (q_m, v) by (dm, dv), it changes by the third
// partials of L, contracted twice: E = T'(tau p_hat + tau/2 w, -w). These are one sweep of the
// generators' own derivatives, each line of packed.hpp by the product rule: exact, no differences.
//
//   J^T dw = E_v + tau/2 E_q + what dtau adds      dq_hat = E_q + T(tau/2 dw, -dw)_q + ...
#pragma once

#include "derivatives/held_derivative.hpp"

namespace saltus {

/// E = d/de T(x, y) along (dm, dv).
struct CurvatureSweep {
  VecX by_v, by_q;  ///< (n_v)

  // scratch, by joint: what generators and sums change by
  struct Change {
    Vec6 turn, S, V, W, H, U, F;
    Vec3 G;
    Inertia I;   ///< of the subtree; its mass is 0
    Vec6 x, dx;  ///< sum S_i x_i at and above, and its change
    Vec6 s, ds;  ///< sum S_i y_i + W_i x_i above
    Vec6 a, da;  ///< sum U_j y_j + F_j x_j at and below
    Vec3 g, dg;  ///< sum G_j x_j likewise
  };
  std::vector<Change> joint;
};

/// @throws ModelError that names what of the model or the arc has no second derivative
void check_curvature(const ModelData& model, const FlownArc& arc);

/// Needs an arc that check_curvature takes.
void multiply_by_curvature(const ModelData& model, const ArcDerivative& arc, const VecX& dm,
                           const VecX& dv, const VecX& x, const VecX& y, CurvatureSweep& out);

/// What a covector of an arc's end comes to on its way back.
struct ArcCovector {
  Tangent end;  ///< q_hat, p_hat
  VecX w;       ///< (n_v)
  VecX Q;       ///< (n_v) tau p_hat + tau/2 w, that of forces
  VecX by_q;    ///< (n_v) T(Q, -w)_q
  CurvatureSweep sweep;
};

void set_arc_covector(const ModelData& model, ArcDerivative& arc, const Tangent& end,
                      ArcCovector& out);

/// What a direction of the arc's inputs changes the covector of its start by.
/// @param z the direction; replaced @param dQ of the forces; replaced by the change of Q
/// @return that of the covector of tau
double push_curvature(const ModelData& model, ArcDerivative& arc, double dtau, ArcCovector& along,
                      VecX& dQ, Tangent& z);

}  // namespace saltus
