// A model at one configuration: its kinematics once, then all that follows from them.
//
// A Frames is a workspace: set() moves it to another configuration without allocating, and one is
// used by one thread at a time. World axes and [angular; linear] throughout; v, a and forces are by
// velocity (n_v), of free and ball joints in their parents' axes.
//
//   poses        X_WL of a link, X_WG of a shape
//   jacobian     J (6, n_v): J v is the angular velocity and that of the frame's origin
//   statics      gravity_forces, centre_of_mass, momentum
//   dynamics     M a + c(q, v) = forces + gravity_forces + potentials, c = 0 at rest
//
// Springs, other potentials and joints' armature are in the dynamics, and so are loops, couplings
// and joints that move as they are told (loop_dynamics.hpp), at time t. Contacts, limits, damping,
// friction, motors and forces that are functions are not.
#pragma once

#include <optional>

#include "saltus/lagrangian/newton_euler.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/model/loop_dynamics.hpp"
#include "saltus/model/motion.hpp"

namespace saltus {

/// The gaps of all pairs, from kinematics that set_configuration or copy_poses wrote.
/// @throws ModelError where the dense result would not fit into 1 GiB.
SALTUS_EXPORT Gaps gaps_at(const Model& model, const Kinematics& kin);

/// A workspace at one configuration, see above.
class SALTUS_EXPORT Frames {
 public:
  /// At Model::neutral.
  explicit Frames(const Model& model);
  /// @throws ModelError as Model::checked_q.
  Frames(const Model& model, const VecRef& q);

  /// Moves to another configuration. `what` names it in messages.
  void set(const VecRef& q, const std::string& what = "q");

  /// The model that it is of.
  const Model& model() const { return model_; }
  const VecX& q() const { return q_; }  ///< (n_q)

  /// X_WF, the frame in the world.
  Pose pose(const AttachedFrame& frame) const;
  /// X_WL of a link.
  Pose pose(int link) const { return pose(link_frame(model_, link)); }
  /// X_WG of a shape.
  Pose shape_pose(int shape) const { return pose(shape_frame(model_, shape)); }
  /// Homogeneous matrices of all links (links, 16) and shapes (shapes, 16), each row by row.
  MatX all_poses() const;
  /// The same of all shapes.
  MatX all_shape_poses() const;

  /// J (6, n_v) of a frame's origin; out is resized where it must be.
  void jacobian(const AttachedFrame& frame, MatX& out) const;
  /// The same of a link's frame.
  MatX jacobian(int link) const;
  /// (3, n_v): the velocity of a point that is fixed to a link; p_L [m] in the link's frame.
  MatX jacobian(int link, const Vec3& p_L) const;

  double mass() const;    ///< [kg] of all that moves
  Vec3 centre_of_mass();  ///< [m] of all that moves; @throws ModelError where nothing has mass
  /// Spatial momentum [kg m^2/s; kg m/s] about the world's origin.
  Vec6 momentum(const VecRef& v);

  /// (n_v) [N m | N] what gravity does to the coordinates, less what is compensated; holding
  /// still takes its opposite.
  void gravity_forces(VecX& out);
  /// M a + c - gravity_forces - potentials (n_v): the forces that make these accelerations. Where
  /// there are loops many do; these are what the loops do not take, 0 of joints that move as they
  /// are told.
  /// @throws ModelError where a loop is open, or v or a would open it
  void inverse_dynamics(const VecRef& v, const VecRef& a, VecX& out, double t = 0);
  /// The accelerations (n_v) under gravity and `forces` (n_v), which keep loops closed.
  /// @throws StepError where the mass matrix is singular; ModelError where a loop is open, or opens
  void accelerations(const VecRef& v, const VecRef& forces, VecX& out, double t = 0);

  Gaps gaps();  ///< as Model::gaps
  /// M(q), (n_v, n_v).
  MatX mass_matrix() { return saltus::mass_matrix(model_->tree, model_->packed, q_); }

 private:
  void move(const VecRef& v);
  void set_tree_forces(const VecRef& v, const VecRef& a, VecX& out);  ///< of the tree alone
  void factorize_mass();
  void sum_masses();            ///< subtrees' I, h and U, once a configuration
  Vec3 origin(int tree) const;  ///< [m] p_WO of a tree of `packed`

  Model model_;
  VecX q_;
  Packed w_;
  PackedForces forces_;
  std::optional<PackedMatrix> M_;      ///< made where it is first needed
  std::optional<LoopDynamics> loops_;  ///< where the model has some
  VecX zero_;                          ///< (n_v)
  bool summed_ = false;
};

}  // namespace saltus
