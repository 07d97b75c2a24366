// How two bodies slide on each other where they touch: rows of the relative velocity at a point.
//
// With P the place of contact, and the material points of a and b that are there now,
//
//   d.(v_a(P) - v_b(P)) = sum_k d.(s_k (w_k x P + v_k)) v[k]       chain from b to a, contact.hpp
//
// d = n gives the gap's gradient phi_q, d = t0, t1 the two rows T of the tangential motion.
#pragma once

#include "saltus/collision/contact.hpp"

namespace saltus {

/// t0, t1, n are right-handed and orthonormal.
struct Tangents {
  Vec3 t0, t1;
};

/// The coordinate axis that n is farthest from; of those equal to 1e-6 y, then z, then x.
SALTUS_EXPORT int tangent_axis(const Vec3& n_W);

/// t1 is that axis but for its part along n, so that in a scene in a coordinate plane t0 lies in
/// the plane and t1 across it, exactly. Needs an axis that n is not along.
SALTUS_EXPORT Tangents tangents(const Vec3& n_W, int axis);

/// What a change dn of n makes of t = tangents(n, axis).
SALTUS_EXPORT Tangents turned(const Tangents& t, const Vec3& n, int axis, const Vec3& dn);

/// Of a unit of a joint's own velocity: how it turns what it carries, and the velocity at a point.
struct Screw {
  Vec3 w = Vec3::Zero(), xi = Vec3::Zero();
};
SALTUS_EXPORT Screw screw_at(const Tree& tree, const Kinematics& kin, int joint, const Vec3& P_W);

/// Where the two touch: halfway between the witnesses, which are one point where phi = 0.
inline Vec3 contact_point(const Gap& gap) { return (gap.p_WA + gap.p_WB) / 2; }

/// Where friction acts: where the two touch. While they are apart it is on the surface of a, if b
/// does not move: so that the arm of what lands is that which it has when it has landed.
inline Vec3 friction_point(const Gap& gap, const Pair& pair) {
  return pair.on_b.joint < 0 ? gap.p_WA : contact_point(gap);
}

/// Adds the gradient of the motion along d_W, at P_W, to `row` (n_v), through the drives of mimic
/// joints.
SALTUS_EXPORT void add_motion_gradient(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                       const Vec3& P_W, const Vec3& d_W, Eigen::Ref<VecX> row);

/// How a moves against b at the velocity v: how it turns, and its velocity at P_W.
SALTUS_EXPORT Screw relative_motion(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                    const Vec3& P_W, const VecRef& v);

/// What a change of the configuration makes of the rows T (tangents(n, axis), at contact_point)
/// where the velocity v stays: adds `factor` times the derivatives of T v by the velocities that
/// move one against the other to `c0`, `c1` (n_v). What moves both turns the tangents in their
/// plane, no more. With joint j moving the body a against b by t_j = s_j [w_j; xi_j] (section 7), b
/// itself where j is on its branch, U and W the velocity of a against b at P and how it turns,
///
///   (d.U)' = d'.U + d.(W x P') + d.(w_j x U_j - W_j x xi_j)     U_j, W_j those of joints below j
SALTUS_EXPORT void add_slip_change(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                   const Gap& gap, int axis, const VecRef& v, double factor,
                                   Eigen::Ref<VecX> c0, Eigen::Ref<VecX> c1);

}  // namespace saltus
