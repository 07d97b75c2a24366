// What impulses at the holds of a flight change in its arc, and what they are.
//
// The rates u are those of the arc's constraints, with rows C: of the gap by its end, and T v in
// its middle. An impulse, along the rows [N; T] at the arc's start, changes them by
//
//   W = C J^-1 [N; T]^T,   J the arc's Newton matrix
//
// which is symmetric but for O(h), as bodies turn within the arc. It is not made so: a mean with
// its transpose would have twice the rank, with stiff directions where there is no motion at all.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

inline const Contact& contact_of(const Node& node, const ArcConstraint& hold) {
  return node.contacts[node.contact_of[hold.place]];
}

/// Impulse of a hold over the arc, (lambda, beta) in its tangents.
inline Vec3 impulse_of(const ArcConstraint& c) {
  return {c.lambda, c.tangential[0], c.tangential[1]};
}

/// Of the holds in flight.slip.friction.contact with the impulses in flight.slip.friction.p: writes
/// their rates u at flight.arc.v, and flight.slip.p, the momentum that all forces have been added
/// to.
/// @return how far they are from the arc's equation and from Coulomb's law; of the latter not at
/// first, when W has not been written
Lawlessness set_slip_rates(const ModelData& model, const StepOptions& options, const Node& node,
                           Flight& flight);

/// Writes W and flight.slip.row. One Newton step of flight.arc.v and u goes before.
/// @return false where there is no number
bool set_slip_blocks(const ModelData& model, const Node& node, Flight& flight);

}  // namespace saltus
