// What impulses at the holds of a flight change in its arc: W = C J^-1 [N; T]^T, and what they are.
//
// C are the rows that the arc's constraints have: phi_q at its end, T in its middle. J is the
// arc's Newton matrix, N and T the rows at its start, where the forces act.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

inline const Contact& contact_of(const Node& node, const ArcConstraint& hold) {
  return node.contacts[node.contact_of[hold.place]];
}

/// Impulse of a hold over the arc, in its tangents.
Vec3 impulse_of(const Node& node, const ArcConstraint& hold, Flight& flight);

/// Rows T of a hold in the middle of the arc.
void add_slide_rows(const ModelData& model, const ArcConstraint& hold, ArcScratch& s, VecX& t0,
                    VecX& t1);

/// Writes W, at_start, u (rates at the arc's end and middle), p and flight.slip.row for the holds
/// in flight.slip.friction.contact. One Newton step of flight.arc.v goes before.
/// @return false where there is no number
bool set_slip_blocks(const ModelData& model, const StepOptions& options, Node& node,
                     Flight& flight);

}  // namespace saltus
