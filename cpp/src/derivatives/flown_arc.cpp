// An arc with what held it, forwards and backwards.
#include "derivatives/contact_placements.hpp"

namespace saltus {
namespace {

using Vec2 = Eigen::Vector2d;

/// (I - d d^T) / |P_t| of each direction that the arc hands on to its kick.
Eigen::Matrix2d turning(const HeldArc& held, int source) {
  const Vec2 P = held.P.segment<2>(source), d = P.normalized();
  return (Eigen::Matrix2d::Identity() - d * d.transpose()) / P.norm();
}

/// What the arc gives to its kick.
VecX given(const FlownArc& flown, const VecX& dP, double dtau) {
  if (flown.source.empty()) return {};
  VecX out(flown.kick.given());
  Eigen::Index at = 0;
  for (const FlownArc::Source& each : flown.source) {
    if (each.row < 0) {
      out[at++] = each.rate * dtau;
      continue;
    }
    out.segment<2>(at) = turning(flown.held, each.row) * dP.segment<2>(each.row);
    at += 2;
  }
  return out;
}

/// Its transpose: adds to the covector of P. @return that of tau
double pull_given(const FlownArc& flown, const VecX& extra, VecX& of_P) {
  double of_tau = 0;
  Eigen::Index at = 0;
  for (const FlownArc::Source& each : flown.source) {
    if (each.row < 0) {
      of_tau += each.rate * extra[at++];
      continue;
    }
    of_P.segment<2>(each.row) += turning(flown.held, each.row).transpose() * extra.segment<2>(at);
    at += 2;
  }
  return of_tau;
}

}  // namespace

void push_flown(const ModelData& model, FlownArc& flown, const VecX& dQ, double dtau,
                const Rubbing& friction, Tangent& z) {
  const HeldArc& held = flown.held;
  VecX rates, dP;
  if (held.size() > 0) {
    rates = held.G_0.transpose() * z.q;
    for (Eigen::Index c = 0; c < held.size(); ++c) {
      const auto k = static_cast<std::size_t>(held.contact_of[static_cast<std::size_t>(c)]);
      add_row_change(held.frames[k], held.row_of[static_cast<std::size_t>(c)], z.q, held.P[c], z.p);
    }
  }
  if (held.rubs.size() > 0) z.p += dtau * held.rubs;
  push_matched(model, flown.match, flown.arc, dQ, dtau, z);
  if (held.size() > 0) {
    rates += held.G_q.transpose() * z.q + held.G_v.transpose() * flown.arc.dv +
             held.G_m.transpose() * flown.arc.x_m;
    dP = -(held.S_N * rates);
    for (std::size_t k = 0; k < held.slides.size(); ++k) {
      dP += friction.of(held.slides[k]) * held.S_F.col(static_cast<Eigen::Index>(k));
    }
    z.q += held.R_q * dP;
    z.p += held.R_p * dP;
  }
  push_kick(flown.kick, given(flown, dP, dtau), friction, z);
}

double pull_flown(const ModelData& model, FlownArc& flown, VecX& Q, Tangent& z, Rubbing& friction,
                  ParameterGradient* to) {
  const HeldArc& held = flown.held;
  if (to != nullptr && flown.match.is_set) {
    throw ModelError("the step has no gradient by the model yet: its impact law matches energies");
  }
  VecX extra, residual, of_rates;
  pull_kick(flown.kick, VecX(), z, extra, residual, friction);
  if (to != nullptr && residual.size() > 0) {
    add_kick_gradient(model, flown.node->q, flown.kick, residual, z.p, flown.node->w, *to);
  }
  ArcDerivative& arc = flown.arc;
  double of_tau = 0;
  arc.hat_v.setZero();
  arc.hat_m.setZero();
  if (held.size() > 0) {
    VecX of_P = held.R_q.transpose() * z.q + held.R_p.transpose() * z.p;
    of_tau += pull_given(flown, extra, of_P);
    for (std::size_t k = 0; k < held.slides.size(); ++k) {
      friction.add(held.slides[k], held.S_F.col(static_cast<Eigen::Index>(k)).dot(of_P));
    }
    of_rates = -(held.S_N.transpose() * of_P);
    z.q += held.G_q * of_rates;
    arc.hat_v = held.G_v * of_rates;
    arc.hat_m = held.G_m * of_rates;
  }
  Q.setZero();
  of_tau += pull_matched(model, flown.match, arc, Q, z);
  if (held.rubs.size() > 0) of_tau += held.rubs.dot(z.p);
  if (to != nullptr) add_arc_gradient(model, arc, Q, *to);
  if (held.size() == 0) return of_tau;
  if (to != nullptr) add_held_placements(model, flown, z.p, of_rates, to->placement);
  z.q += held.G_0 * of_rates;
  for (Eigen::Index c = 0; c < held.size(); ++c) {
    const auto k = static_cast<std::size_t>(held.contact_of[static_cast<std::size_t>(c)]);
    add_row_covector(held.frames[k], held.row_of[static_cast<std::size_t>(c)], z.p, held.P[c], z.q);
  }
  return of_tau;
}

void add_kick_gradient(const ModelData& model, const VecX& q, const KickDerivative& kick,
                       const VecX& residual, const VecX& p_hat, Packed& w, ParameterGradient& to) {
  set_coordinates(model.tree, model.packed, q, w);
  set_rates(model.tree, model.packed, kick.v, w);
  place(model.packed, w);
  move(model.packed, w);
  first_pass(model.packed, w);
  add_node_gradient(model, w, kick.of_p * residual, 1, to);
  add_kick_placements(model, q, kick, residual, p_hat, to.placement);
}

}  // namespace saltus
