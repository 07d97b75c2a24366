#include "derivatives/impulse_derivative.hpp"

#include <algorithm>

#include "derivatives/selected.hpp"

namespace saltus {

Pair pair_of(const ModelData& model, int number) {
  if (model.is_limit(number)) {
    const JointLimit& limit = model.limit(number);
    return make_stop(model.tree, limit.joint, limit.stop);
  }
  const PairTable::Key key = model.pairs.key(number);
  return make_pair(model.tree, model.shapes, key.a, key.b, key.part);
}

void set_gap_derivative(const ModelData& model, const Kinematics& kin, int number,
                        GapDerivative& out) {
  set_gap_derivative(model, kin, pair_of(model, number), out);
}

void set_gap_derivative(const ModelData& model, const Kinematics& kin, const Pair& pair,
                        GapDerivative& out) {
  const Gap gap = pair_gap(model.tree, kin, pair);
  out.n.setZero(model.tree.n_v);
  add_gap_gradient(model.tree, kin, pair, gap, out.n);
  set_gap_hessian(model.tree, kin, pair, gap, out.H, out.velocities);
  out.balls.clear();
  for (const Ball& ball : model.tree.balls) {
    if (std::binary_search(out.velocities.begin(), out.velocities.end(), ball.velocity)) {
      out.balls.push_back(ball.velocity);
    }
  }
}

void add_gradient_change(const GapDerivative& gap, const VecX& dq, double factor, VecX& dn) {
  add_selected(gap.H, gap.velocities, dq, factor, dn);
  for (const int c : gap.balls) {
    const Vec3 eta = dq.segment<3>(c), n = gap.n.segment<3>(c);
    dn.segment<3>(c) += factor / 2 * eta.cross(n);
  }
}

void add_gradient_covector(const GapDerivative& gap, const VecX& n_hat, double factor, VecX& q) {
  add_selected(gap.H, gap.velocities, n_hat, factor, q);  // H is symmetric
  for (const int c : gap.balls) {
    const Vec3 n = gap.n.segment<3>(c), y = n_hat.segment<3>(c);
    q.segment<3>(c) += factor / 2 * n.cross(y);
  }
}

NodeDerivative::NodeDerivative(const ModelData& model)
    : motion(model), kin(model.tree), w(model.packed), product(model.tree) {
  for (VecX* each : {&v, &zero}) each->setZero(model.tree.n_v);
}

void set_node(const ModelData& model, const Tape& tape, const TapeImpact& impact,
              NodeDerivative& node) {
  node.t = impact.t;
  node.q = impact.q;
  set_configuration(model.tree, node.q, node.kin);
  node.gaps.resize(impact.contacts.size());
  node.restitution.clear();
  node.pairs.clear();
  for (std::size_t i = 0; i < impact.contacts.size(); ++i) {
    const TapeContact& contact = impact.contacts[i];
    set_gap_derivative(model, node.kin, contact.pair, node.gaps[i]);
    node.restitution.push_back(contact.restitution);
    node.pairs.push_back(contact.pair);
  }
  set_node_derivative(model, tape, node.t, node.q, impact.v, node.motion);
}

double closing_of(const ModelData& model, const GapDerivative& gap, NodeDerivative& node) {
  ArcDerivative& motion = node.motion;
  // M a = f - L_vq v
  multiply_by_hessian(model.tree, model.packed, motion.s.w, motion.v, node.zero, motion.product);
  VecX& a = motion.dv;
  a = motion.force - motion.product.by_v;
  solve_scaled(model.tree, model.packed, motion.s.J, a);
  motion.y.setZero();
  add_gradient_change(gap, motion.v, 1, motion.y);
  return gap.n.dot(a) + motion.y.dot(motion.v);
}

namespace {

/// The lock that prescribed joints have in M moves as they are told: it is none of p.
void add_locked(const ModelData& model, double t, const VecX& lock, VecX& p) {
  for (const Equality& e : model.equalities.all) {
    if (e.type != LoopType::prescribed) continue;
    const Drive& drive = model.tree.drive[e.a.joint];
    p[drive.velocity] += lock[drive.velocity] * e.motion(t).rate / drive.multiplier;
  }
}

}  // namespace

void set_flow(const ModelData& model, const Tape& tape, const VecX& p, NodeDerivative& node,
              Tangent& flow) {
  node.v = p;
  add_locked(model, node.t, node.motion.s.J.lock, node.v);
  solve_scaled(model.tree, model.packed, node.motion.s.J, node.v);
  set_node_derivative(model, tape, node.t, node.q, node.v, node.motion, true);
  flow.q = node.v;
  flow.p = node.motion.force;
}

void evaluate_at_compression(const ModelData& model, const ImpulseDerivative& impulse,
                             NodeDerivative& node) {
  set_coordinates(model.tree, model.packed, node.q, node.w);
  set_rates(model.tree, model.packed, impulse.v_s, node.w);
  place(model.packed, node.w);
  move(model.packed, node.w);
  first_pass(model.packed, node.w);
}

void set_impulse(const ModelData& model, const Tape& tape, int contact, VecX& p,
                 NodeDerivative& node, ImpulseDerivative& out) {
  const GapDerivative& gap = node.gaps[static_cast<std::size_t>(contact)];
  out.contact = contact;
  out.restitution = node.restitution[static_cast<std::size_t>(contact)];
  set_flow(model, tape, p, node, out.flow);
  const VecX& v = node.v;
  out.closing = closing_of(model, gap, node);
  out.w = gap.n;
  solve_scaled(model.tree, model.packed, node.motion.s.J, out.w);
  out.G = gap.n.dot(out.w);
  out.u = gap.n.dot(v);
  const double e = out.restitution, compression = -out.u / out.G;
  out.lambda = (1 + e) * compression;
  out.v_s = v + compression * out.w;
  out.slope = out.u;
  evaluate_at_compression(model, out, node);
  second_pass(model.packed, node.w);
  take_generators(model.tree, model.packed, node.w, node.product);
  multiply_by_transposed(model.tree, model.packed, node.w, node.zero, out.w, node.product);
  const double factor = -(1 + e) / out.G;
  out.of_p = factor * out.w;
  out.of_q = -factor * node.product.by_q;
  add_gradient_covector(gap, VecX(2 * out.v_s - v), factor, out.of_q);
  p += out.lambda * gap.n;
}

void push_impulse(const GapDerivative& gap, const ImpulseDerivative& impulse, double de,
                  Tangent& z) {
  const double dlambda = impulse.of_q.dot(z.q) + impulse.of_p.dot(z.p) - impulse.u / impulse.G * de;
  add_gradient_change(gap, z.q, impulse.lambda, z.p);
  z.p += dlambda * gap.n;
}

double pull_impulse(const GapDerivative& gap, const ImpulseDerivative& impulse, Tangent& z) {
  const double of_lambda = gap.n.dot(z.p);
  add_gradient_covector(gap, z.p, impulse.lambda, z.q);
  z.q += of_lambda * impulse.of_q;
  z.p += of_lambda * impulse.of_p;
  return of_lambda;
}

}  // namespace saltus
