// One arc of the discrete motion: solve for its velocity.
//
// Theory, section 3 and O; paper (9), (11a), (11c), (11d), (12). An arc (q, v, tau) starts at q,
// ends at q (+) tau v, and is evaluated at q_mid = q (+) tau v / 2. Unknown is v, so tau = 0 is
// regular:
//
//   p_start = L_v - tau/2 L_q     = p + sum lambda_i n_i           all partials at (q_mid, v)
//   p_end   = L_v + tau/2 L_q     = p_start + tau L_q
//   E_d     = v.L_v - L           = T + V
//
// A force Q(q_mid, v, u) acts as L_q does, on both halves of the arc (F1): L_q below is L_q + Q.
//
// For balls L_v and L_q are the L_v' and L_q' of packed.hpp. A ball may turn by less than 2 pi in
// an arc: the equation has a pole there, and farther than that its residual counts as infinite.
//
// After an impact the arc may have a line more, of one impulse lambda and one equation:
// launch_line.hpp. What contacts push is part of p: solve.hpp. Loops have impulses and equations of
// their own: arc_loops.hpp.
//
// The law `compensated` takes arcs of another Lagrangian, L + c kappa with c = (h^2 - tau^2) / 24
// (theory, section 5). Then L_v, L_q gain c kappa_v, c kappa_q, and since c depends on tau
//
//   E_d     = T + V + c (v.kappa_v - kappa) + tau^2 kappa / 12
//
// Newton's matrix stays that of L: the rest is O(h^2), so that each iteration gains five digits at
// h = 0.01 instead of doubling them.
//
// p_end is taken from the second form, p_start + tau L_q, so that the momentum of a coordinate
// that L does not depend on is conserved to the last bit.
#pragma once

#include <optional>

#include "saltus/collision/contact.hpp"
#include "saltus/force/force_model.hpp"
#include "saltus/lagrangian/shadow.hpp"
#include "saltus/model/model.hpp"
#include "saltus/variational/options.hpp"
#include "variational/arc/arc_loops.hpp"
#include "variational/arc/launch_line.hpp"
#include "variational/arc/point_dampers.hpp"

namespace saltus {

struct ArcProblem {
  const VecX& q;
  const VecX& p;
  double tau;
  LaunchLine* launch = nullptr;  ///< none; not one whose use is none
  double whole = 0;  ///< [s] the step h that the arc is a part of, under `compensated`; else 0
  double t = 0;      ///< [s] when it starts, for forces that are functions of time
  ArcLoops* loops = nullptr;  ///< none where the model has none
};

/// True where the line has an equation of its own.
inline bool is_matched(const LaunchLine* line) {
  return line != nullptr && line->use == LaunchLine::Use::matched;
}

struct Arc {
  double tau = 0;
  VecX v;        ///< guess in, solution out
  VecX q_start;  ///< where it starts
  VecX q_end, p_end;
  double residual = 0;  ///< scaled by the size of the terms it is a difference of
  int iterations = 0;
};

/// What `compensated` adds to L at (q_mid, v): c kappa.
struct Compensation {
  explicit Compensation(const ModelData& model);
  PackedMatrix M;
  FreeMotion free;
  ShadowTerm shadow;
  double c = 0;  ///< [s^2]
};

/// Workspace, and what the last solve left: w at (q_mid, v).
struct ArcScratch {
  ArcScratch(const ModelData& model, ImpactLaw law);
  std::optional<Compensation> compensation;
  std::optional<ArcLoops> loops;  ///< where the model has some
  ForceValues forces;             ///< of the last evaluation; written where has_forces
  VecX wrench_force;              ///< (n_v) the part of them that wrenches on bodies make
  VecX point_pull;                ///< (n_v) likewise dampers between points
  std::vector<PlacedDamper> dampers;
  const ForceInput* input = nullptr;  ///< what drives the step; written by the stepper
  bool has_forces = false;            ///< likewise: the model or the input has some
  VecX shift;                         ///< (n_v) 2 beta - 1 of stiff damping; empty where none is
  Packed w;
  bool has_second = false;  ///< second_pass sums in place: once an evaluation
  PackedMatrix J;
  PackedProducts products;
  Packed w_end;   ///< written by place_end
  VecX q_placed;  ///< (n_q) where w_end is, if it is anywhere
  bool is_placed = false;
  Kinematics kin_end;  ///< of the joints that somebody asked for
  Kinematics kin_mid;  ///< likewise in the arc's middle
  VecX q;              ///< (n_q) scratch: where the arc is evaluated, or ends
  VecX L_v, L_q;       ///< (n_v) of the arc: of balls L_v', L_q'
  VecX r, scale, dv, x;
};

/// Newton's method from arc.v.
/// @return false when it does not converge within so many iterations; `arc` then holds the best
/// residual and the iterations spent.
bool solve_arc(const ModelData& model, const ArcProblem& problem, int max_iterations, Arc& arc,
               ArcScratch& s);

/// Poses at q_end in s.w_end.
void place_end(const ModelData& model, const VecX& q_end, ArcScratch& s);

/// Gap of a pair there. Needs place_end.
Gap pair_gap_at_end(const ModelData& model, const Pair& pair, ArcScratch& s);

/// All poses of the pair's chain in s.kin_end, for add_gap_gradient. Needs place_end.
void place_chain_at_end(const ModelData& model, const Pair& pair, ArcScratch& s);

/// Second partials at the last evaluation, into s.w.
void set_second_partials(const ModelData& model, ArcScratch& s);

/// What solve_arc is made of, for closing_arc.cpp and row_blocks.cpp.
///
/// Writes w, L_v, L_q, scale and the negative residual r of the momentum equation at v; returns its
/// scaled size, infinity where it is not a number.
/// @param keep_scale of the evaluation before, whose v was nearly this one
double momentum_residual(const ModelData& model, const ArcProblem& problem, const VecX& v,
                         ArcScratch& s, bool keep_scale = false);

/// True where a residual is rounding: at the floor, or small and no longer falling.
bool is_converged(double residual, double before);

/// Writes arc.q_start, q_end and p_end from the last evaluation.
void finish_arc(const ModelData& model, const ArcProblem& problem, Arc& arc, const ArcScratch& s);

/// E_d [J] of an arc just solved.
double arc_energy(const ModelData& model, const ArcProblem& problem, const Arc& arc, ArcScratch& s);

/// dv/dtau of an arc, what holds it left aside: v' = -J^-1 dp_start/dtau. Needs the factors of J in
/// s. Result in `rate` (n_v).
void set_arc_rate(const ModelData& model, double tau, ArcScratch& s, VecX& rate);

/// The same, factors and all, for an arc just solved.
void arc_rate(const ModelData& model, const Arc& arc, ArcScratch& s, VecX& rate);

/// The ball that turns farthest in time tau at velocity v, -1 where there is none, and by how much.
struct FastestTurn {
  int ball = -1;     ///< index in tree.balls
  double angle = 0;  ///< [rad]
};
FastestTurn fastest_turn(const Tree& tree, const VecX& v, double tau);

}  // namespace saltus
