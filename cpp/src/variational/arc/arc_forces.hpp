// Forces in an arc: what the force layer makes of its middle, added to L_q (theory, F1).
#pragma once

#include "variational/arc/arc.hpp"

namespace saltus {

/// For forces on this model, with no input yet.
void prepare_forces(const ModelData& model, ArcScratch& s);

/// Adds Q at (t, s.q, v) to the L_q of s.w; writes s.forces and the slopes by single coordinates in
/// s.w. Needs first_pass.
void add_forces(const ModelData& model, double t, const VecX& v, ArcScratch& s);

/// What of stiff damping an arc opens with beyond a half of it (stiff_damping.hpp), by velocity.
inline auto shifted_damping(const ModelData& model, const VecX& v, const ArcScratch& s) {
  return -s.shift.cwiseProduct(model.forces.damping).cwiseProduct(v);
}

/// Writes what forces that join coordinates have in Newton's matrix: the columns of dampers and
/// functions in s.w, and generators of dampers and wrenches. Needs second_pass.
void add_force_partials(const ModelData& model, ArcScratch& s);

/// Adds what the pull of wrenches changes with the configuration to the generators of L_qq: that of
/// a force at a point of a body, in the world's axes. Torques and forces in the body's axes are
/// left out of Newton's matrix, which costs an iteration and changes no answer. Needs second_pass.
void add_wrench_partials(const ModelData& model, ArcScratch& s);

}  // namespace saltus
