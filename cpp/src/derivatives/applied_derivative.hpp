// What acts at points of bodies: forces that are applied, springs and dampers between two points.
//
// A force f at a point P pushes with J^T f, J = dP/dq. By f of a covector of Q that is J times it;
// by stiffness, length and damping of a spring, with d, n and d' of its line and J of its ends'
// distance:
//
//   Q = J^T n (-k (d - l) - c d')
#pragma once

#include "derivatives/parameters.hpp"

namespace saltus {

/// Q += J^T force. `w` is placed.
void add_push(const ModelData& model, const Packed& w, const AppliedWrench& at, const Vec3& force,
              VecX& Q);
/// Its transpose: J Q.
Vec3 pull_push(const ModelData& model, const Packed& w, const AppliedWrench& at, const VecX& Q);

/// Of an arc, with the covector of its Q.
void add_spring_gradient(const ModelData& model, const ArcDerivative& arc, const VecX& Q,
                         ParameterGradient& to);

}  // namespace saltus
