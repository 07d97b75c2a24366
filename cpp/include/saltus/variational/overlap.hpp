// Configurations without overlap, near given ones.
#pragma once

#include "saltus/model/model.hpp"

namespace saltus {

/// Moves bodies out of each other as little as the kinetic metric allows: by steps
///
///   min |dq|_M   subject to   phi_i + phi_q,i dq >= 0     for pairs that overlap or are near
///
/// until none overlaps by more than a part of its epsilon_phi. Bodies that are fixed to each other,
/// or deeper in each other than their sizes, may have no way out.
/// @param q (n_q); @return (n_q) `q` itself where nothing overlaps
/// @throws ModelError where q does not fit the model, and where pairs still overlap in the end:
/// names them and their depths.
SALTUS_EXPORT VecX resolve_overlap(const Model& model, const VecRef& q);

}  // namespace saltus
