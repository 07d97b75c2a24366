// Configurations without overlap, near given ones.
#pragma once

#include "saltus/model/model.hpp"

namespace saltus {

/// Separates overlapping bodies with the smallest displacement in the kinetic metric, by steps
///
///   min |dq|_M   subject to   phi_i + phi_q,i dq >= 0     for pairs that overlap or are near
///
/// with joints' limits among them and loops kept closed, until no pair overlaps by more than a
/// fraction of its epsilon_phi. There may be no solution for bodies that are fixed to each other,
/// or that overlap by more than their sizes.
/// @param q (n_q); @return (n_q) `q` itself if nothing overlaps
/// @throws ModelError if q does not fit the model, and if pairs still overlap in the end: it names
/// them and their depths.
SALTUS_EXPORT VecX resolve_overlap(const Model& model, const VecRef& q);

}  // namespace saltus
