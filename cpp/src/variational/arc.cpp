#include "variational/arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/collision/slip.hpp"

namespace saltus {
namespace {

bool wants_energy(const ArcProblem& a) {
  const auto& c = a.constraints;
  return std::any_of(c.begin(), c.end(), [](const ArcConstraint& each) {
    return each.kind == ArcConstraint::Kind::launch;
  });
}

/// Adds c kappa to L. @return false where M is singular
bool compensate(const ModelData& model, const ArcProblem& a, ArcScratch& s) {
  Compensation& k = *s.compensation;
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, 0, k.M)) return false;
  free_motion(model.tree, model.packed, s.w, k.M, k.free);
  shadow_gradient(model.tree, model.packed, s.w, k.free.a, k.shadow);
  k.c = (a.whole * a.whole - a.tau * a.tau) / 24;
  s.L_v += k.c * k.shadow.kappa_v;
  s.L_q += k.c * k.shadow.kappa_q;
  s.scale += k.c * (k.shadow.kappa_v + a.tau / 2 * k.shadow.kappa_q).cwiseAbs();
  return true;
}

/// Writes w, L_v, L_q and scale at v: all that the residual is made of.
void evaluate(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const Tree& tree = model.tree;
  const PackedTree& packed = model.packed;
  s.x = a.q + a.tau / 2 * v;
  set_coordinates(tree, packed, s.x, s.w);
  set_rates(tree, packed, v, s.w);
  place(packed, s.w);
  move(packed, s.w);
  first_pass(packed, s.w);
  s.has_second = false;
  scale_pass(packed, a.tau, s.w);
  gather(tree, packed, s.w.first, 0, s.L_v);
  gather(tree, packed, s.w.first, 1, s.L_q);
  if (packed.one_to_one) {
    gather(tree, packed, s.w.scale, 0, s.scale);
    return;
  }
  s.scale.setZero();
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    s.scale[drive.coordinate] += std::abs(drive.multiplier) * *at(s.w.scale, packed.slot[i]);
  }
}

}  // namespace

// The residual is a difference of rounded sums, and `scale` is the size of their terms, per
// coordinate, so that `converged` means the same for a spinning grain as for a sliding block.
double momentum_residual(const ModelData& model, const ArcProblem& a, const VecX& v,
                         ArcScratch& s) {
  evaluate(model, a, v, s);
  if (a.whole > 0 && (a.tau < a.whole || wants_energy(a)) && !compensate(model, a, s)) {
    return std::numeric_limits<double>::infinity();
  }
  s.r = a.p + a.tau / 2 * s.L_q - s.L_v;
  for (const ArcConstraint& c : a.constraints) {
    s.r += c.lambda * c.n;
    s.scale +=
        std::abs(c.lambda) * c.n.cwiseAbs();  // four legs' torques cancel, not their rounding
  }
  if (!s.r.allFinite()) return std::numeric_limits<double>::infinity();
  if (s.r.size() == 0) return 0;
  // where a coordinate feels no force at all, 0 / tiny is 0
  constexpr double tiny = std::numeric_limits<double>::min();
  return (s.r.array().abs() / (s.scale.array() + a.p.array().abs() + tiny)).maxCoeff();
}

namespace {

double discrete_energy(const ModelData& model, const ArcProblem& a, const VecX& v,
                       const ArcScratch& s) {
  const double energy = 0.5 * v.dot(s.L_v) + potential_energy(model.packed, s.w);
  if (!(a.whole > 0)) return energy;
  const Compensation& k = *s.compensation;  // half of its v.kappa_v is in v.L_v / 2 already
  return energy + k.c * (0.5 * v.dot(k.shadow.kappa_v) - k.shadow.kappa) +
         a.tau * a.tau * k.shadow.kappa / 12;
}

/// The rate at which a sticking pair slides; its gradient, but for the turning of t, in c.row.
double slide_rate(const ModelData& model, const VecX& v, ArcConstraint& c, ArcScratch& s) {
  c.row.setZero();
  const Gap g = pair_gap_at_mid(model, c.watched(), s);
  const Tangents t = tangents(g.n_W, c.axis);
  add_motion_gradient(model.tree, s.kin_end, c.watched(), contact_point(g),
                      c.tangent == 0 ? t.t0 : t.t1, c.row);
  return c.row.dot(v);
}

/// c and dc/dv of one constraint; c is scaled by tau (hold), so that it stays regular at tau = 0.
double constraint(const ModelData& model, const ArcProblem& a, const VecX& v, ArcConstraint& c,
                  ArcScratch& s) {
  if (c.kind == ArcConstraint::Kind::stick) return slide_rate(model, v, c, s);
  c.row.setZero();
  if (c.kind == ArcConstraint::Kind::hold) {
    const Gap g = pair_gap_at_end(model, c.watched(), s);
    add_gap_gradient(model.tree, s.kin_end, c.watched(), g, c.row);
    return (g.phi - c.target) / a.tau;
  }
  // dE_d/dv = L_vv v + tau/2 (L_vq^T v - L_q); w has v as its rates, and L_vv v = L_v
  multiply_by_rates(model.packed, s.w, s.products);
  gather(model.tree, model.packed, s.products.by_joint, 1, s.L_qv_v);
  c.row = s.L_v + a.tau / 2 * (s.L_qv_v - s.L_q);
  if (a.whole > 0) {  // of what c kappa adds, the part without second partials of kappa
    const ShadowTerm& shadow = s.compensation->shadow;
    c.row += a.tau * a.tau / 12 * (shadow.kappa_v + a.tau / 2 * shadow.kappa_q);
  }
  return discrete_energy(model, a, v, s) - c.target;
}

// J dv - N dlambda = r, C dv = -c, by the Schur complement C J^-1 N.
void add_constraints(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const int m = static_cast<int>(a.constraints.size());
  if (m == 0) return;
  s.x = a.q + a.tau * v;
  place_end(model, s.x, s);
  SmallMat S(m, m);
  SmallVec rhs(m);
  for (int i = 0; i < m; ++i) {
    ArcConstraint& c = a.constraints[i];
    rhs[i] = -constraint(model, a, v, c, s) - c.row.dot(s.dv);
    c.column = c.n;
    solve(model.tree, model.packed, s.J, c.column);
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
  place_end(model, s.x, s);
  for (ArcConstraint& c : a.constraints) {
    if (c.kind == ArcConstraint::Kind::stick) {
      // a hundredth of what closes a gap: what slides does not come back
      const double way = a.tau * slide_rate(model, v, c, s);
      size = std::max(size, std::abs(way) / c.pair->touch * 1e-10);
    } else if (c.kind == ArcConstraint::Kind::hold) {
      const double phi = pair_gap_at_end(model, c.watched(), s).phi;
      // 1e-12: a hundredth of pair.touch is closed
      size = std::max(size, std::abs(phi - c.target) / c.pair->touch * 1e-12);
    } else {
      const double energy = discrete_energy(model, a, v, s);
      size = std::max(size,
                      std::abs(energy - c.target) / (std::abs(c.target) + std::abs(v.dot(s.L_v))));
    }
  }
  return size;
}

double residual(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  const double size = momentum_residual(model, a, v, s);
  return std::max(size, constraint_residual(model, a, v, s));
}

/// One Newton step from arc.v with backtracking; returns the new residual, infinity where J is
/// singular. The lambdas of the constraints move with v.
double newton_step(const ModelData& model, const ArcProblem& a, double before, Arc& arc,
                   ArcScratch& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, a.tau, s.J)) return infinity;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
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

Compensation::Compensation(const ModelData& model)
    : M(model.tree, model.packed),
      free(model.tree, model.packed),
      shadow(model.tree, model.packed) {}

ArcScratch::ArcScratch(const ModelData& model, ImpactLaw law)
    : w(model.packed),
      J(model.tree, model.packed),
      products(model.packed),
      w_end(model.packed),
      kin_end(model.tree) {
  if (law == ImpactLaw::compensated) compensation.emplace(model);
  const int n = model.tree.coordinates;
  for (VecX* each : {&x, &L_v, &L_q, &r, &scale, &dv, &L_qv_v, &L_vq_v, &L_qq_v}) {
    each->setZero(n);
  }
}

void place_end(const ModelData& model, const VecX& q_end, ArcScratch& s) {
  set_coordinates(model.tree, model.packed, q_end, s.w_end);
  place(model.packed, s.w_end);
}

namespace {

/// Poses of the pair's joints from `w`, and the gap there.
Gap gap_in(const ModelData& model, const Pair& pair, const Packed& w, Kinematics& kin) {
  for (const ChainJoint& k : pair.chain) copy_pose(model.tree, model.packed, w, k.joint, kin);
  for (const Placed* part : {&pair.on_a, &pair.on_b}) {  // one may hang where the chain turns
    const int joint = part->joint;
    if (joint >= 0) copy_pose(model.tree, model.packed, w, joint, kin);
  }
  return pair_gap(model.tree, kin, pair);
}

}  // namespace

Gap pair_gap_at_end(const ModelData& model, const Pair& pair, ArcScratch& s) {
  return gap_in(model, pair, s.w_end, s.kin_end);
}

Gap pair_gap_at_mid(const ModelData& model, const Pair& pair, ArcScratch& s) {
  return gap_in(model, pair, s.w, s.kin_end);
}

bool is_converged(double residual, double before) {
  // 32 eps: sums of a few terms each round by eps; what is left at convergence is about 2 eps
  constexpr double floor = 32 * std::numeric_limits<double>::epsilon();
  // above this a stalled iteration is a failure, below it rounding (long chains sum many terms)
  constexpr double rounding = 1e-11;
  return residual <= floor || (residual <= rounding && residual > before / 4);
}

bool solve_arc(const ModelData& model, const ArcProblem& a, const StepOptions& options, Arc& arc,
               ArcScratch& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  arc.tau = a.tau;
  arc.iterations = 0;
  arc.residual = residual(model, a, arc.v, s);
  bool converged = is_converged(arc.residual, infinity);
  while (!converged && arc.iterations < options.max_iterations) {
    const double before = arc.residual;
    arc.residual = newton_step(model, a, before, arc, s);
    ++arc.iterations;
    if (!std::isfinite(arc.residual)) return false;
    converged = is_converged(arc.residual, before);
  }
  finish_arc(a, arc, s);
  return converged;
}

void finish_arc(const ArcProblem& a, Arc& arc, const ArcScratch& s) {
  arc.q_end = a.q + a.tau * arc.v;
  arc.p_end = a.p + a.tau * s.L_q;
  for (const ArcConstraint& c : a.constraints) arc.p_end += c.lambda * c.n;
}

double arc_energy(const ModelData& model, const ArcProblem& a, const Arc& arc, ArcScratch& s) {
  evaluate(model, a, arc.v, s);
  if (a.whole > 0) compensate(model, a, s);
  return discrete_energy(model, a, arc.v, s);
}

void set_arc_rate(const ModelData& model, double tau, ArcScratch& s, VecX& rate) {
  multiply_by_rates(model.packed, s.w, s.products);
  gather(model.tree, model.packed, s.products.by_joint, 0, s.L_vq_v);
  gather(model.tree, model.packed, s.products.by_joint, 2, s.L_qq_v);
  rate = -(s.L_vq_v - s.L_q) / 2 + tau / 4 * s.L_qq_v;
  solve(model.tree, model.packed, s.J, rate);
}

void arc_rate(const ModelData& model, const Arc& arc, ArcScratch& s, VecX& rate) {
  rate.setZero();
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, arc.tau, s.J)) return;
  set_arc_rate(model, arc.tau, s, rate);
}

}  // namespace saltus
