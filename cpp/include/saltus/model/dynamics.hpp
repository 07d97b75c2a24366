// What frames.hpp computes, at many configurations: one a row, kinematics once a row.
//
// q is (rows, n_q); v, a and forces are (rows, n_v). An argument of one row stands for all rows.
// @throws ModelError where widths or numbers of rows differ, or a value is not finite; the message
// has the row. t is the time of joints that move as they are told, one of all rows.
#pragma once

#include <optional>

#include "saltus/model/frames.hpp"

namespace saltus {

/// Arrays by rows.
using RowsRef = Eigen::Ref<const MatX>;

/// Poses of all links, (rows, links * 16): homogeneous matrices, each row by row.
SALTUS_EXPORT MatX all_poses(const Model& model, const RowsRef& q);
/// Those of all shapes, (rows, shapes * 16).
SALTUS_EXPORT MatX all_shape_poses(const Model& model, const RowsRef& q);

/// (rows, 6 * n_v), each row by row; with a point [m] of the link (rows, 3 * n_v).
SALTUS_EXPORT MatX jacobians(const Model& model, const RowsRef& q, int link,
                             const std::optional<Vec3>& p_L = {});

SALTUS_EXPORT MatX centres_of_mass(const Model& model, const RowsRef& q);  ///< (rows, 3) [m]

/// (rows, 6) about points p_W (rows, 3) [m] in the world.
SALTUS_EXPORT MatX momenta(const Model& model, const RowsRef& q, const RowsRef& v,
                           const RowsRef& p_W);

SALTUS_EXPORT MatX gravity_forces(const Model& model, const RowsRef& q);  ///< (rows, n_v)
/// (rows, n_v), see Frames::inverse_dynamics.
SALTUS_EXPORT MatX inverse_dynamics(const Model& model, const RowsRef& q, const RowsRef& v,
                                    const RowsRef& a, double t = 0);
/// (rows, n_v), see Frames::accelerations.
SALTUS_EXPORT MatX accelerations(const Model& model, const RowsRef& q, const RowsRef& v,
                                 const RowsRef& forces, double t = 0);

}  // namespace saltus
