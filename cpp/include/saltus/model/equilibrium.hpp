// Where a model rests under its springs, weights and constant controls.
#pragma once

#include "saltus/model/model.hpp"

namespace saltus {

/// The minimum of V minus the work of the controls near q, on the loops and within joints' limits;
/// contacts of shapes, damping and dry friction have no say. Newton's method with the curvature of
/// both; where that is negative it goes downhill all the same.
/// @param control (n_u) or empty: 0
/// @param keep velocities whose coordinates stay as they are
/// @throws ModelError where it finds none, and where what it finds is no minimum: it says which
/// coordinate would fall away from there.
SALTUS_EXPORT VecX equilibrium(const Model& model, const VecRef& q, const VecX& control = {},
                               const std::vector<int>& keep = {});

}  // namespace saltus
