// Derivatives of L_q and L_v along the curve of shadow.hpp, without derivatives of poses.
//
// Along it the bodies move with twists Omega = sum S_k (v_k - 2 e a_k), while the rates are those
// of V = sum S_k (v_k + e a_k); at e = 0 both are V. All that moves with a body changes by a cross
// product with its Omega, about a point O that stays where it is:
//
//   down:  Omega'_i = sum W_k v_k - 2 S_k a_k       V'_i = sum W_k v_k + S_k a_k
//          S' = V x S = W                           S'' = Omega' x S + V x W
//          W' = V' x S + V x W                      W'' = V'' x S + 2 V' x W + V x S''
//          V''_i = sum S''_k v_k + 2 W_k a_k        (all sums over k at or above i)
//   body:  H = I V with I' = Omega x* I - I Omega x:
//          H'  = I V' + V x* H
//          H'' = I (V'' - Omega' x V - 2 V x V') + V x* (I V' + H') + Omega' x* H
//          h'  = lin H                              h'' = lin (I Omega' + V x* H)
//   up:    H, H', H'', h', h'' of the subtrees; g = [h x g ; m g] as in packed.hpp
//          L_v  = S.H          L_q  = W.H + S.g     and their derivatives by the product rule
#include "saltus/lagrangian/shadow.hpp"

#include "lagrangian/packed/inertia.hpp"
#include "lagrangian/packed/lane.hpp"
#include "lagrangian/packed/own_terms.hpp"
#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace packed {
namespace {

/// S'' of one joint.
SALTUS_INLINE V6 second_screw(V6 S, V6 W, V6 V, V6 Omega1) {
  return cross_motion(Omega1, S) + cross_motion(V, W);
}

/// Omega', V', V''.
SALTUS_CLONES void set_motion(const PackedTree& t, const Packed& w, ShadowTerm& out) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S_W = w.S_W[b].x[0], *v = w.s_dot[b].x[0], *a = out.s_ddot[b].x[0];
    double* to = out.motion[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 Sa = a[l] * load6(S_W + l, 0), Wv = v[l] * load6(S_W + l, 6);
      store(to + l, 0, Wv - 2 * Sa);
      store(to + l, 6, Wv + Sa);
    }
  }
  for (const PackedGroup& g : t.groups) add_down<12>(g, out.motion, 0);
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S_W = w.S_W[b].x[0], *v = w.s_dot[b].x[0], *a = out.s_ddot[b].x[0];
    const double* V = w.V[b].x[0];
    double* to = out.motion[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = load6(S_W + l, 6);
      const V6 S2 = second_screw(S, W, load6(V + l, 0), load6(to + l, 0));
      store(to + l, 12, v[l] * S2 + (2 * a[l]) * W);
    }
  }
  for (const PackedGroup& g : t.groups) add_down<6>(g, out.motion, 12);
}

/// H', H'', h'' of the subtrees.
SALTUS_CLONES void set_momenta(const PackedTree& t, const Packed& w, ShadowTerm& out) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *body = t.body[b].x[0], *R = w.R[b].x[0], *p = w.p[b].x[0];
    const double *twist = w.V[b].x[0], *motion = out.motion[b].x[0];
    double* to = out.momenta[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      // w has I and H of the subtree, not of the body
      const BodyInWorld I = inertia_in_world(body + l, R + l, p + l);
      const V6 V = load6(twist + l, 0), Omega1 = load6(motion + l, 0);
      const V6 V1 = load6(motion + l, 6), V2 = load6(motion + l, 12);
      const V6 H = I * V, I_V1 = I * V1, V_H = cross_force(V, H), H1 = I_V1 + V_H;
      const V6 bent = V2 - cross_motion(Omega1, V) - 2 * cross_motion(V, V1);
      store(to + l, 0, H1);
      store(to + l, 6, I * bent + cross_force(V, I_V1 + H1) + cross_force(Omega1, H));
      store(to + l, 12, I.m * Omega1.v - cross(I.h, Omega1.w) + V_H.v);
    }
  }
  for (const PackedGroup& g : t.groups) add_up<15>(g, out.momenta, 0);
}

/// What each joint adds to kappa = 2 a.L_q - v.L_q' - a.L_v', kappa_q and kappa_v.
SALTUS_CLONES void set_by_joint(const PackedTree& t, const Packed& w, ShadowTerm& out) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *weight = t.weight[b].x[0], *I_h = w.I_h[b].x[0], *momentum = w.H[b].x[0];
    const double *S_W = w.S_W[b].x[0], *twist = w.V[b].x[0], *first = w.first[b].x[0];
    const double *v = w.s_dot[b].x[0], *a = out.s_ddot[b].x[0];
    const double *motion = out.motion[b].x[0], *momenta = out.momenta[b].x[0];
    double* to = out.by_joint[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = load6(S_W + l, 6), V = load6(twist + l, 0);
      const V6 V1 = load6(motion + l, 6), V2 = load6(motion + l, 12);
      const V6 S2 = second_screw(S, W, V, load6(motion + l, 0));
      const V6 W1 = cross_motion(V1, S) + cross_motion(V, W);
      const V6 W2 = cross_motion(V2, S) + 2 * cross_motion(V1, W) + cross_motion(V, S2);

      const V6 H = load6(momentum + l, 0), H1 = load6(momenta + l, 0), H2 = load6(momenta + l, 6);
      const V6 pull{cross(load3(I_h + l, 6), gravity), weight[l] * gravity};
      const V3 pull1 = cross(H.v, gravity), pull2 = cross(load3(momenta + l, 12), gravity);

      const double L_v1 = dot(W, H) + dot(S, H1);
      const double L_v2 = dot(S2, H) + 2 * dot(W, H1) + dot(S, H2);
      const double L_q1 = dot(W1, H) + dot(W, H1) + dot(W, pull) + dot(S.w, pull1);
      const double L_q2 = dot(W2, H) + 2 * dot(W1, H1) + dot(W, H2) + dot(S2, pull) +
                          2 * dot(W.w, pull1) + dot(S.w, pull2);
      to[l] = a[l] * (2 * first[lanes + l] - L_v1) - v[l] * L_q1;
      to[lanes + l] = -L_q2;
      to[2 * lanes + l] = -L_v2 - 2 * L_q1;
    }
  }
}

}  // namespace
}  // namespace packed

FreeMotion::FreeMotion(const Tree& tree, const PackedTree& packed) : products(packed) {
  for (VecX* x : {&a, &force, &L_vq_v}) x->setZero(tree.n_v);
}

// a^T M a = a.force; both products are sums over joints, whichever coordinates drive them.
void free_motion(const Tree& tree, const PackedTree& t, const Packed& w, PackedMatrix& M,
                 FreeMotion& out) {
  multiply_by_rates(t, w, out.products);
  gather(tree, t, w.first, 1, out.force);
  gather(tree, t, out.products.by_joint, 0, out.L_vq_v);
  out.force -= out.L_vq_v;
  for (const PackedBall& ball : t.balls) {  // a ball's L_q holds its w, and what turns is its body
    Vec3 omega, L_v;
    for (int axis = 0; axis < 3; ++axis) {
      omega[axis] = *at(w.s_dot, ball.slot[axis]);
      L_v[axis] = *at(w.first, ball.slot[axis]);
    }
    out.force.segment<3>(ball.velocity) += omega.cross(L_v);
  }
  out.a = out.force;
  solve(tree, t, M, out.a);
  out.kappa = out.a.dot(out.force);
  for (const int slot : t.slot) {
    out.kappa -= *at(w.s_dot, slot) * at(out.products.by_joint, slot)[2 * lanes];
  }
}

ShadowTerm::ShadowTerm(const Tree& tree, const PackedTree& packed) {
  const std::size_t n = static_cast<std::size_t>(packed.slots / lanes);
  kappa_q.setZero(tree.n_v);
  kappa_v.setZero(tree.n_v);
  s_ddot.resize(n);
  motion.resize(n);
  momenta.resize(n);
  by_joint.resize(n);
}

void shadow_gradient(const Tree& tree, const PackedTree& t, const Packed& w, const VecRef& a,
                     ShadowTerm& out) {
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    *at(out.s_ddot, t.slot[i]) = drive.multiplier * a[drive.velocity];
  }
  packed::set_motion(t, w, out);
  packed::set_momenta(t, w, out);
  packed::set_by_joint(t, w, out);
  packed::add_own_shadow(t, w, out);
  if (t.potentials != nullptr) packed::add_potential_shadow(t, w, out);
  out.kappa = 0;
  for (const int slot : t.slot) out.kappa += *at(out.by_joint, slot);
  gather(tree, t, out.by_joint, 1, out.kappa_q);
  gather(tree, t, out.by_joint, 2, out.kappa_v);
}

}  // namespace saltus
