// The derivative of one arc (q, p, Q, tau) -> (q_end, p_end), forwards and backwards, in O(n).
//
// Theory, D1 and O2. With second partials at the arc's middle, f = L_q + Q, x = half dq where
// `half` is exp(f/2) on balls and 1 elsewhere,
//
//   J dv  = K dp - (L_vq - tau/2 C f_q) x + tau/2 C dQ + R dtau
//   x_m   = x + tau/2 C dv + v/2 dtau
//   dq+   = whole dq + tau K dv + v dtau
//   dp+   = dp + tau [f_q x_m + f_v dv + dQ + (dv x L_v + w x dL_v on balls)] + f dtau
//
// Directions of q are along velocities; on balls R -> exp(eta) R.
#pragma once

#include "saltus/lagrangian/packed_hessian.hpp"
#include "saltus/variational/tape.hpp"
#include "variational/arc/arc.hpp"

namespace saltus {

/// A direction of (q, p), or a covector of it.
struct Tangent {
  VecX q, p;          ///< (n_v)
  double energy = 0;  ///< [J] that the law of an impact to come matches; else of no meaning
  double h = 0;       ///< [s] of the step's duration
};

/// What a ball turns by in an arc.
struct TurnDerivative {
  int velocity;            ///< of its first axis
  Mat3 half, whole, K, C;  ///< exp(f/2), exp(f); J(f), J(f/2)
  Vec3 rate, L_v;
};

struct ArcDerivative {
  explicit ArcDerivative(const ModelData& model);

  double tau = 0;
  VecX v;      ///< (n_v)
  VecX force;  ///< (n_v) dp_end/dtau at fixed v: L_q' of packed.hpp
  MatX Q_u;    ///< (n_v, n_u) forces of the controls
  /// (n_v) E_d by the middle and by v, where the law is discrete_energy; else empty, and a
  /// tangent's energy goes on as it is.
  VecX energy_q, energy_v;
  VecX R;  ///< (n_v) scaled by K
  std::vector<TurnDerivative> turns;
  ArcScratch s;  ///< at the middle; factors of J
  HessianProduct product;
  VecX x, y;     ///< scratch
  VecX x_m, dv;  ///< (n_v) of the middle and of v, by push_forward
  /// (n_v) covectors of these that pull_back adds.
  VecX hat_m, hat_v;
  /// (n_v) by pull_back, with what it adds to Q: what changes of L_v and of f are multiplied by.
  VecX of_L_v;
};

/// Writes all of `out`: an arc is evaluated again, and factored.
/// @throws ModelError that names what has no derivative
void set_arc_derivative(const ModelData& model, const Tape& tape, const TapeArc& arc,
                        ArcDerivative& out);

/// An arc of no duration from (q, v), of which `force`, the factors of M and products are written:
/// its derivative by tau is the motion (v, f).
/// @param is_same_place it was one at this q before, whose factors stay
void set_node_derivative(const ModelData& model, const Tape& tape, double t, const VecX& q,
                         const VecX& v, ArcDerivative& out, bool is_same_place = false);

/// z <- the direction of the arc's end. @param dQ (n_v) of the forces; @param dtau [s]
void push_forward(const ModelData& model, ArcDerivative& arc, const VecX& dQ, double dtau,
                  Tangent& z);

/// z <- the covector of the arc's start; adds to Q (n_v). @return that of tau
double pull_back(const ModelData& model, ArcDerivative& arc, VecX& Q, Tangent& z);

}  // namespace saltus
