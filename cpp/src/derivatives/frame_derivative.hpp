// The rows of a contact, n and two tangents, and how they turn with the configuration.
//
// Row d of joint k is s_k d.xi_k(P), xi_k the velocity at P of a unit of its screw. With joint j
// the body a moves against b by t_j = s_j [w_j; xi_j], b itself where j is on its branch, and
// screws below it turn:
//
//   row_k' = s_k [d'.xi_k + d.(w_k x P') + d.(w_j x xi_k - w_k x xi_j)]      the last where j is
//   above k
//
// Tangents follow from n (slip.hpp), or are fixed in b.
#pragma once

#include <array>

#include "saltus/collision/slip.hpp"
#include "saltus/model/model.hpp"

namespace saltus {

/// Which tangents, and at which point.
struct FrameChoice {
  int axis = -1;                                           ///< tangents(n, axis); -1: fixed in b
  std::array<Vec3, 2> t_B = {Vec3::Zero(), Vec3::Zero()};  ///< those, in b's joint's frame
  bool at_a = false;  ///< at the witness on a; else halfway between both
};

struct FrameDerivative {
  std::array<VecX, 3> row;      ///< (n_v) n, t0, t1
  std::array<MatX, 3> H;        ///< (k, k) row i by velocity j, among
  std::vector<int> velocities;  ///< these
};

void set_frame(const ModelData& model, const Kinematics& kin, const Pair& pair,
               const FrameChoice& choice, FrameDerivative& out);

/// The row of one velocity, which does not turn.
void set_joint_frame(const ModelData& model, int velocity, FrameDerivative& out);

/// to += factor (what dq makes of row i).
void add_row_change(const FrameDerivative& frame, int i, const VecX& dq, double factor, VecX& to);
/// Its transpose.
void add_row_covector(const FrameDerivative& frame, int i, const VecX& row_hat, double factor,
                      VecX& q);

/// Covectors of rows n, t0, t1, and of motions of a against b along them.
struct RowCovectors {
  std::array<VecX, 3> row;     ///< (n_v) or empty: 0
  Vec3 motion = Vec3::Zero();  ///< [1/m]
};

/// Adds what steps of joints' placements, in the axes of their parents, make of both: to (joints of
/// the tree, 3). Such a step moves what is beyond the joint, as a screw that does not turn.
void add_row_placements(const ModelData& model, const Kinematics& kin, const Pair& pair,
                        const FrameChoice& choice, const RowCovectors& hat, MatX& to);

}  // namespace saltus
