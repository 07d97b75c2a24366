#include "derivatives/arc_derivative.hpp"

#include <cmath>

#include "derivatives/applied_derivative.hpp"
#include "saltus/force/control_slopes.hpp"
#include "variational/arc/arc_forces.hpp"

namespace saltus {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& why = "") {
  throw ModelError("the step has no derivative yet: it has " + what + (why.empty() ? "" : "; ") +
                   why);
}

/// Forces whose slopes nobody tells.
void check_forces(const ModelData& model, const ArcScratch& s) {
  for (std::size_t k = 0; k < s.forces.answers.size(); ++k) {
    if (s.forces.answers[k].Q_q.size() > 0 && s.forces.answers[k].Q_v.size() > 0) continue;
    const std::string& name = model.forces.functions[k].name;
    throw ModelError(
        "the step has no derivative: force \"" + name + "\" does not tell Q_q and Q_v, its own",
        "force", name);
  }
}

void check_shift(const ModelData& model, const VecX& shift) {
  for (const Ball& ball : model.tree.balls) {
    if (shift.size() == 0 || shift.segment<3>(ball.velocity).isZero(0)) continue;
    refuse("stiff damping of a ball");
  }
}

void set_turns(const ModelData& model, ArcDerivative& out) {
  const Packed& w = out.s.w;
  for (std::size_t b = 0; b < out.turns.size(); ++b) {
    const PackedBall& ball = model.packed.balls[b];
    TurnDerivative& to = out.turns[b];
    to.velocity = ball.velocity;
    to.rate = out.v.segment<3>(ball.velocity);
    for (int k = 0; k < 3; ++k) to.L_v[k] = at(w.first, ball.slot[k])[0];
    const Vec3 f = out.tau * to.rate;
    to.half = quaternion_exp(f / 2).toRotationMatrix();
    to.whole = quaternion_exp(f).toRotationMatrix();
    to.K = left_jacobian(f);
    to.C = left_jacobian(f / 2);
  }
}

/// x <- A x on balls.
template <Mat3 TurnDerivative::* A>
void turn(const ArcDerivative& arc, VecX& x) {
  for (const TurnDerivative& t : arc.turns) {
    x.segment<3>(t.velocity) = (t.*A * x.segment<3>(t.velocity)).eval();
  }
}
template <Mat3 TurnDerivative::* A>
void turn_back(const ArcDerivative& arc, VecX& x) {
  for (const TurnDerivative& t : arc.turns) {
    x.segment<3>(t.velocity) = ((t.*A).transpose() * x.segment<3>(t.velocity)).eval();
  }
}

/// Stiff damping opens an arc with more than half of its push: Newton's matrix knows, f does not.
void take_shift_out(const ModelData& model, ArcDerivative& out) {
  ArcScratch& s = out.s;
  for (Eigen::Index c = 0; c < s.shift.size(); ++c) {
    const double more = s.shift[c] * model.forces.damping[c];
    at(s.w.slope, model.packed.slot_of_velocity[static_cast<std::size_t>(c)])[lanes] += more;
  }
  if (s.shift.size() > 0) out.R += shifted_damping(model, out.v, s) / 2;
}

/// dE_d = (L_vq^T v - L_q).dq_m + L_v.dv. Needs the products with v.
void set_energy(const ModelData& model, const Tape& tape, ArcDerivative& out) {
  if (tape.law != ImpactLaw::discrete_energy) {
    out.energy_q.resize(0);
    return;
  }
  for (VecX* each : {&out.energy_q, &out.energy_v}) each->resize(model.tree.n_v);
  gather(model.tree, model.packed, out.s.products.by_joint, 1, out.energy_q);
  gather(model.tree, model.packed, out.s.w.first, 1, out.s.x);
  out.energy_q -= out.s.x;
  gather(model.tree, model.packed, out.s.w.first, 0, out.energy_v);
}

/// Of w.coupled, those that prepare_forces made.
Eigen::Index own_columns(const ModelData& model, const ArcScratch& s) {
  if (!model.forces.acts()) return model.packed.columns;
  return model.packed.columns + s.forces.coupled.cols() + model.forces.n_columns();
}

/// @param keeps_factors of an evaluation before at the same q and tau = 0, whatever its v
void evaluate(const ModelData& model, const Tape& tape, double t, const VecX& q, const VecX& p,
              bool keeps_factors, ArcDerivative& out) {
  ArcScratch& s = out.s;
  s.input = &tape.input;
  s.has_forces = model.forces.acts() || tape.input.acts();
  const ArcProblem problem{q, p, out.tau, nullptr, 0, t, nullptr};
  const double residual = momentum_residual(model, problem, out.v, s);
  set_second_partials(model, s);
  add_wrench_slopes(model, tape.input.wrenches, own_columns(model, s), s.w);
  take_generators(model.tree, model.packed, s.w, out.product);
  const bool is_regular = keeps_factors || factorize(model.tree, model.packed, s.w, out.tau, s.J);
  if (!std::isfinite(residual) || !is_regular) {
    throw StepError("the arc at t = " + std::to_string(t) + " s has no derivative: it is singular",
                    t, residual, 0);
  }
  if (s.has_forces) check_forces(model, s);
  out.force = s.L_q;
}

/// What an arc needs beyond its evaluation.
void set_slopes(const ModelData& model, const Tape& tape, ArcDerivative& out) {
  ArcScratch& s = out.s;
  set_turns(model, out);
  set_momentum_rate(model.tree, model.packed, s.w, out.tau, s.products, s.x, out.R);
  take_shift_out(model, out);
  set_energy(model, tape, out);
  if (s.has_forces) set_control_slopes(model.forces, tape.input, s.forces, out.Q_u);
}

}  // namespace

ArcDerivative::ArcDerivative(const ModelData& model)
    : turns(model.tree.balls.size()), s(model, ImpactLaw::nodal_energy), product(model.tree) {
  for (VecX* each : {&v, &force, &R, &x, &x_m, &dv, &y, &of_L_v, &hat_m, &hat_v})
    each->setZero(model.tree.n_v);
  Q_u.setZero(model.tree.n_v, model.forces.n_u());
}

void set_arc_derivative(const ModelData& model, const Tape& tape, const TapeArc& arc,
                        ArcDerivative& out) {
  check_shift(model, arc.shift);
  out.tau = arc.tau;
  out.v = arc.v;
  out.s.shift = arc.shift;
  evaluate(model, tape, arc.t, arc.q, arc.p, false, out);
  set_slopes(model, tape, out);
}

void set_node_derivative(const ModelData& model, const Tape& tape, double t, const VecX& q,
                         const VecX& v, ArcDerivative& out, bool is_same_place) {
  out.tau = 0;
  out.v = v;
  out.s.shift.resize(0);
  evaluate(model, tape, t, q, v, is_same_place, out);
}

void push_forward(const ModelData& model, ArcDerivative& arc, const VecX& dQ, double dtau,
                  Tangent& z) {
  const double half = arc.tau / 2;
  const Packed& w = arc.s.w;
  arc.x = z.q;
  turn<&TurnDerivative::half>(arc, arc.x);
  arc.y.setZero();
  multiply_by_hessian(model.tree, model.packed, w, arc.x, arc.y, arc.product);
  arc.dv = z.p;
  turn<&TurnDerivative::K>(arc, arc.dv);
  arc.y = arc.product.by_q + dQ;
  turn<&TurnDerivative::C>(arc, arc.y);
  arc.dv += half * arc.y - arc.product.by_v + dtau * arc.R;
  solve_scaled(model.tree, model.packed, arc.s.J, arc.dv);

  arc.y = arc.dv;
  turn<&TurnDerivative::C>(arc, arc.y);
  arc.x_m = arc.x + half * arc.y + dtau / 2 * arc.v;
  multiply_by_hessian(model.tree, model.packed, w, arc.x_m, arc.dv, arc.product);
  if (arc.energy_q.size() > 0) {
    z.energy = arc.energy_q.dot(arc.x_m) + arc.energy_v.dot(arc.dv);
  }
  for (const TurnDerivative& t : arc.turns) {
    const Vec3 dv = arc.dv.segment<3>(t.velocity), dL_v = arc.product.by_v.segment<3>(t.velocity);
    arc.product.by_q.segment<3>(t.velocity) += dv.cross(t.L_v) + t.rate.cross(dL_v);
  }
  z.p += arc.tau * (arc.product.by_q + dQ) + dtau * arc.force;
  turn<&TurnDerivative::whole>(arc, z.q);
  arc.y = arc.dv;
  turn<&TurnDerivative::K>(arc, arc.y);
  z.q += arc.tau * arc.y + dtau * arc.v;
}

double pull_back(const ModelData& model, ArcDerivative& arc, VecX& Q, Tangent& z) {
  const double half = arc.tau / 2;
  const Packed& w = arc.s.w;
  double of_tau = arc.v.dot(z.q) + arc.force.dot(z.p);
  arc.dv = arc.tau * z.q;
  turn_back<&TurnDerivative::K>(arc, arc.dv);
  arc.dv += arc.hat_v;
  arc.x = arc.tau * z.p;
  Q += arc.x;
  arc.y.setZero();
  for (const TurnDerivative& t : arc.turns) {
    const Vec3 push = arc.x.segment<3>(t.velocity);
    arc.y.segment<3>(t.velocity) = push.cross(t.rate);
    arc.dv.segment<3>(t.velocity) += t.L_v.cross(push);
  }
  multiply_by_transposed(model.tree, model.packed, w, arc.x, arc.y, arc.product);
  arc.of_L_v = arc.y;
  arc.x_m = arc.product.by_q + arc.hat_m;
  if (arc.energy_q.size() > 0) {
    arc.x_m += z.energy * arc.energy_q;
    arc.dv += z.energy * arc.energy_v;
    z.energy = 0;
  }
  of_tau += arc.x_m.dot(arc.v) / 2;
  arc.y = arc.x_m;
  turn_back<&TurnDerivative::C>(arc, arc.y);
  arc.dv += arc.product.by_v + half * arc.y;
  solve_transposed(model.tree, model.packed, arc.s.J, arc.dv);

  of_tau += arc.R.dot(arc.dv);
  arc.x = half * arc.dv;
  turn_back<&TurnDerivative::C>(arc, arc.x);
  Q += arc.x;
  arc.y = -arc.dv;
  arc.of_L_v += arc.y;
  multiply_by_transposed(model.tree, model.packed, w, arc.x, arc.y, arc.product);
  arc.x_m += arc.product.by_q;
  turn_back<&TurnDerivative::half>(arc, arc.x_m);
  turn_back<&TurnDerivative::whole>(arc, z.q);
  z.q += arc.x_m;
  turn_back<&TurnDerivative::K>(arc, arc.dv);
  z.p += arc.dv;
  return of_tau;
}

}  // namespace saltus
