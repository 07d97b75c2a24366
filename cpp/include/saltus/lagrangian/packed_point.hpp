// Points fixed to bodies, and what moves them: for springs, dampers and forces between points.
//
//   J_i = lin(S_i) + ang(S_i) x P        column of joint i at or above, P from O of the tree
#pragma once

#include <vector>

#include "saltus/lagrangian/packed.hpp"

namespace saltus {

/// A joint that moves a point.
struct PointMover {
  int slot;
  int velocity;
  double multiplier;
};

/// A BodyPoint with the path above it; without one it is fixed to the world.
struct PackedPoint {
  int slot = -1;  ///< of its joint
  int root = -1;  ///< slot of the root of its tree
  Vec3 p_J = Vec3::Zero();
  std::vector<PointMover> movers;  ///< from its joint to the root
};

SALTUS_EXPORT PackedPoint pack_point(const Tree& tree, const PackedTree& packed,
                                     const BodyPoint& point);

/// [m] from O of its tree, in world axes; of a fixed one from the world's origin. Needs place.
SALTUS_EXPORT Vec3 position_from_O(const Packed& w, const PackedPoint& point);
/// [m] of O of its tree in the world, 0 of a fixed one. Needs place.
SALTUS_EXPORT Vec3 origin_of(const Packed& w, const PackedPoint& point);

/// Three numbers of a slot.
inline Vec3 three(const double* x) { return {x[0], x[lanes], x[2 * lanes]}; }
/// Six of them.
inline Vec6 six(const double* x) { return spatial(three(x), three(x + 3 * lanes)); }

/// J of one joint, P from O.
inline Vec3 motion_of(const Packed& w, int slot, const Vec3& P) {
  const double* S = at(w.S_W, slot);
  return three(S + 3 * lanes) + three(S).cross(P);
}

/// Q += sign J^T f by velocity, and its size; f in the world's axes at P.
SALTUS_EXPORT void add_pull(const Packed& w, const PackedPoint& point, const Vec3& P, const Vec3& f,
                            VecX& Q, VecX& size);

/// G += J x f, what f at P makes of L_qq (theory, F1); needs second_pass.
SALTUS_EXPORT void add_pull_partials(const PackedPoint& point, const Vec3& P, const Vec3& f,
                                     Packed& w);

/// Columns += sign J^T, three of them, one for each axis of the world. `columns` starts at zero.
SALTUS_EXPORT void add_motion(const Packed& w, const PackedPoint& point, const Vec3& P, double sign,
                              Eigen::Ref<MatX, 0, Eigen::OuterStride<>> columns);

/// For who uses L_q; needs place. Where the ends of a spring meet it pulls in no direction.
/// @throws StepError that names the spring, unless its length is 0
SALTUS_EXPORT void check_springs(const PackedTree& packed, const Packed& w, double time = 0);

/// What forces on balls add to the L_q' and L_v' of an arc, which arc_pass makes without them:
/// Q, and tau/2 c2 f x Q (packed.hpp). Needs arc_pass.
SALTUS_EXPORT void add_ball_pull(const PackedTree& packed, double tau, const VecX& Q, Packed& w);

}  // namespace saltus
