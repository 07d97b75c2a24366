// The shadow term kappa(q, v) and its gradient, exactly and in O(n), in lanes.
//
// The midpoint rule with step h conserves H - h^2 kappa / 24 up to O(h^4) (theory, section 5):
//
//   kappa = a^T M a - v^T L_qq v      M a = L_q - L_vq v: a is the acceleration of free motion
//
// Its gradient seems to need da/dq, da/dv and third partials of L. It needs neither: a maximises
//
//   kappa = max over y of  2 y.L_q - D^2 L [(v, y), (v, y)]
//
// because M is positive definite, so that a may be held while kappa is differentiated (the envelope
// theorem). Along the curve
//
//   q(e) = q + e v - e^2 a            v(e) = v + e a
//
// second derivatives hold both terms, since q'' = -2 a brings in -2 a.L_q; primes are d/de at e =
// 0:
//
//   kappa = -L''      kappa_q = -L_q''      kappa_v = -L_v'' - 2 L_q'
//
// where the last term comes from the direction v of D^2 L, and L_q' = L_qq v + L_vq^T a.
//
// With balls M a = L_q + w x L_v - L_vq v, and kappa = a.M a - v.L_qq v as it stands; the gradient
// is not for them (theory, O6).
//
// An a that is wrong by d makes kappa wrong by d^T M d only, its gradient by O(d).
#pragma once

#include "saltus/lagrangian/packed_matrix.hpp"

namespace saltus {

/// Acceleration of free motion, and kappa as a by-product.
struct FreeMotion {
  FreeMotion() = default;
  SALTUS_EXPORT FreeMotion(const Tree& tree, const PackedTree& packed);

  VecX a;                   ///< (n_v) [rad/s^2 | m/s^2]
  double kappa = 0;         ///< [J/s^2]
  VecX force;               ///< (n_v) M a = L_q - L_vq v
  PackedProducts products;  ///< of the second partials with v
  VecX L_vq_v;              ///< (n_v) scratch
};

/// Writes all of `out`; needs second_pass, and in M the factors of the mass matrix (tau = 0).
SALTUS_EXPORT void free_motion(const Tree& tree, const PackedTree& packed, const Packed& w,
                               PackedMatrix& M, FreeMotion& out);

/// kappa with its gradient.
struct ShadowTerm {
  ShadowTerm() = default;
  SALTUS_EXPORT ShadowTerm(const Tree& tree, const PackedTree& packed);

  double kappa = 0;  ///< [J/s^2]
  VecX kappa_q;      ///< (n_v) d kappa / dq
  VecX kappa_v;      ///< (n_v) d kappa / dv

  Blocks<1> s_ddot;    ///< a by joint
  Blocks<18> motion;   ///< scratch: Omega', V', V''
  Blocks<15> momenta;  ///< scratch: H', H'', h'' of the subtrees
  Blocks<3> by_joint;  ///< scratch: what the joint adds to kappa, kappa_q, kappa_v
};

/// Writes all of `out`; `a` (n_v) is that of free_motion. Not for trees with balls. Needs first_pass at (q, v), which
/// second_pass may have followed.
SALTUS_EXPORT void shadow_gradient(const Tree& tree, const PackedTree& packed, const Packed& w,
                                   const VecRef& a, ShadowTerm& out);

}  // namespace saltus
