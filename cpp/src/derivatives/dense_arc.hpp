// The derivative of an arc as a matrix: for all directions at once it is cheaper than one by one.
//
// With the parts of arc_derivative.hpp, as matrices, and G = (L_vq - tau/2 C f_q) half,
// N = f_v + tau/2 f_q C, where rows of balls also have w x of L_vq, L_vv, and dv x L_v,
//
//   dv = J^-1 (K dp - G dq)
//   dq+ = whole dq + tau K dv         dp+ = dp + tau [f_q half dq + N dv]
//
// A force dQ is in it too: K dp has tau/2 C dQ beside it, so that it acts as dp = tau/2 K^-1 C dQ
// does, and pushes by tau dQ - dp more.
#pragma once

#include "derivatives/held_derivative.hpp"
#include "saltus/lagrangian/second_partials.hpp"

namespace saltus {

/// Scratch of set_dense, for all arcs of a step.
struct DenseScratch {
  explicit DenseScratch(const ModelData& model) : rows(model.packed) {}
  SecondPartials rows;
  LagrangianPartials L;
  MatX f_q, J, G, N, dv, part;
};

/// True where nothing but the arc's own equation is in it: no contact, no energy to meet.
bool is_plain(const FlownArc& arc);

/// Writes arc.dense (2 n_v, 2 n_v) of a plain arc, unless it is there.
/// @return false where its matrix has no inverse that is a number
bool set_dense(const ModelData& model, FlownArc& arc, DenseScratch& scratch);

/// Z <- arc.dense Z + what forces dQ (n_v, columns) and durations `left` (columns) add.
/// @param dQ without columns: none
void push_dense(const ModelData& model, FlownArc& arc, const MatX& dQ, const VecX& left,
                bool is_unit, MatX& Z);

}  // namespace saltus
