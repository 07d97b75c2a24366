// Forces in an arc: what the force layer makes of its middle, added to L_q (theory, F1).
#pragma once

#include "variational/arc/arc.hpp"

namespace saltus {

/// For forces on this model, with no input yet.
void prepare_forces(const ModelData& model, ArcScratch& s);

/// Adds Q at (s.q, v) to the L_q of s.w; writes s.forces and the slopes in s.w. Needs first_pass.
void add_forces(const ModelData& model, const VecX& v, ArcScratch& s);

/// Adds Q to the L_q' of balls, which arc_pass makes without L_q, and tau/2 c2 f x Q to their L_v'
/// (packed.hpp). Needs arc_pass.
void add_ball_forces(const ModelData& model, double tau, const VecX& v, ArcScratch& s);

/// Adds what the pull of wrenches changes with the configuration to the generators of L_qq: that of
/// a force at a point of a body, in the world's axes. Torques and forces in the body's axes are
/// left out of Newton's matrix, which costs an iteration and changes no answer. Needs second_pass.
void add_wrench_partials(const ModelData& model, ArcScratch& s);

}  // namespace saltus
