#include "variational/flight/soft.hpp"

#include <algorithm>
#include <cmath>

#include "variational/flight/impact_time.hpp"

namespace saltus {

namespace {

/// Rebounds a step of a contact that rebounds in full. Friction lets what rocks from point to point
/// rebound ever faster, without end in a finite time: what is faster than this is at rest.
constexpr double most_full_rebounds = 100;

/// @param drop [m] after tau
Return return_with(const Scene& scene, const Contact& c, double drop, double tau) {
  Return out;
  out.drop = drop;
  if (!(out.drop < 0)) return out;
  out.back = std::min(tau, -c.u * tau * tau / out.drop);
  // A step does not follow what is back within half of it: a contact rebounds twice a step at most.
  const double h = scene.options.h;
  const bool is_last = settling_time(out, c.restitution) <= tau || out.back <= h / 2;
  const bool is_fast = c.friction > 0 && out.back <= h / most_full_rebounds;
  out.settles = c.u > 0 && (c.restitution < 1 ? is_last : is_fast);
  return out;
}

}  // namespace

Return return_of(const Scene& scene, int slot, const Node& node, ArcWork& work) {
  const Contact& c = node.contacts[node.contact_at(slot)];
  const double tau = work.arc.tau;
  return return_with(scene, c, phi_at_end(scene, node.pool[slot], work) - c.phi - c.u * tau, tau);
}

// Bounces after it take e, e^2, ... of its time (theory, section 6, Zeno).
double settling_time(const Return& hop, double restitution) {
  return restitution < 1 ? hop.back / (1 - restitution) : hop.back;
}

namespace {

/// How a pair that is open closes, from g ~ phi + u tau + a tau^2 / 2 through the arc's end.
struct Closing {
  double speed = 0, acceleration = 0;  ///< [m/s], [m/s^2] towards each other
  double time = 0;                     ///< [s] until then
  /// [s] of the rebound and all that follow
  double bounces(double e) const { return 2 * e * speed / (acceleration * (1 - e)); }
};

/// Of what closes with the acceleration a from c.phi on, at the rate u.
Closing closing_with(double a, const Contact& c, double u) {
  const double speed = std::sqrt(std::max(0.0, u * u + 2 * a * c.phi));
  return {speed, a, (u + speed) / a};
}

/// Nothing where nobody knows: in an arc too short, or of a pair that is not pushed together.
/// @param u [m/s] the gap's rate at the node
std::optional<Closing> closing_of(const Scene& scene, const Contact& c, double u, const Pair& pair,
                                  ArcWork& work) {
  const double tau = work.arc.tau;
  const double drop = phi_at_end(scene, pair, work) - c.phi - u * tau;
  if (!(drop < -1e3 * gap_rounding(c, pair))) return std::nullopt;
  return closing_with(-2 * drop / (tau * tau), c, u);
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

void note_soft(int slot, double acceleration, Flight& f) {
  for (Soft& each : f.softs) {
    if (each.slot == slot) return void(each.acceleration = acceleration);
  }
  f.softs.push_back({slot, acceleration});
}

/// The pair, open at the node, as a contact in f.closing_contact. @return false where it has none
bool set_closing_contact(const Scene& scene, int slot, const Node& node, Flight& f) {
  const Pair& pair = node.pool[slot];
  const Gap g = pair_gap(scene.model.tree, node.kin, pair);
  if (is_silent(scene.model.tree, node.kin, pair, g)) return false;
  write_contact(scene, typical_speed(scene, node), slot, pair, g, node, f.work.rows.dense,
                f.closing_contact);
  return true;
}

void rest_hop(const Scene& scene, int contact, double over, const Node& node, Flight& f) {
  f.settlings.push_back({node.t + over, node.contacts[contact].slot});
  rest_from_now(scene, contact, node, f.work.rows);
}

void rest_closing(const Scene& scene, const Closing& closing, const Node& node, Flight& f) {
  const Contact& c = f.closing_contact;
  f.settlings.push_back({node.t + closing.time + closing.bounces(c.restitution), c.slot});
  rest_ahead(scene, c, node, f.work.rows);
}

/// @return true where the hit is soft, and rests now
bool rest(const Scene& scene, const Hit& hit, const Node& node, Flight& f) {
  ArcWork& work = f.work;
  const int contact = node.contact_at(hit.slot);
  const double tau = work.arc.tau;
  if (contact >= 0) {  // it leaves, and comes back: on the chord, or by the chord's bend
    const Return hop = return_of(scene, hit.slot, node, work);
    if (!hop.settles) return false;
    note_soft(hit.slot, -2 * hop.drop / (tau * tau), f);
    rest_hop(scene, contact, settling_time(hop, node.contacts[contact].restitution), node, f);
    return true;
  }
  if (!(hit.s > 0)) return false;
  if (properties_of(scene, hit.slot, node).restitution >= 1) return false;
  if (!set_closing_contact(scene, hit.slot, node, f)) return false;
  const Contact& c = f.closing_contact;
  const VecX* v = velocity_at(scene, node, f);
  if (v == nullptr) return false;
  const double u = dot(scene.trees, c.n, *v);
  const std::optional<Closing> closing = closing_of(scene, c, u, node.pool[hit.slot], work);
  if (!closing || !is_soft(*closing, c.restitution, scene.options.h)) return false;
  note_soft(hit.slot, closing->acceleration, f);
  rest_closing(scene, *closing, node, f);
  return true;
}

}  // namespace

void rest_as_before(const Scene& scene, double left, const Node& node, Flight& f) {
  if (!node.has_factors) return;
  const double h = scene.options.h;
  for (const Soft& soft : f.softs) {
    const int contact = node.contact_at(soft.slot);
    if (contact >= 0) {
      const Contact& c = node.contacts[contact];
      const Return hop = return_with(scene, c, -soft.acceleration * left * left / 2, left);
      const bool is_back = c.u * left + hop.drop <= 0;
      if (c.motion == Contact::Motion::rests || !hop.settles || !is_back) continue;
      rest_hop(scene, contact, settling_time(hop, c.restitution), node, f);
      continue;
    }
    if (!set_closing_contact(scene, soft.slot, node, f)) continue;
    const Contact& c = f.closing_contact;
    const Closing closing = closing_with(soft.acceleration, c, dot(scene.trees, c.n, node.v));
    if (closing.time > left || !is_soft(closing, c.restitution, h)) continue;
    rest_closing(scene, closing, node, f);
  }
}

bool rest_soft_hits(const Scene& scene, const Node& node, Flight& f) {
  const auto is_soft = [&](const Hit& hit) { return rest(scene, hit, node, f); };
  const auto rests = std::remove_if(f.hits.begin(), f.hits.end(), is_soft);
  const bool some = rests != f.hits.end();
  f.hits.erase(rests, f.hits.end());
  if (some) f.skips.watch_again();
  return some;
}

}  // namespace saltus
