// Bodies that an arc left a little in each other are moved apart at its end.
//
// What the law was missed by in an arc, and what the point that a rim was held at is not its lowest
// any more, is left as overlap: of 1e-9 m a step, again and again. Targets of rows never bring it
// back, as that would be a speed. So the configuration is moved, by the least in the metric of M
// that opens all contacts,
//
//   dq = M^-1 N^T lambda,   0 <= lambda  _|_  phi + N dq >= 0
//
// and momenta are shortened by what that lifts, so that no energy is gained.
#include <algorithm>
#include <cmath>

#include "saltus/tree/coordinates.hpp"
#include "variational/step/stepper_impl.hpp"

namespace saltus {
namespace {

/// Touches that are no overlap: what rests is off by less, and stays where it is to the last bit.
constexpr double few_touches = 4;

double depth(const Node& node) {
  double most = 0;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    most = std::max(most, -c.phi / node.pool[c.slot].touch);
  }
  return most;
}

/// Writes dq of all contacts together. @return false where they do not open
bool find_lift(const Scene& scene, Node& node, HalfKick& kick, VecX& dq) {
  kick.contacts.clear();
  for (int i = 0; i < node.touching; ++i) kick.contacts.push_back(&node.contacts[i]);
  set_contact_blocks(scene, kick.contacts, node, kick.neighbours, kick.W, kick.u);
  const auto m = kick.contacts.size();
  for (std::size_t i = 0; i < m; ++i) {
    kick.u[i] = Vec3(kick.contacts[i]->phi, 0, 0);
    kick.W.friction[i] = 0;
    kick.W.rest[i] = 1e-3 * node.pool[kick.contacts[i]->slot].touch;
  }
  kick.p.assign(m, Vec3::Zero());
  kick.pile.reserve(m);
  if (!(settle_for_sure(kick.W, kick.pile, kick.u, kick.p).excess <= large_residual)) return false;
  dq.setZero();
  for (std::size_t i = 0; i < m; ++i) {
    add(scene.trees, kick.p[i][0], kick.contacts[i]->column, dq);
  }
  return dq.allFinite();
}

}  // namespace

/// Gaps are no planes: what one lift leaves the next one takes. The first few are enough.
void Stepper::Impl::lift_out() {
  constexpr int most_lifts = 4;  // 1 or 2 are usual
  for (int k = 0; k < most_lifts; ++k) {
    const double before = depth(node);
    if (!(before > few_touches)) return;
    lift_once(before);
    if (!(depth(node) < before)) return;
  }
}

/// Energy may come back up to what there was at the arc's start: to sink is no motion.
void Stepper::Impl::lift_once(double before) {
  if (!node.has_factors && !set_velocity_at_node(scene, node)) return;
  const bool is_held = !flight.work.rows.active.empty();
  const double H = node_energy(scene, node), most = is_held ? std::max(H, energy) : H;
  if (!find_lift(scene, node, kick, lift)) return;
  q_sunk = node.q;
  p_sunk = node.p;
  integrate(scene.model.tree, q_sunk, 1, lift, unlocated.q_end);
  if (node.loops.some && !close_near(scene, node, node.t, unlocated.q_end, end)) return;
  if (!place_with_contacts(unlocated.q_end, p_sunk)) return place_back();
  const double T = 0.5 * node.p.dot(node.v), gain = node_energy(scene, node) - most;
  if (!(depth(node) < before) || gain > T) {
    place_back();
  } else if (gain > 0) {
    p_sunk *= std::sqrt(1 - gain / T);
    if (!place_with_contacts(unlocated.q_end, p_sunk)) place_back();
  }
}

/// Where the arc ended, which was placed once.
void Stepper::Impl::place_back() {
  if (!place_with_contacts(q_sunk, p_sunk)) fail(FlightOutcome::not_converged);
}

bool Stepper::Impl::place_with_contacts(const VecX& q, const VecX& p) {
  place_node(scene, node.t, q, p, node);
  return set_velocity_at_node(scene, node) && find_contacts(scene, node);
}

}  // namespace saltus
