// Are the derivatives of a user's force right? Compared with central differences.
#pragma once

#include <string>

#include "saltus/model/model.hpp"

namespace saltus {

/// Of a force or a potential of the model, by its name: Q_q and Q_v, or gradient and Hessian, at
/// random configurations and rates, each entry against differences of two sizes.
/// @throws ModelError with the worst entry, what the function says, what differences say, and the
/// order by which the two approach each other: 2 where the derivative is right, 0 where it is
/// wrong. And where there is no such name, or the function returns Q alone.
SALTUS_EXPORT void check_derivatives(const Model& model, const std::string& name);

/// The same of a force that no model has.
SALTUS_EXPORT void check_derivatives(const Model& model, const FunctionForce& force);

}  // namespace saltus
