#include "derivatives/friction_derivative.hpp"

#include <Eigen/Eigenvalues>

#include "variational/law/coulomb.hpp"

namespace saltus {
namespace {

/// A contact's rates and what they are changed by.
struct OneContact {
  Mat3 W;
  Vec3 u;
};

OneContact contact_space(const ModelData& model, const FrameDerivative& frame, const VecX& v,
                         ArcDerivative& motion) {
  OneContact out;
  for (int j = 0; j < 3; ++j) {
    VecX column = frame.row[j];
    solve_scaled(model.tree, model.packed, motion.s.J, column);
    for (int i = 0; i < 3; ++i) out.W(i, j) = frame.row[i].dot(column);
    out.u[j] = frame.row[j].dot(v);
  }
  out.W = (out.W + out.W.transpose()) / 2;
  return out;
}

KickContact contact_with(const ModelData& model, const TapeContact& contact, int axis,
                         const Vec3& P) {
  TapeRow row;
  row.pair = contact.pair;
  row.friction = contact.friction;
  row.axis = axis;
  row.P = P;
  return contact_of(model, row);
}

/// Adds the phase's impulse to p, and differentiates it where that leads.
void set_phase(const ModelData& model, const Tape& tape, const KickContact& contact,
               const FrameDerivative& frame, VecX& p, NodeDerivative& node, KickDerivative& out) {
  for (int i = 0; i < 3; ++i) p += contact.P[i] * frame.row[i];
  Tangent flow;
  set_flow(model, tape, p, node, flow);
  out.contacts.assign(1, contact);
  set_kick(model, node.q, node.motion, out);
}

/// A body with fewer freedoms than its contact has directions may be stopped by many impulses, with
/// a different share along the normal, and the rebound is e times that share.
void check_freedoms(const OneContact& space, const TapeContact& contact) {
  if (!(contact.friction > 0) || !(contact.restitution > 0)) return;
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(space.W);
  for (int k = 0; k < 3; ++k) {
    const bool is_free = modes.eigenvalues()[k] > 1e-10 * space.W.trace();
    if (is_free || std::abs(modes.eigenvectors()(0, k)) < 1e-6) continue;
    throw ModelError(
        "the step has no derivative yet: it has an impact with friction that rebounds, "
        "of bodies with fewer freedoms than the contact has directions");
  }
}

}  // namespace

void set_friction_impulse(const ModelData& model, const Tape& tape, const TapeImpact& told,
                          const TapeImpulse& impulse, VecX& p, NodeDerivative& node,
                          FrictionDerivative& out) {
  const TapeContact& contact = told.contacts[static_cast<std::size_t>(impulse.contact)];
  out.contact = impulse.contact;
  out.restitution = contact.restitution;
  set_flow(model, tape, p, node, out.flow);
  KickContact kick = contact_with(model, contact, impulse.axis, impulse.P);
  FrameDerivative frame;
  set_configuration(model.tree, node.q, node.kin);
  set_frame(model, node.kin, kick.pair, kick.frame, frame);
  out.u = out.slope = frame.row[0].dot(out.flow.q);
  out.closing = closing_of(model, node.gaps[static_cast<std::size_t>(impulse.contact)], node);
  const OneContact space = contact_space(model, frame, out.flow.q, node.motion);
  check_freedoms(space, contact);
  const Vec3 whole = collide_contact(space.W, space.u, contact.friction, contact.restitution);
  if ((whole - impulse.P).norm() > 1e-6 * impulse.P.norm()) {
    throw ModelError(
        "the step has no derivative yet: it has an impact with friction on several "
        "contacts together");
  }
  kick.P = stop_contact(space.W, space.u, contact.friction);
  kick.mode = mode_of(kick.P, contact.friction);
  const Vec3 more = whole - kick.P;
  out.lambda = kick.P[0];
  set_phase(model, tape, kick, frame, p, node, out.compression);
  out.expansion.contacts.clear();
  out.expansion.P.resize(0);
  if (!(contact.restitution > 0)) return;
  kick.P = more;
  kick.mode = mode_of(more, contact.friction);
  kick.is_given = true;
  set_phase(model, tape, kick, frame, p, node, out.expansion);
}

void push_friction(const FrictionDerivative& impulse, double de, const Rubbing& friction,
                   Tangent& z) {
  const VecX dP = push_kick(impulse.compression, VecX(), friction, z);
  if (impulse.expansion.size() == 0) return;
  const double more = impulse.restitution * dP[0] + de * impulse.lambda;
  push_kick(impulse.expansion, VecX::Constant(1, more), friction, z);
}

double pull_friction(const ModelData& model, const FrictionDerivative& impulse,
                     NodeDerivative& node, Tangent& z, Rubbing& friction, ParameterGradient* to) {
  VecX extra, residual, of_P;
  double of_e = 0;
  const auto add = [&](const KickDerivative& kick) {
    if (to != nullptr) add_kick_gradient(model, node.q, kick, residual, z.p, node.w, *to);
  };
  if (impulse.expansion.size() > 0) {
    pull_kick(impulse.expansion, VecX(), z, extra, residual, friction);
    add(impulse.expansion);
    of_e = impulse.lambda * extra[0];
    of_P = VecX::Zero(impulse.compression.size());
    of_P[0] = impulse.restitution * extra[0];
  }
  pull_kick(impulse.compression, of_P, z, extra, residual, friction);
  add(impulse.compression);
  return of_e;
}

}  // namespace saltus
