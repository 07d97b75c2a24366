// The rates u of the active rows in an arc: of gaps by its end, of what slides in its middle.
#pragma once

#include "variational/arc/solve.hpp"

namespace saltus {

/// Writes rows.u at arc.v, and the rows' gradients du/dv. Needs set_row_residual.
void set_row_rates(const Scene& scene, const Node& node, ArcWork& work);

/// Writes rows.u alone: the gradients are those of before. Needs set_row_residual.
void look_at_rates(const Scene& scene, const Node& node, ArcWork& work);

}  // namespace saltus
