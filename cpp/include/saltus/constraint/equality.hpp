// Equalities h(q, t) = 0: loops and couplings between bodies that a tree does not join, and joints
// that move as it is told.
//
// Theory, F6. An end is a frame on a body, P its origin, n the z axis of the second:
//
//   point     P_a - P_b = 0                                   3 rows, world axes
//   weld      the same, and 2 vec(Q_ba) = 0                   6; Q_ba the quaternion of R_ba, w >=
//   0 distance  |P_a - P_b| - distance = 0                      1 on_plane  n.(P_a - P_b) = 0 1
//   coupling  x_a - polynomial(x_b) = 0                       1; displacements of two joints
//   prescribed  x_a - x(t) = 0                                1; of one
//
// Gradients are by (+): of a ball by the rotation, as those of gaps are.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "saltus/tree/kinematics.hpp"

namespace saltus {

/// What an equality ties, see above.
enum class LoopType { point, weld, distance, on_plane, coupling, prescribed };

/// A displacement [rad | m], its rate and the rate of that at one time.
struct PrescribedMotion {
  double x;     ///< [rad | m]
  double rate;  ///< [rad/s | m/s]
  /// [rad/s^2 | m/s^2], where somebody says
  double acceleration = std::numeric_limits<double>::quiet_NaN();
};

/// "point", "weld", ...
SALTUS_EXPORT std::string loop_type_name(LoopType type);
/// Rows of h.
SALTUS_EXPORT int rows_of(LoopType type);

/// One loop, coupling or prescribed joint.
struct Equality {
  /// A frame that moves with a joint's; joint -1: the world. Of a coupling the joint alone.
  struct End {
    int joint = -1;  ///< index in the tree
    Pose X_JE = {};  ///< the frame in the joint's
  };
  std::string name = {};            ///< of the loop; of a coupling or prescribed joint the joint's
  LoopType type = LoopType::point;  ///< what it ties
  End a = {};                       ///< what it ties
  End b = {};                       ///< to what
  double distance = 0;              ///< [m]
  std::vector<double> polynomial = {};                    ///< of a coupling, by rising powers
  std::function<PrescribedMotion(double t)> motion = {};  ///< of a prescribed joint
  double lock = 0;                                        ///< likewise, see locks_of
  int first = 0;                                          ///< row
};

/// Frozen; written by build().
struct EqualityModel {
  std::vector<Equality> all;  ///< loops, then couplings, then prescribed joints
  int rows = 0;               ///< of h, of all of them
};

/// By columns, each a vector in the space of velocities.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

/// h and its gradients at one configuration.
struct EqualityValues {
  EqualityValues() = default;
  /// Sized for a model.
  SALTUS_EXPORT EqualityValues(int n_v, int rows);
  VecX h;      ///< (m) [m | rad]
  VecX size;   ///< (m) of the terms that h is a difference of, for rounding
  Columns A;   ///< (n_v, m) column k is the gradient of h_k
  VecX drive;  ///< (m) -dh/dt: A^T v where h stays 0
};

/// What is added to the diagonal of M and J at velocities (n_v) that move as they are told, whose
/// own inertia may be none (theory, F7): an inertia as large as those of the model. Empty where
/// there are none. EqualitySolver::lock takes the same out of multipliers, by row.
SALTUS_EXPORT VecX locks_of(const Tree& tree, const EqualityModel& model);

/// Joints whose poses set_equalities reads.
SALTUS_EXPORT std::vector<int> joints_read(const Tree& tree, const EqualityModel& model);

/// Needs the poses of joints_read in `kin`; does not allocate.
SALTUS_EXPORT void set_equalities(const Tree& tree, const EqualityModel& model,
                                  const Kinematics& kin, const VecRef& q, double t,
                                  EqualityValues& out);

/// What A^T a is where h stays 0 along the motion: drive' - A'^T v (m). Not a number where the
/// acceleration of a prescribed joint is not known. Needs set_velocity in `kin`.
SALTUS_EXPORT void set_needed_accelerations(const Tree& tree, const EqualityModel& model,
                                            const Kinematics& kin, const VecRef& v, double t,
                                            VecX& out);

}  // namespace saltus
