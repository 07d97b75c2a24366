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
#include "saltus/tree/kinematics.hpp"

namespace saltus {

/// One joint between the two bodies of a pair.
struct ChainJoint {
  int joint;
  double sign;  ///< +1 on a's branch, -1 on b's
};

/// A shape and the joint frame that carries it (-1: the world).
struct Placed {
  Shape shape;
  int joint = -1;
  Pose X_JG;  ///< placement in the joint's frame
};

/// A shape of a link.
struct PlacedShape : Placed {
  int link = 0;      ///< index of the link it belongs to
  std::string name;  ///< unique: the link's name, "#k" added where a link has several shapes
};

/// How the gap of a pair is found; see parts.hpp.
enum class PairKind {
  whole,     ///< the signed distance of two solids
  corner,    ///< that of a corner or end of one of them, which is a, from the other
  crossing,  ///< that of two edges, where they cross; nothing where they do not
};

/// Which place of a cylinder's rims a part is about.
enum class RimPart {
  none,
  nearest,  ///< of one rim, against all of the other shape
  in,       ///< where an edge goes in over a rim: seen along its own axis
  out,      ///< where it comes out
  left,     ///< where two rims cross that lie flat on each other: one place
  right,    ///< and the other
};

/// epsilon_phi by the size of the smaller shape: far above the rounding of positions (1e-16 of the
/// scene) and far below what anybody can see.
inline constexpr double relative_touch = 1e-10;

/// One gap that is watched: two shapes, or a part of one and the other.
struct Pair {
  int a = -1, b = -1;  ///< indices of shapes
  int part = 0;        ///< which of the gaps of these two shapes
  PairKind kind = PairKind::whole;
  Placed on_a, on_b;            ///< the parts that face each other; b alone may be a half-space
  RimPart rim = RimPart::none;  ///< not none: a is the cylinder
  /// Out of the shape, in the part's frame: of an edge between its two faces, with n.out >= 1 for
  /// all n from one's normal to the other's; along the axis for a rim
  /// and its points; 0 for an axis.
  Vec3 out_a = Vec3::Zero(), out_b = Vec3::Zero();
  std::vector<Vec3> inward;    ///< corner, rim: along the edges that meet in it, in its frame; none
                               ///< where it is round or the other has no flat faces
  bool lists_edges = false;    ///< those of the two shapes have gaps of their own where they cross
  bool skips_corners = false;  ///< corners have gaps of their own: none where one is nearest
  std::vector<ChainJoint> chain;  ///< from b to a: nearest to b first
  double touch = 0;               ///< [m] epsilon_phi: |phi| below this is touching
};

/// Joints between two joint frames (-1: the world), ordered from b to a.
SALTUS_EXPORT std::vector<ChainJoint> chain_between(const Tree& tree, int joint_b, int joint_a);

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

/// Adds the pair's Hessian to `phi_qq` (n_v, n_v), symmetric: v.phi_qq v is the second derivative of
/// phi along q (+) s v, a ball turning at a constant rate.
SALTUS_EXPORT void add_gap_hessian(const Tree& tree, const Kinematics& kin, const Pair& pair,
                                   const Gap& gap, Eigen::Ref<MatX> phi_qq);

}  // namespace saltus
