// Loops in an arc: they push along A at its start, and are closed again at its end.
//
// Theory, F6, as RATTLE has it:
//
//   p_start = p + A(q) mu        h(q (+) tau v, t + tau) / tau = 0   (tau = 0: A^T v = drive)
//
// Newton's method takes them out of the arc's linear system, J dv - A dmu = r, C^T dv = -h / tau,
// with C = K^T A(q_end) (packed_matrix.hpp). The closing half kick is the node's (equalities.hpp).
#pragma once

#include "variational/node/equalities.hpp"

namespace saltus {

struct ArcProblem;
struct ArcScratch;
struct Arc;

struct ArcLoops {
  explicit ArcLoops(const ModelData& model);
  const Columns* A = nullptr;  ///< (n_v, m) at the arc's start; written by arc_problem
  VecX mu;                     ///< (m) [N s | N m s] guess in, solution out
  VecX push, size;             ///< (n_v) A mu, and of its terms
  EqualityValues end;          ///< at the arc's end, or its start where tau = 0
  EqualitySolver solver;       ///< of J, A and C
  VecX dmu;                    ///< (m) of the last step
  std::vector<int> joints;     ///< whose poses h needs
  VecX rate;                   ///< (m) scratch
};

/// Adds A mu to the residual r and, unless the scale is kept, its size to the scale.
void add_push(const ArcProblem& problem, ArcScratch& s, bool keep_scale);

/// Writes h and its gradients at the end of the arc. @return how far it is from 0, as a part of the
/// terms that it is a difference of
double loop_residual(const ModelData& model, const ArcProblem& problem, const VecX& v,
                     ArcScratch& s);

/// Meets the loops in s.dv, which is J^-1 r: changes s.dv and mu. Needs loop_residual.
/// @return false where their rank changes
bool take_out_loops(const ModelData& model, const ArcProblem& problem, ArcScratch& s);

/// Takes half of the last step back.
void halve_step(ArcScratch& s);

/// Meets them in dv/dtau of an arc just solved: h(q (+) tau v(tau)) stays 0. Needs the factors.
void hold_rate(const ModelData& model, const Arc& arc, ArcScratch& s, VecX& rate);

}  // namespace saltus
