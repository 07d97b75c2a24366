// From shapes to coordinates: phi_q and phi_qq along the chain of joints between two bodies.
//
// Theory, section 7. Chain from b to a; s_k = +1 on a's branch, -1 on b's; common ancestors drop
// out. P on the contact line, both about the reference point O_k of joint k's tree:
//
//   phi_q[k]    = s_k S_k.N,  N = [P x n; n]
//   phi_qq[i,l] = t_i^T C t_l + n.(s_i w_i x u_l),  t_k = s_k [w_k; u_k], u_k = w_k x P + v_k
//
// with i at or nearer to b and C of the two features that face each other (gap.hpp).
#pragma once

#include <vector>

#include "saltus/collision/gap.hpp"
#include "saltus/collision/pair.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus {

/// Gap of a pair at the configuration in `kin`; see part_gap. Needs set_configuration.
SALTUS_EXPORT Gap pair_gap(const Tree& tree, const Kinematics& kin, const Pair& pair);
/// Likewise, where a moves by `motion_W` against b.
SALTUS_EXPORT Gap pair_gap(const Tree& tree, const Kinematics& kin, const Pair& pair,
                           const Vec3& motion_W);

/// True where the pair is of parts that do not face each other there; see parts.hpp.
SALTUS_EXPORT bool is_silent(const Tree& tree, const Kinematics& kin, const Pair& pair,
                             const Gap& gap);

/// [m] Distance of two edges with their ends, never below minus their radii; of an edge and a
/// cylinder no more than that, but 0 or less only where they are near. Needs a pair of edges
/// (PairKind::crossing) and set_configuration.
SALTUS_EXPORT double edge_distance(const Tree& tree, const Kinematics& kin, const Pair& pair);

/// The plane through a point of b across n, which goes with b: as the pair's b (a half-space). For
/// a corner that is to stay in the plane of a face, also beyond its border.
SALTUS_EXPORT void put_plane_on_b(const Tree& tree, const Kinematics& kin, const Vec3& p_W,
                                  const Vec3& n_W, Pair& pair);

/// Adds the pair's gradient to `phi_q` (n_v), through the drives of mimic joints.
SALTUS_EXPORT void add_gap_gradient(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                    const Gap& gap, Eigen::Ref<VecX> phi_q);

/// Adds the pair's Hessian to `phi_qq` (n_v, n_v), symmetric: v.phi_qq v is the second derivative
/// of phi along q (+) s v, a ball turning at a constant rate.
SALTUS_EXPORT void add_gap_hessian(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                   const Gap& gap, Eigen::Ref<MatX> phi_qq);

/// The velocities that move the pair, in increasing order.
SALTUS_EXPORT void list_velocities(const Tree& tree, const Pair& pair,
                                   std::vector<int>& velocities);

/// The Hessian among these: (k, k) and (k).
SALTUS_EXPORT void set_gap_hessian(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                   const Gap& gap, MatX& phi_qq, std::vector<int>& velocities);

}  // namespace saltus
