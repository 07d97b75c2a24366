// L, its first partials and the generators of its second ones, in lanes (see packed_tree.hpp).
//
// Theory, section 2 (after E. Johnson & T. Murphey, ICRA 2008, with composite quantities in place
// of the sums over bodies). L(q, v) = T - V, V = -sum m g.c. With W_i = V_i x S_i:
//
//   Ic_i = sum of I_k over the subtree      H_i = sum of I_k V_k
//   U_i  = Ic_i S_i                         F_i = Ic_i W_i + S_i x* H_i
//   g_i  = [h_i x g ; m_i g]                G_i = [lin(U_i) x g ; 0]   (h_i, m_i of the subtree)
//
//   L_v[i]    = S_i.H_i              L_q[i]    = W_i.H_i + S_i.g_i
//   L_vv[i,j] = S_i.U_j              L_vq[i,j] = S_i.F_j             for i at or above j
//   L_vq[j,i] = W_i.U_j              L_qq[i,j] = W_i.F_j + S_i.G_j   all other pairs are zero
//
// Joints of a ball: L_v, L_q are the derivatives by its angular velocity w and by R -> exp(eta) R
// with w held, in the axes of the placement; W takes V of the third joint. Within a ball all nine
// pairs hold, each joint as if above the others, and L_qq is not symmetric (theory, O1).
//
// An arc of duration tau, evaluated in its middle, has the momenta L_v' -+ tau/2 L_q' at its ends,
// where joints of a ball have, with f = tau w (theory, O2),
//
//   L_q' = L_q + w x L_v                                    the torque on the ball
//   L_v' = L_v - c1 f x (f x L_v) + tau/2 c2 f x L_q'       c1, c2: rotation.hpp
//
// and all others L_v' = L_v, L_q' = L_q.
//
// Plain loops of the same formulas, in the tests, are the reference that these are compared with.
// A force Q(q, v) on the coordinates acts in an arc as L_q does: who adds it to L_q, after
// first_pass and before arc_pass, has it in all that follows (theory, F1).
#pragma once

#include "saltus/lagrangian/packed_tree.hpp"

namespace saltus {

struct Packed {
  Packed() = default;
  SALTUS_EXPORT explicit Packed(const PackedTree& tree);

  // set_coordinates
  Blocks<1> s;     ///< displacement of the joint; 0 of a ball's
  Blocks<4> ball;  ///< quaternion x y z w, in the slot of the third joint; empty without balls
  // set_rates
  Blocks<1> s_dot;
  // place
  Blocks<2> turn;  ///< cos, sin of the turn
  Blocks<9> R;     ///< R_WJ by columns
  Blocks<6> p;     ///< [m] p_OJ; the step from the parent's origin
  // place, move
  Blocks<12> S_W;  ///< S; W = V x S
  // move
  Blocks<6> V;
  // first_pass; second_pass adds the subtrees' I
  Blocks<9> I_h;  ///< about O: I as xx xy xz yy yz zz of the body, h of the subtree
  Blocks<6> H;
  Blocks<2> first;  ///< L_v, L_q by joint
  Blocks<1> scale;  ///< bound of the terms whose difference an arc's residual is
  Blocks<4> terms;  ///< scratch of scale
  // arc_pass
  Blocks<2> arc;       ///< L_v', L_q' by joint
  Blocks<2> ball_arc;  ///< c1, c2 in the slot of the third joint; empty without balls
  // second_pass
  Blocks<15> U_F_G;
  /// Q_q, Q_v: slopes of a force on one coordinate by that coordinate, in the slots that
  /// PackedTree::slot_of_velocity names. Written by whoever adds forces to L_q; else empty.
  Blocks<2> slope;
  /// Forces that several coordinates feel and make: Q_q = g_0 q_0^T + g_1 q_1^T + ..., with g in
  /// `coupled`, q in `coupled_q`, and Q_v likewise. The first PackedTree::columns are those of
  /// potentials, by second_pass; others by whoever adds forces to L_q. No columns where none act.
  MatX coupled, coupled_q, coupled_v;  ///< (n_v, r)
  // place, where the tree has potentials
  struct PlacedSpring {
    Vec3 P_a, P_b;  ///< [m] its ends, from O of their trees
    Vec3 r, force;  ///< [m] P_a - P_b in the world; [N] on a
    double d;       ///< [m] |r|
  };
  std::vector<PlacedSpring> springs;
  VecX pull;           ///< (n_v) -V_q of all but functions
  VecX pull_size;      ///< (n_v) of the terms it is a sum of
  VecX q;              ///< (n_q) by set_coordinates, for functions; else empty
  VecX function_pull;  ///< (n_v) -V_q of functions, by first_pass; else empty
};

/// s <- what the drives make of q (n_q).
SALTUS_EXPORT void set_coordinates(const Tree& tree, const PackedTree& packed, const VecRef& q,
                                   Packed& w);
/// s_dot <- what the drives make of v (n_v).
SALTUS_EXPORT void set_rates(const Tree& tree, const PackedTree& packed, const VecRef& v,
                             Packed& w);

/// Poses and S; needs set_coordinates.
SALTUS_EXPORT void place(const PackedTree& packed, Packed& w);
/// V and W; needs place and set_rates.
SALTUS_EXPORT void move(const PackedTree& packed, Packed& w);
/// L_v, L_q; needs move.
SALTUS_EXPORT void first_pass(const PackedTree& packed, Packed& w);
/// L_v', L_q' of an arc of duration tau; needs first_pass.
SALTUS_EXPORT void arc_pass(const PackedTree& packed, double tau, Packed& w);
/// scale of an arc's residual, of duration tau; needs first_pass.
SALTUS_EXPORT void scale_pass(const PackedTree& packed, double tau, Packed& w);
/// U, F, G; needs first_pass, once after each.
SALTUS_EXPORT void second_pass(const PackedTree& packed, Packed& w);
/// U alone, from place alone: what the mass matrix needs.
SALTUS_EXPORT void mass_pass(const PackedTree& packed, Packed& w);

/// V = -sum m g.c [J]; needs first_pass or mass_pass.
SALTUS_EXPORT double potential_energy(const PackedTree& packed, const Packed& w);

/// Products of the second partials with the velocity, by joint.
struct PackedProducts {
  PackedProducts() = default;
  SALTUS_EXPORT explicit PackedProducts(const PackedTree& tree);

  Blocks<3> by_joint;  ///< L_vq v, L_qv v, L_qq v; L_qv = L_vq^T
  Blocks<15> below;    ///< scratch: sums over subtrees
  Blocks<6> above;     ///< scratch: sums over ancestors
};

/// Writes all three in O(n); needs second_pass.
SALTUS_EXPORT void multiply_by_rates(const PackedTree& packed, const Packed& w,
                                     PackedProducts& out);

/// R, p and S of one joint and the origin of its tree, as set_configuration would write them; needs
/// place.
SALTUS_EXPORT void copy_pose(const Tree& tree, const PackedTree& packed, const Packed& w, int joint,
                             Kinematics& kin);
/// Those of all joints.
SALTUS_EXPORT void copy_poses(const Tree& tree, const PackedTree& packed, const Packed& w,
                              Kinematics& kin);

/// Adjoint of set_rates: out[c] <- sum of multiplier * number `which` over the joints that
/// velocity c drives.
template <int C>
void gather(const Tree& tree, const PackedTree& packed, const Blocks<C>& from, int which,
            VecX& out) {
  if (packed.one_to_one) {
    for (int i = 0; i < tree.joints(); ++i) out[i] = at(from, packed.slot[i])[which * lanes];
    return;
  }
  out.setZero();
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    out[drive.velocity] += drive.multiplier * at(from, packed.slot[i])[which * lanes];
  }
}

}  // namespace saltus
