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

/// Of all forces and potentials of the model, at two places beside q (n_q), once a model: where a
/// stepper first starts. Each entry is judged by central differences and one-sided ones: those that
/// differ from each other, as at a kink, judge nothing, nor do places that a function refuses.
/// Nothing is asked of forces that return Q alone.
/// @throws ModelError with the entry, what the function says, and what differences say
SALTUS_EXPORT void check_derivatives_once(const Model& model, const VecRef& q, double t);

}  // namespace saltus
