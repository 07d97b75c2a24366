// What impulses of the rows change in an arc.
//
// The rates u of the active rows have gradients C = du/dv. An impulse, along the rows B = [N; T] at
// the arc's start, changes them by
//
//   W = C J^-1 B^T,   J the arc's Newton matrix
//
// which is symmetric but for O(h), as bodies turn within the arc. It is not made so: a mean with
// its transpose would have twice the rank, with stiff directions where there is no motion at all.
#pragma once

#include "variational/arc/solve.hpp"

namespace saltus {

/// With the impulses in rows.p, which rows.momentum has added.
/// @return how far arc.v is from the arc's equation
double set_row_residual(const Scene& scene, const Node& node, ArcWork& work);

/// One Newton step of arc.v, with the impulses as they are, and the rates u after it.
/// @return false where there is no number
bool step_row_rates(const Scene& scene, const Node& node, ArcWork& work);

/// Writes the blocks of W and the linearised rows. Needs step_row_rates.
void set_row_blocks(const Scene& scene, const Node& node, ArcWork& work);

}  // namespace saltus
