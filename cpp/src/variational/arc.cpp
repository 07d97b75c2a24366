#include "variational/arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {
namespace {

/// What a body adds to the size of the terms that its subtree's H and g are sums of. Products of
/// norms, so that what cancels inside a cross product counts too. Needs first_pass, no more.
ArcScratch::TermSize body_terms(const Vec3& gravity, const JointMotion& m, const Inertia& I) {
  if (I.mass == 0) return {0, 0, 0, 0};
  const double w = angular(m.V).norm(), v = linear(m.V).norm(), h = I.h.norm();
  const double g = gravity.norm();
  return {I.I.trace() * w + h * v, I.mass * v + h * w, h * g, I.mass * g};
}

// The residual is a difference of rounded sums; this is the size of their terms, per coordinate,
// so that `converged` means the same for a spinning grain as for a sliding block.
void set_scale(const ModelData& model, double tau, ArcScratch& s) {
  const Tree& tree = model.tree;
  for (int i = 0; i < tree.joints(); ++i) {
    s.terms[i] = body_terms(model.mass.gravity, s.kin.joint[i], s.comp.joint[i].Ic);
  }
  s.scale.setZero();
  for (int i = tree.joints() - 1; i >= 0; --i) {
    const JointMotion& m = s.kin.joint[i];
    const ArcScratch::TermSize& t = s.terms[i];
    const double S_w = angular(m.S).norm(), S_v = linear(m.S).norm();
    const double W_w = angular(m.W).norm(), W_v = linear(m.W).norm();
    const double size = S_w * t.H_w + S_v * t.H_v +
                        tau / 2 * (W_w * t.H_w + W_v * t.H_v + S_w * t.g_w + S_v * t.g_v);
    s.scale[tree.drive[i].coordinate] += std::abs(tree.drive[i].multiplier) * size;
    if (tree.parent[i] >= 0) s.terms[tree.parent[i]] += t;
  }
}

/// Writes kin, comp, L_v, L_q, scale at v and the negative residual r; returns its scaled size.
double evaluate(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  s.x = a.q + a.tau / 2 * v;
  set_configuration(model.tree, s.x, s.kin);
  set_velocity(model.tree, v, s.kin);
  first_pass(model.tree, model.mass, s.kin, s.comp);
  to_coordinates(model.tree, s.comp.L_v, s.L_v);
  to_coordinates(model.tree, s.comp.L_q, s.L_q);
  set_scale(model, a.tau, s);
  s.r = a.p + a.tau / 2 * s.L_q - s.L_v;
  for (const ArcConstraint& c : a.constraints) s.r += c.lambda * c.n;
  double size = 0;
  for (int i = 0; i < s.r.size(); ++i) {
    const double scale = s.scale[i] + std::abs(a.p[i]);
    if (!std::isfinite(s.r[i])) return std::numeric_limits<double>::infinity();
    if (s.r[i] != 0) size = std::max(size, std::abs(s.r[i]) / scale);
  }
  return size;
}

double discrete_energy(const ModelData& model, const VecX& v, const ArcScratch& s) {
  return 0.5 * v.dot(s.L_v) + potential_energy(model.tree, model.mass, s.kin);
}

/// c and dc/dv of one constraint; c is scaled by tau (hold), so that it stays regular at tau = 0.
double constraint(const ModelData& model, const ArcProblem& a, const VecX& v, ArcConstraint& c,
                  ArcScratch& s) {
  c.row.setZero();
  if (c.kind == ArcConstraint::Kind::hold) {
    const Pair& pair = model.pairs[c.pair];
    const Gap g = pair_gap(model.tree, s.kin_end, model.shapes, pair);
    add_gap_gradient(model.tree, s.kin_end, pair, g, c.row);
    return (g.phi - c.target) / a.tau;
  }
  to_joints(model.tree, v, s.v_joint);
  multiply_second_partials(model.tree, s.kin, s.comp, s.v_joint, s.times);
  s.times.L_vv_x += a.tau / 2 * (s.times.L_qv_x - s.comp.L_q);
  to_coordinates(model.tree, s.times.L_vv_x, c.row);
  return discrete_energy(model, v, s) - c.target;
}

// J dv - N dlambda = r, C dv = -c, by the Schur complement C J^-1 N.
void add_constraints(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const int m = static_cast<int>(a.constraints.size());
  if (m == 0) return;
  s.x = a.q + a.tau * v;
  set_configuration(model.tree, s.x, s.kin_end);
  SmallMat S(m, m);
  SmallVec rhs(m);
  for (int i = 0; i < m; ++i) {
    ArcConstraint& c = a.constraints[i];
    rhs[i] = -constraint(model, a, v, c, s) - c.row.dot(s.dv);
    c.column = c.n;
    solve(model.tree, s.J, c.column);
  }
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) S(i, j) = a.constraints[i].row.dot(a.constraints[j].column);
  }
  const SmallVec dlambda = solve_small(S, rhs);
  for (int i = 0; i < m; ++i) {
    a.constraints[i].lambda += dlambda[i];
    s.dv += dlambda[i] * a.constraints[i].column;
  }
}

/// How far the constraints are from closed, scaled like the momentum residual.
double constraint_residual(const ModelData& model, const ArcProblem& a, const VecX& v,
                           ArcScratch& s) {
  double size = 0;
  if (a.constraints.empty()) return size;
  s.x = a.q + a.tau * v;
  set_configuration(model.tree, s.x, s.kin_end);
  for (const ArcConstraint& c : a.constraints) {
    if (c.kind == ArcConstraint::Kind::hold) {
      const Pair& pair = model.pairs[c.pair];
      const double phi = pair_gap(model.tree, s.kin_end, model.shapes, pair).phi;
      // 1e-12: a hundredth of pair.touch is closed
      size = std::max(size, std::abs(phi - c.target) / pair.touch * 1e-12);
    } else {
      const double energy = discrete_energy(model, v, s);
      size = std::max(size,
                      std::abs(energy - c.target) / (std::abs(c.target) + std::abs(v.dot(s.L_v))));
    }
  }
  return size;
}

double residual(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const double size = evaluate(model, a, v, s);
  return std::max(size, constraint_residual(model, a, v, s));
}

/// One Newton step from arc.v with backtracking; returns the new residual, infinity where J is
/// singular. The lambdas of the constraints move with v.
double newton_step(const ModelData& model, const ArcProblem& a, double before, Arc& arc,
                   ArcScratch& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  second_pass(model.tree, model.mass, s.kin, s.comp);
  if (!factorize(model.tree, s.kin, s.comp, a.tau, s.J)) return infinity;
  s.dv = s.r;
  solve(model.tree, s.J, s.dv);
  add_constraints(model, a, arc.v, s);
  if (!s.dv.allFinite()) return infinity;
  arc.v += s.dv;
  double after = residual(model, a, arc.v, s);
  // Newton's own direction shortens until the residual falls; 2^-12 of a step is no direction
  for (int k = 0; k < 12 && !(after < before) && before > 1e-10; ++k) {
    s.dv /= 2;
    arc.v -= s.dv;
    after = residual(model, a, arc.v, s);
  }
  return after;
}

}  // namespace

ArcScratch::ArcScratch(const ModelData& model)
    : kin(model.tree), kin_end(model.tree), comp(model.tree), J(model.tree) {
  const int n = model.tree.coordinates, joints = model.tree.joints();
  for (VecX* each : {&x, &L_v, &L_q, &r, &scale, &dv}) each->setZero(n);
  v_joint.setZero(joints);
  terms.resize(model.tree.parent.size());
}

bool solve_arc(const ModelData& model, const ArcProblem& a, const StepOptions& options, Arc& arc,
               ArcScratch& s) {
  // 32 eps: sums of a few terms each round by eps; what is left at convergence is about 2 eps
  constexpr double floor = 32 * std::numeric_limits<double>::epsilon();
  // above this a stalled iteration is a failure, below it rounding (long chains sum many terms)
  constexpr double rounding = 1e-11;
  arc.tau = a.tau;
  arc.iterations = 0;
  arc.residual = residual(model, a, arc.v, s);
  bool converged = arc.residual <= floor;
  while (!converged && arc.iterations < options.max_iterations) {
    const double before = arc.residual;
    arc.residual = newton_step(model, a, before, arc, s);
    ++arc.iterations;
    if (!std::isfinite(arc.residual)) return false;
    converged = arc.residual <= floor || (arc.residual <= rounding && arc.residual > before / 4);
  }
  arc.q_end = a.q + a.tau * arc.v;
  arc.p_end = a.p + a.tau * s.L_q;
  for (const ArcConstraint& c : a.constraints) arc.p_end += c.lambda * c.n;
  arc.energy = discrete_energy(model, arc.v, s);
  return converged;
}

void arc_rate(const ModelData& model, const Arc& arc, ArcScratch& s, VecX& rate) {
  second_pass(model.tree, model.mass, s.kin, s.comp);
  rate.setZero();
  if (!factorize(model.tree, s.kin, s.comp, arc.tau, s.J)) return;
  to_joints(model.tree, arc.v, s.v_joint);
  multiply_second_partials(model.tree, s.kin, s.comp, s.v_joint, s.times);
  s.times.L_vq_x = -(s.times.L_vq_x - s.comp.L_q) / 2 + arc.tau / 4 * s.times.L_qq_x;
  to_coordinates(model.tree, s.times.L_vq_x, rate);
  solve(model.tree, s.J, rate);
}

}  // namespace saltus
