// Up pass: composite quantities of every subtree, the generators of all partials of L.
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
// Everything here is per joint; mimic joints are folded by to_coordinates.
#pragma once

#include <vector>

#include "saltus/lagrangian/mass_model.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus::plain {

/// What one subtree contributes.
struct JointComposite {
  Inertia Ic;             ///< about O: own body after first_pass, whole subtree after second_pass
  Vec6 H = Vec6::Zero();  ///< momentum wrench of the subtree         written by first_pass
  Vec6 g = Vec6::Zero();  ///< gravity's wrench on the subtree        written by first_pass
  Vec6 U = Vec6::Zero(),
       F = Vec6::Zero();  ///< see above                              written by second_pass
  Vec3 G = Vec3::Zero();  ///< angular part of G_i                    written by second_pass
};

struct Composite {
  std::vector<JointComposite> joint;  ///< (n)
  VecX L_v;                           ///< (n) [J s/rad | N s] by joint, written by first_pass
  VecX L_q;                           ///< (n) [J/rad | N]     by joint, written by first_pass

  Composite() = default;
  explicit Composite(const Tree& tree)
      : joint(tree.parent.size()), L_v(tree.joints()), L_q(tree.joints()) {}
};

/// First partials. Needs set_configuration and set_velocity.
void first_pass(const Tree& tree, const MassModel& mass, const Kinematics& kin, Composite& comp);

/// Generators of the second partials. Needs first_pass (once after each).
void second_pass(const Tree& tree, const MassModel& mass, const Kinematics& kin, Composite& comp);

/// What the mass matrix alone needs: Ic of the subtrees and U. Needs set_configuration, no
/// velocity; factorize with tau = 0 and add_dense with tau = 0 may follow, nothing else.
void mass_pass(const Tree& tree, const MassModel& mass, const Kinematics& kin, Composite& comp);

}  // namespace saltus::plain
