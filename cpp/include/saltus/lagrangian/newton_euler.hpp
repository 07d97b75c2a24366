// Forces from accelerations by the recursion of Newton and Euler, in lanes, O(n).
//
//   down:  A_i = A_parent + S_i s''_i + W_i s'_i            (W = V x S, packed.hpp)
//   body:  f_k = I_k (A_k - [0; g]) + V_k x* I_k V_k
//   up:    X_i = sum of f_k over the subtree                tau_i = S_i.X_i
//
// Reference: R. Featherstone, Rigid Body Dynamics Algorithms, ch. 5 (2008), here in world axes
// about one point O, so that nothing is transformed on the way.
//
// Balls need no case of their own. Their axes S_k move with what is above the ball, S_k' =
// V_above x S_k, and W_k holds V of the third joint instead; but V = V_above + sum S_k w_k, and
// sum S_k w_k crossed with itself vanishes: the sums of W_k w_k and of S_k' w_k are the same. tau
// of a ball is the torque in the axes of its placement, and s'' the rates of w in these axes.
#pragma once

#include "saltus/lagrangian/packed.hpp"

namespace saltus {

struct PackedForces {
  PackedForces() = default;
  SALTUS_EXPORT explicit PackedForces(const PackedTree& tree);

  Blocks<1> s_ddot;  ///< [rad/s^2 | m/s^2]                         written by set_accelerations
  Blocks<6> A;       ///< acceleration of the joint's frame about O  written by newton_euler
  Blocks<6> X;       ///< wrench on the subtree about O              written by newton_euler
  Blocks<1> tau;     ///< [N m | N] by joint                         written by both passes
};

/// s'' <- what the drives make of a (n_v).
SALTUS_EXPORT void set_accelerations(const Tree& tree, const PackedTree& packed, const VecRef& a,
                                     PackedForces& out);

/// tau: what the joints must do for these accelerations, gravity and all other potentials acting,
/// armature included; needs place, move and set_accelerations. @throws StepError as check_springs.
SALTUS_EXPORT void newton_euler(const PackedTree& packed, const Packed& w, PackedForces& out);

/// tau <- what gravity does, S.[h x g; m g] of the subtrees, less what is compensated; needs
/// mass_pass or first_pass.
SALTUS_EXPORT void gravity_pass(const PackedTree& packed, const Packed& w, PackedForces& out);

}  // namespace saltus
