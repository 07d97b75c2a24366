// What contacts add to gradients by joints' placements: rows and gaps know where bodies are.
#pragma once

#include "derivatives/held_derivative.hpp"

namespace saltus {

/// Of an arc's held contacts, pulled back to the covector p_hat of its start; of_rates that of g.
void add_held_placements(const ModelData& model, const FlownArc& arc, const VecX& p_hat,
                         const VecX& of_rates, PlacementGradient& to);

/// Of a kick at q, pulled back to p_hat. @param residual that of its rates
void add_kick_placements(const ModelData& model, const VecX& q, const KickDerivative& kick,
                         const VecX& residual, const VecX& p_hat, PlacementGradient& to);

/// Of an impulse. @param p_hat covector of the momenta after it @param of_lambda its own
void add_impulse_placements(const ModelData& model, const NodeDerivative& node,
                            const ImpulseDerivative& impulse, const VecX& p_hat, double of_lambda,
                            PlacementGradient& to);

/// Of a gap that closes, of_gap the covector of its change.
void add_gap_placements(const ModelData& model, const Kinematics& kin, int pair, double of_gap,
                        PlacementGradient& to);

}  // namespace saltus
