#include "variational/flight/soft.hpp"

#include <algorithm>
#include <cmath>

#include "variational/flight/impact_time.hpp"

namespace saltus {

Return return_of(const Scene& scene, int slot, const Node& node, ArcWork& work) {
  const Contact& c = node.contacts[node.contact_at(slot)];
  const double tau = work.arc.tau;
  Return out;
  out.drop = phi_at_end(scene, node.pool[slot], work) - c.phi - c.u * tau;
  if (!(out.drop < 0)) return out;
  out.back = std::min(tau, -c.u * tau * tau / out.drop);
  // A step does not follow what is back within half of it: a contact rebounds twice a step at most.
  const bool is_last = settling_time(out, c.restitution) <= tau || out.back <= scene.options.h / 2;
  out.settles = c.u > 0 && c.restitution < 1 && is_last;
  return out;
}

// Bounces after it take e, e^2, ... of its time (theory, section 6, Zeno).
double settling_time(const Return& hop, double restitution) { return hop.back / (1 - restitution); }

namespace {

/// How a pair that is open closes, from g ~ phi + u tau + a tau^2 / 2 through the arc's end.
struct Closing {
  double speed = 0, acceleration = 0;  ///< [m/s], [m/s^2] towards each other
  double time = 0;                     ///< [s] until then
  /// [s] of the rebound and all that follow
  double bounces(double e) const { return 2 * e * speed / (acceleration * (1 - e)); }
};

/// Nothing where nobody knows: in an arc too short, or of a pair that is not pushed together.
/// @param u [m/s] the gap's rate at the node
std::optional<Closing> closing_of(const Scene& scene, const Contact& c, double u, const Pair& pair,
                                  ArcWork& work) {
  const double tau = work.arc.tau;
  const double drop = phi_at_end(scene, pair, work) - c.phi - u * tau;
  if (!(drop < -1e3 * gap_rounding(c, pair))) return std::nullopt;
  const double a = -2 * drop / (tau * tau);
  const double speed = std::sqrt(std::max(0.0, u * u + 2 * a * c.phi));
  return Closing{speed, a, (u + speed) / a};
}

/// M^-1 p at the node; what a node without contacts has is the velocity of the arc before.
/// @return nullptr where the mass matrix is singular
const VecX* velocity_at(const Scene& scene, const Node& node, Flight& f) {
  if (node.has_factors) return &node.v;
  f.before_v = f.work.arc.v;
  const bool known = guess_from_momenta(scene, node, f.work);
  f.before_v.swap(f.work.arc.v);
  return known ? &f.before_v : nullptr;
}

bool is_soft(const Closing& closing, double restitution, double h) {
  const double change = closing.acceleration * h;
  return closing.speed <= change && 4 * restitution * closing.speed <= change;
}

/// @return true where the hit is soft, and rests now
bool rest(const Scene& scene, const Hit& hit, const Node& node, Flight& f) {
  ArcWork& work = f.work;
  const int contact = node.contact_at(hit.slot);
  if (contact >= 0) {  // it leaves, and comes back: on the chord, or by the chord's bend
    const Return hop = return_of(scene, hit.slot, node, work);
    if (!hop.settles) return false;
    const double time = settling_time(hop, node.contacts[contact].restitution);
    f.settlings.push_back({node.t + time, hit.slot});
    rest_from_now(scene, contact, node, work.rows);
    return true;
  }
  if (!(hit.s > 0)) return false;
  if (properties_of(scene, hit.slot, node).restitution >= 1) return false;
  const Pair& pair = node.pool[hit.slot];
  const Gap g = pair_gap(scene.model.tree, node.kin, pair);
  if (is_silent(scene.model.tree, node.kin, pair, g)) return false;
  write_contact(scene, typical_speed(scene, node), hit.slot, pair, g, node, work.rows.dense,
                f.closing_contact);
  const Contact& c = f.closing_contact;
  const VecX* v = velocity_at(scene, node, f);
  if (v == nullptr) return false;
  const double u = dot(scene.trees, c.n, *v);
  const std::optional<Closing> closing = closing_of(scene, c, u, pair, work);
  if (!closing || !is_soft(*closing, c.restitution, scene.options.h)) return false;
  const double over = closing->time + closing->bounces(c.restitution);
  f.settlings.push_back({node.t + over, hit.slot});
  rest_ahead(scene, c, node, work.rows);
  return true;
}

}  // namespace

bool rest_soft_hits(const Scene& scene, const Node& node, Flight& f) {
  const auto is_soft = [&](const Hit& hit) { return rest(scene, hit, node, f); };
  const auto rests = std::remove_if(f.hits.begin(), f.hits.end(), is_soft);
  const bool some = rests != f.hits.end();
  f.hits.erase(rests, f.hits.end());
  return some;
}

}  // namespace saltus
