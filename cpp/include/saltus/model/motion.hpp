// Where frames are and how they move, at many configurations at once: for pictures and analysis.
#pragma once

#include "saltus/model/model.hpp"

namespace saltus {

/// A frame fixed to a joint's frame: that of a link or of a shape.
struct AttachedFrame {
  int joint = -1;  ///< -1: the world
  Pose X_JF;       ///< the frame in the joint's
};

/// Of a link, by its index.
SALTUS_EXPORT AttachedFrame link_frame(const Model& model, int link);
/// Of a shape, by its index.
SALTUS_EXPORT AttachedFrame shape_frame(const Model& model, int shape);

/// Homogeneous matrices X_WF, one a row of `q` (rows, n_q): (rows, 16), each row by row.
SALTUS_EXPORT MatX poses(const Model& model, const AttachedFrame& frame,
                         const Eigen::Ref<const MatX>& q);

/// (rows, 6): angular velocity [rad/s] and velocity of the frame's origin [m/s], in world axes.
/// @throws ModelError where q is not (rows, n_q), v not (rows, n_v), or one is not finite.
SALTUS_EXPORT MatX velocities(const Model& model, const AttachedFrame& frame,
                              const Eigen::Ref<const MatX>& q, const Eigen::Ref<const MatX>& v);

}  // namespace saltus
