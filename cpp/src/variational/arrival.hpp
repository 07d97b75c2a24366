// The end of an arc: what touches there, and the closing half kick.
//
// p_end = p_start + tau L_q has the second half of the gravity, ... of the whole arc in it, and
// what the arc held closed takes that up: a plastic projection onto the rates of the arc's own
// constraints. Those are not the contacts of the node. A corner that is held in the plane of a face
// may have slid over its border, and bore its load to the end; without it the half kick would be
// taken for an approach of what comes next there: of the edges that cross at the border, or of a
// second table. With it they find a body at rest, u = 0, and the next arc presses them.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

/// Puts the node at the end of flight.arc, at time t. Writes contacts, p and v.
/// @return false where the mass matrix is singular.
bool arrive_at_node(const ModelData& model, const StepOptions& options, double t, Flight& flight,
                    Node& node);

}  // namespace saltus
