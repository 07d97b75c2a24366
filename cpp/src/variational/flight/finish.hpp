// The end of an arc: a node, and the closing half kick.
//
// p_end = p_start + tau L_q has the second half of gravity's and all other forces' kick in it, and
// what the arc held closed takes that up: an impact without rebound, onto the rates of the arc's
// own rows. Those are not the contacts of the node. A corner may have slid over the border of its
// face, an edge off another's end, and bore the load to the arc's end; without it the half kick
// would be taken for an approach of what comes next there: edges that cross at the border, a second
// table, a corner that has come onto the face. With it they find a body at rest, u = 0, and the
// next arc presses them. Where it bore the load is off by what it slid in one arc, O(h), for that
// arc.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Puts the node at the end of flight.arc, at time t. Writes q, p, v, contacts, and the impulses of
/// the closing half kick, flight.closings.
/// @return false where the mass matrix is singular.
bool finish(const ModelData& model, const StepOptions& options, double t, Flight& flight,
            Node& node);

}  // namespace saltus
