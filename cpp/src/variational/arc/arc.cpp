#include "variational/arc/arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "variational/arc/arc_forces.hpp"

namespace saltus {
namespace {

/// Adds c kappa to L. @return false where M is singular
bool compensate(const ModelData& model, const ArcProblem& a, ArcScratch& s, bool keep_scale) {
  Compensation& k = *s.compensation;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, 0, k.M)) return false;
  free_motion(model.tree, model.packed, s.w, k.M, k.free);
  shadow_gradient(model.tree, model.packed, s.w, k.free.a, k.shadow);
  k.c = (a.whole * a.whole - a.tau * a.tau) / 24;
  s.L_v += k.c * k.shadow.kappa_v;
  s.L_q += k.c * k.shadow.kappa_q;
  if (keep_scale) return true;
  s.scale += k.c * (k.shadow.kappa_v + a.tau / 2 * k.shadow.kappa_q).cwiseAbs();
  return true;
}

/// The size of the terms of p_start, by velocity. Needs first_pass.
void set_scale(const ModelData& model, double tau, ArcScratch& s) {
  const Tree& tree = model.tree;
  const PackedTree& packed = model.packed;
  scale_pass(packed, tau, s.w);
  if (packed.one_to_one) {
    gather(tree, packed, s.w.scale, 0, s.scale);
  } else {
    s.scale.setZero();
    for (int i = 0; i < tree.joints(); ++i) {
      const Drive& drive = tree.drive[i];
      s.scale[drive.velocity] += std::abs(drive.multiplier) * *at(s.w.scale, packed.slot[i]);
    }
  }
  if (s.has_forces) s.scale += tau / 2 * s.forces.size;
}

/// Writes w, L_v and L_q at v: all that the residual is made of.
void evaluate(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const Tree& tree = model.tree;
  const PackedTree& packed = model.packed;
  integrate(tree, a.q, a.tau / 2, v, s.q);
  set_coordinates(tree, packed, s.q, s.w);
  set_rates(tree, packed, v, s.w);
  place(packed, s.w);
  move(packed, s.w);
  if (packed.potentials != nullptr) check_springs(packed, s.w, a.t + a.tau / 2);
  first_pass(packed, s.w);
  if (s.has_forces) add_forces(model, a.t + a.tau / 2, v, s);
  s.has_second = false;
  arc_pass(packed, a.tau, s.w);
  if (s.has_forces) add_ball_pull(packed, a.tau, s.forces.Q, s.w);
  gather(tree, packed, s.w.arc, 0, s.L_v);
  gather(tree, packed, s.w.arc, 1, s.L_q);
}

}  // namespace

// The residual is a difference of rounded sums, and `scale` is the size of their terms, per
// coordinate, so that `converged` means the same for a spinning grain as for a sliding block.
double momentum_residual(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s,
                         bool keep_scale) {
  if (!(fastest_turn(model.tree, v, a.tau).angle < 2 * std::numbers::pi)) {
    return std::numeric_limits<double>::infinity();
  }
  evaluate(model, a, v, s);
  if (!keep_scale) set_scale(model, a.tau, s);
  const bool compensated = a.whole > 0 && (a.tau < a.whole || is_matched(a.launch));
  if (compensated && !compensate(model, a, s, keep_scale)) {
    return std::numeric_limits<double>::infinity();
  }
  s.r = a.p + a.tau / 2 * s.L_q - s.L_v;
  if (s.shift.size() > 0) s.r += a.tau / 2 * shifted_damping(model, v, s);
  if (a.launch != nullptr) {
    s.r += a.launch->lambda * a.launch->n;
    s.scale += std::abs(a.launch->lambda) * a.launch->n.cwiseAbs();
  }
  if (a.loops != nullptr) add_push(a, s, keep_scale);
  if (!s.r.allFinite()) return std::numeric_limits<double>::infinity();
  if (s.r.size() == 0) return 0;
  // where a coordinate feels no force at all, 0 / tiny is 0
  constexpr double tiny = std::numeric_limits<double>::min();
  return (s.r.array().abs() / (s.scale.array() + a.p.array().abs() + tiny)).maxCoeff();
}

double discrete_energy(const ModelData& model, const ArcProblem& a, const VecX& v,
                       const ArcScratch& s) {
  const double energy = 0.5 * v.dot(s.L_v) + potential_energy(model.packed, s.w);
  if (!(a.whole > 0)) return energy;
  const Compensation& k = *s.compensation;  // half of its v.kappa_v is in v.L_v / 2 already
  return energy + k.c * (0.5 * v.dot(k.shadow.kappa_v) - k.shadow.kappa) +
         a.tau * a.tau * k.shadow.kappa / 12;
}

namespace {

double residual(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s,
                bool keep_scale = false) {
  const double size = momentum_residual(model, a, v, s, keep_scale);
  if (a.loops != nullptr && std::isfinite(size)) {
    return std::max(size, loop_residual(model, a, v, s));
  }
  return is_matched(a.launch) ? std::max(size, line_residual(model, a, v, s)) : size;
}

/// One Newton step from arc.v with backtracking; returns the new residual, infinity where J is
/// singular. The launch's lambda moves with v.
double newton_step(const ModelData& model, const ArcProblem& a, double before, Arc& arc,
                   ArcScratch& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, a.tau, s.J)) return infinity;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
  if (is_matched(a.launch)) take_out_line(model, a, arc.v, s);
  if (a.loops != nullptr && !take_out_loops(model, a, s)) return infinity;
  if (!s.dv.allFinite()) return infinity;
  arc.v += s.dv;
  // v has changed by a part of `before`, and so have the terms: a scale is known well enough.
  // The launch's impulse may have come from nothing.
  constexpr double little = 1e-3;
  const bool keep_scale = before < little && !is_matched(a.launch);
  double after = residual(model, a, arc.v, s, keep_scale);
  // Newton's own direction shortens until the residual falls; 2^-12 of a step is no direction
  for (int k = 0; k < 12 && !(after < before) && before > 1e-10; ++k) {
    halve_step(s);
    arc.v -= s.dv;
    after = residual(model, a, arc.v, s);
  }
  return after;
}

}  // namespace

Compensation::Compensation(const ModelData& model)
    : M(model.tree, model.packed),
      free(model.tree, model.packed),
      shadow(model.tree, model.packed) {}

ArcScratch::ArcScratch(const ModelData& model, ImpactLaw law)
    : w(model.packed),
      J(model.tree, model.packed),
      products(model.packed),
      w_end(model.packed),
      kin_end(model.tree),
      kin_mid(model.tree) {
  if (law == ImpactLaw::compensated) compensation.emplace(model);
  if (model.equalities.rows > 0) loops.emplace(model);
  J.lock = locks_of(model.tree, model.equalities);
  for (VecX* each : {&q, &q_placed}) each->setZero(model.tree.n_q);
  for (VecX* each : {&L_v, &L_q, &r, &scale, &dv, &x}) each->setZero(model.tree.n_v);
  prepare_forces(model, *this);
}

void set_second_partials(const ModelData& model, ArcScratch& s) {
  if (s.has_second) return;
  second_pass(model.packed, s.w);
  if (s.has_forces) add_force_partials(model, s);
  s.has_second = true;
}

void place_end(const ModelData& model, const VecX& q_end, ArcScratch& s) {
  if (s.is_placed && s.q_placed == q_end) return;
  s.q_placed = q_end;
  s.is_placed = true;
  set_coordinates(model.tree, model.packed, q_end, s.w_end);
  place(model.packed, s.w_end);
}

Gap pair_gap_at_end(const ModelData& model, const Pair& pair, ArcScratch& s) {
  for (const int joint : {pair.on_a.joint, pair.on_b.joint}) {
    if (joint >= 0) copy_pose(model.tree, model.packed, s.w_end, joint, s.kin_end);
  }
  return pair_gap(model.tree, s.kin_end, pair);
}

void place_chain_at_end(const ModelData& model, const Pair& pair, ArcScratch& s) {
  for (const ChainJoint& k : pair.chain) {
    copy_pose(model.tree, model.packed, s.w_end, k.joint, s.kin_end);
  }
}

bool is_converged(double residual, double before) {
  // 8 eps: sums of a few terms each round by eps; what is left at convergence is about 2 eps
  constexpr double floor = 8 * std::numeric_limits<double>::epsilon();
  // above this a stalled iteration is a failure, below it rounding (long chains sum many terms)
  constexpr double rounding = 1e-11;
  return residual <= floor || (residual <= rounding && residual > before / 4);
}

bool solve_arc(const ModelData& model, const ArcProblem& a, int max_iterations, Arc& arc,
               ArcScratch& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  arc.tau = a.tau;
  arc.iterations = 0;
  arc.residual = residual(model, a, arc.v, s);
  if (!std::isfinite(arc.residual)) return false;
  bool converged = is_converged(arc.residual, infinity);
  while (!converged && arc.iterations < max_iterations) {
    const double before = arc.residual;
    arc.residual = newton_step(model, a, before, arc, s);
    ++arc.iterations;
    if (!std::isfinite(arc.residual)) return false;
    converged = is_converged(arc.residual, before);
  }
  finish_arc(model, a, arc, s);
  return converged;
}

void finish_arc(const ModelData& model, const ArcProblem& a, Arc& arc, const ArcScratch& s) {
  arc.q_start = a.q;
  integrate(model.tree, a.q, a.tau, arc.v, arc.q_end);
  arc.p_end = a.p + a.tau * s.L_q;
  if (a.launch != nullptr) arc.p_end += a.launch->lambda * a.launch->n;
  if (a.loops != nullptr) arc.p_end += a.loops->push;
}

double arc_energy(const ModelData& model, const ArcProblem& a, const Arc& arc, ArcScratch& s) {
  evaluate(model, a, arc.v, s);
  if (a.whole > 0) compensate(model, a, s, true);
  return discrete_energy(model, a, arc.v, s);
}

void set_arc_rate(const ModelData& model, double tau, ArcScratch& s, VecX& rate) {
  set_momentum_rate(model.tree, model.packed, s.w, tau, s.products, s.x, rate);
  solve_scaled(model.tree, model.packed, s.J, rate);
}

void arc_rate(const ModelData& model, const Arc& arc, ArcScratch& s, VecX& rate) {
  rate.setZero();
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, arc.tau, s.J)) return;
  set_arc_rate(model, arc.tau, s, rate);
  if (s.loops) hold_rate(model, arc, s, rate);
}

FastestTurn fastest_turn(const Tree& tree, const VecX& v, double tau) {
  FastestTurn out;
  for (std::size_t i = 0; i < tree.balls.size(); ++i) {
    const double angle = tau * v.segment<3>(tree.balls[i].velocity).norm();
    if (!(angle <= out.angle)) out = {static_cast<int>(i), angle};  // also where it is no number
  }
  return out;
}

}  // namespace saltus
