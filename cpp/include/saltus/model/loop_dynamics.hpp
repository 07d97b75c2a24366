// Loops in the dynamics of a model at one configuration (theory, F6, F7):
//
//   M a + c = forces + A lambda,     A^T a = needed
//
// c holds gravity and all potentials. The impulses lambda of loops that say the same twice are the
// shortest there are, a is the same whatever they are.
#pragma once

#include "saltus/constraint/equality_solver.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/model/model.hpp"

namespace saltus {

/// Workspace of models that have loops.
struct LoopDynamics {
  /// With room for all of the model's loops.
  explicit LoopDynamics(const ModelData& model);

  Kinematics kin;         ///< at q; written by set_loops
  EqualityValues values;  ///< written by set_loops, likewise:
  VecX needed;            ///< (m) what A^T a is
  EqualitySolver solver;  ///< of M and A; written by factorize_loops
  VecX rates;             ///< (m) scratch
  VecX column;            ///< (n_v) scratch
};

/// Writes values and needed at (q, v, t).
/// @throws ModelError where a loop is open, or opens with v; where a joint moves by a function that
///         does not say the acceleration
void set_loops(const ModelData& model, const VecRef& q, const VecRef& v, double t,
               LoopDynamics& loops);

/// @throws ModelError where accelerations a (n_v) would open a loop. Needs set_loops.
void check_accelerations(const ModelData& model, const VecRef& a, LoopDynamics& loops);

/// Needs set_loops, and in M the factors of the mass matrix with its locks.
/// @throws StepError where the rank of the loops changes
void factorize_loops(const ModelData& model, double t, PackedMatrix& M, LoopDynamics& loops);

/// a <- the accelerations that keep the loops closed, from those without. Needs factorize_loops.
void hold_accelerations(LoopDynamics& loops, VecX& a);

/// forces <- what of them the loops do not take, 0 of joints that move as they are told: they make
/// the same accelerations. Needs factorize_loops and the same M.
void take_out_loops(const ModelData& model, PackedMatrix& M, LoopDynamics& loops, VecX& forces);

}  // namespace saltus
