// What acts at points of bodies: forces that are applied, springs and dampers between two points.
//
// A force f at a point P pushes with J^T f, J = dP/dq. By f of a covector of Q that is J times it.
// With a_k the axes of joints above, a torque n pushes with a_k.n, which changes by n.(a_j x a_k)
// as a joint j above k turns its axis; what is in the body's axes changes by a_j x f, too; by
// stiffness, length and damping of a spring, with d, n and d' of its line and J of its ends'
// distance:
//
//   Q = J^T n (-k (d - l) - c d')
#pragma once

#include "derivatives/parameters.hpp"

namespace saltus {

/// Q += J^T of a force and a torque, along AppliedWrench::axes or the world's. `w` is placed.
void add_push(const ModelData& model, const Packed& w, const AppliedWrench& at, const Vec3& force,
              const Vec3& torque, VecX& Q);

/// Its transpose: J Q.
struct PulledWrench {
  Vec3 force, torque;
};
PulledWrench pull_push(const ModelData& model, const Packed& w, const AppliedWrench& at,
                       const VecX& Q);

/// What Newton's matrix leaves out: how torques, and forces in the body's axes, change as the body
/// and the joints' axes turn. Columns of w.coupled beyond the first `own`, which are others'; and
/// adds to G. Needs second_pass.
void add_wrench_slopes(const ModelData& model, const std::vector<AppliedWrench>& wrenches,
                       Eigen::Index own, Packed& w);

/// Of an arc, with the covector of its Q.
void add_spring_gradient(const ModelData& model, const ArcDerivative& arc, const VecX& Q,
                         ParameterGradient& to);

}  // namespace saltus
