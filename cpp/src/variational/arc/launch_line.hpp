// The line of an arc after an impact: a change lambda of the last strong impulse, along n.
//
// Where it is matched it has an equation, E_d(v) = energy (paper, (11c); theory, section 5), which
// Newton's method takes out of the arc's linear system first: J dv - n dlambda = r, row.dv = -c.
#pragma once

#include "saltus/spatial/spatial.hpp"

namespace saltus {

struct ModelData;
struct ArcProblem;
struct ArcScratch;

struct LaunchLine {
  enum class Use { none, given, matched };
  Use use = Use::none;
  double energy = 0;  ///< [J] where it is matched
  double lambda = 0;  ///< [N s] given, or guess in and solution out
  VecX n;             ///< (n_v) direction of the impulse
  VecX row, column;   ///< (n_v) dE_d/dv and J^-1 n, written by take_out_line
  double own = 1;     ///< row.column, likewise
};

/// E_d [J] at the last evaluation.
double discrete_energy(const ModelData& model, const ArcProblem& problem, const VecX& v,
                       const ArcScratch& s);

/// Meets the line in s.dv, which is J^-1 r: changes s.dv and lambda.
void take_out_line(const ModelData& model, const ArcProblem& problem, const VecX& v, ArcScratch& s);

/// How far a matched line is from met, scaled like the momentum residual; else 0.
double line_residual(const ModelData& model, const ArcProblem& problem, const VecX& v,
                     const ArcScratch& s);

}  // namespace saltus
