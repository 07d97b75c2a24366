// Configurations and velocities that a model's loops and couplings allow.
#pragma once

#include "saltus/model/model.hpp"

namespace saltus {

/// The configuration with h(q, t) = 0 that Newton's method finds from q, each step the shortest
/// there is in the metric of the mass matrix. Of a model without loops q itself.
/// @param keep velocities whose coordinates stay as they are
/// @throws ModelError where it finds none, with the loop that stays open and by how much
SALTUS_EXPORT VecX close_loops(const Model& model, const VecRef& q,
                               const std::vector<int>& keep = {}, double t = 0);

/// The velocities nearest to v, in the same metric, that keep the loops closed.
/// @param keep velocities that stay as they are
/// @throws ModelError where those that stay leave none
SALTUS_EXPORT VecX consistent_velocity(const Model& model, const VecRef& q, const VecRef& v,
                                       const std::vector<int>& keep = {}, double t = 0);

/// h and its gradients at q and t.
SALTUS_EXPORT EqualityValues loop_values(const ModelData& model, const VecRef& q, double t = 0);

/// h (m) at q and t, in the order of model->equalities.
SALTUS_EXPORT VecX loop_gaps(const Model& model, const VecRef& q, double t = 0);

/// The loop or coupling that row k of h is of.
SALTUS_EXPORT const Equality& equality_of(const ModelData& model, int row);

}  // namespace saltus
