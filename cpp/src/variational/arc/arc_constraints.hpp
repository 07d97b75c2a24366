// The constraints of an arc in Newton's method.
#pragma once

#include "variational/arc/arc.hpp"

namespace saltus {

/// E_d [J] at the last evaluation.
double discrete_energy(const ModelData& model, const ArcProblem& problem, const VecX& v,
                       const ArcScratch& s);

/// J dv - N dlambda = r, C dv = -c, by the Schur complement C J^-1 N: changes s.dv, which is J^-1
/// r, and the constraints' lambda.
void add_constraints(const ModelData& model, const ArcProblem& problem, const VecX& v,
                     ArcScratch& s);

/// How far the constraints are from closed, scaled like the momentum residual.
double constraint_residual(const ModelData& model, const ArcProblem& problem, const VecX& v,
                           ArcScratch& s);

}  // namespace saltus
