#include "variational/flight/flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "variational/flight/first_hit.hpp"
#include "variational/flight/impact_time.hpp"
#include "variational/flight/launch.hpp"
#include "variational/flight/sinking.hpp"
#include "variational/flight/soft.hpp"

namespace saltus {
namespace {

/// The arc over the whole remaining time, from the extrapolated guess or, should that lead astray,
/// from the velocity at the node, last from M^-1 p there.
bool solve_first_arc(const Scene& scene, double left, const Node& node, const Memory& memory,
                     ArcWork& work) {
  const bool is_free = work.rows.active.empty();
  // From where bodies turn by a radian an arc, its velocity is no smooth function of those before
  if (is_free && fastest_turn(scene.model.tree, node.v, left).angle > 1) {
    if (guess_from_momenta(scene, node, work) && solve(scene, left, node, work)) return true;
  }
  if (memory.velocities.extrapolate(node.t + left / 2, work.arc.v)) {
    if (solve(scene, left, node, work)) return true;
    forget_impulses(work.rows);
  }
  work.arc.v = node.v;
  if (memory.has_rate) {
    work.arc.v += left * memory.rate;
    if (solve(scene, left, node, work)) return true;
    forget_impulses(work.rows);
    work.arc.v = node.v;
  }
  if (solve(scene, left, node, work)) return true;
  return is_free && guess_from_momenta(scene, node, work) && solve(scene, left, node, work);
}

void start_from_node(const Node& node, ArcWork& work) {
  forget_impulses(work.rows);
  work.arc.v = node.v;
}

FlightOutcome no_arc(const ArcWork& work) {
  const bool has_arc = !work.rows.active.empty() && work.arc.residual <= most_residual;
  return has_arc ? FlightOutcome::law_not_met : FlightOutcome::not_converged;
}

/// What closes at the arc's end is no contact there: another pair has it.
bool is_none(const Scene& scene, int slot, const Node& node, ArcWork& work) {
  return grazes_with_axis(scene, slot, node, work) || is_of_other_parts(scene, slot, node, work) ||
         meets_beyond_ends(scene, slot, node, work);
}

/// Shortens the arc of duration tau to where the pair closes, or says why that is no impact.
ImpactTime shorten(const Scene& scene, const Hit& hit, double tau, const Node& node, Memory& memory,
                   Flight& f) {
  ArcWork& work = f.work;
  const bool is_look = work.is_rough;
  f.start_v = work.arc.v;
  const Pair& pair = node.pool[hit.slot];
  const bool ends_there =
      f.ends_at == hit.slot && std::abs(phi_at_end(scene, pair, work)) <= pair.touch;
  f.closing = hit.slot;
  ImpactTime found = find_impact_time(scene, hit, node, memory, f);
  if (found == ImpactTime::found && !hit.sinks && is_none(scene, hit.slot, node, work)) {
    found = ImpactTime::missed;
  }
  if (found == ImpactTime::found) {
    f.ends_at = hit.slot;
    f.skips.watch_again();  // what a longer arc missed may be closed where this one ends
    // Nothing more to find: both ends of its chord touch, or the arc ended at it already (far from
    // the origin the chord tells gaps apart no better than their rounding, and the end of an arc
    // that many rows hold is no sharper than what its Newton iteration leaves).
    if (hit.hops || ends_there || work.arc.tau > tau * (1 - 1e-9)) f.skips.let_pass(hit.slot);
    return found;
  }
  // what an arc that was only looked at does not hit the arc itself may hit
  if (found == ImpactTime::missed && !is_look) f.skips.let_pass(hit.slot);
  // The law of the arc takes the last hop away, together with all that rests: in a pile one after
  // the other would make each other hop.
  if (found == ImpactTime::at_rest) {
    rest_from_now(scene, node.contact_at(hit.slot), node, work.rows);
    f.skips.watch_again();
  }
  work.arc.v = f.start_v;
  return found;
}

/// Rows that the arc just solved asks for, or asks to be held otherwise. @return true where some do
bool change_rows(const Scene& scene, const Node& node, Flight& f) {
  ArcWork& work = f.work;
  const bool presses = press_rows(scene, work.arc.q_end, node, work.rows, work.scratch);
  const bool rolls_over =
      !presses && hold_rims_at_points(scene, work.arc.q_end, node, work.rows, work.scratch);
  if (!presses && !rolls_over) return false;
  f.skips.watch_again();
  if (rolls_over) start_from_node(node, work);
  return true;
}

/// What was let pass is clear at the arc's end, or no deeper than at the node.
bool has_passed(const Scene& scene, const Node& node, Flight& f) {
  return std::all_of(f.skips.some().begin(), f.skips.some().end(), [&](const Skips::Pass& each) {
    if (!each.now) return true;
    const Pair& pair = whole_of(node, each.slot);
    const double phi = phi_at_end(scene, pair, f.work);
    if (phi >= -noisy_touches * pair.touch) return true;
    f.closing = each.slot;
    return phi >= pair_gap(scene.model.tree, node.kin, pair).phi - noisy_touches * pair.touch;
  });
}

/// The arc just solved is the one that hits were sought of. Where bodies are wedged, friction has
/// several answers, and another start may lead to another one.
bool is_same_arc(const Flight& f) {
  return (f.work.arc.v - f.start_v).norm() <= 1e-10 * f.start_v.norm();
}

/// What would have settled after an arc that has become shorter since has not.
FlightOutcome arrived(const Scene& scene, const Node& node, Flight& f) {
  if (!has_passed(scene, node, f)) return FlightOutcome::impact_not_located;
  const Rows& rows = f.work.rows;
  const auto is_pressed = [&](const Settling& each) {
    return std::any_of(rows.active.begin(), rows.active.end(), [&](int i) {
      return rows.row[i].slot == each.pair && rows.row[i].is_pressed();
    });
  };
  std::erase_if(f.settlings, [&](const Settling& each) { return !is_pressed(each); });
  return FlightOutcome::arrived;
}

}  // namespace

void Skips::start() {
  some_.clear();
  some_.reserve(64);
}

void Skips::let_pass(int slot) {
  for (Pass& each : some_) {
    if (each.slot != slot) continue;
    ++each.times;
    each.now = true;
    return;
  }
  some_.push_back({slot, 1, true});
}

bool Skips::passes(int slot) const {
  return std::any_of(some_.begin(), some_.end(),
                     [&](const Pass& each) { return each.slot == slot && each.now; });
}

void Skips::watch_again() {
  constexpr int most = 3;
  for (Pass& each : some_) each.now = each.now && each.times >= most;
}

Flight::Flight(const Scene& scene)
    : work(scene), broad(scene.model.tree, scene.model.shapes, scene.model.pairs), path(scene) {
  if (scene.options.law == ImpactLaw::shadow_energy) meter.emplace(scene.model);
  closing_contact = fresh_contact(scene);
  settlings.reserve(64);
  softs.reserve(64);
  hits.reserve(64);
  for (VecX* x : {&dq, &start_v, &before_v, &n}) x->setZero(scene.model.tree.n_v);
}

FlightOutcome fly(const Scene& scene, double left, const Launch* launch, const Node& node,
                  Memory& memory, Flight& f) {
  ArcWork& work = f.work;
  f.skips.start();
  f.settlings.clear();
  f.closing = f.ends_at = -1;
  work.line.use = LaunchLine::Use::none;
  f.has_missed_energy = false;
  make_rows(scene, left, node, memory, work.rows);
  // rows that have changed most often change others: a look is enough until none does
  work.rough = launch == nullptr ? rough_look : 0;
  if (launch == nullptr) rest_as_before(scene, left, node, f);
  if (!solve_first_arc(scene, left, node, memory, work)) {
    if (!level_held_ends(scene, node, work.rows)) return no_arc(work);
    work.arc.v = node.v;
    if (!solve(scene, left, node, work)) return no_arc(work);
  }
  memory.has_rate = false;
  double tau = left;
  bool solved = true;
  bool knows_hits = false;  // of this arc: the one before was missed on it
  // every turn presses a row, lets a pair pass, or shortens the arc to an earlier impact
  const int most_turns = 100 + 4 * std::min(node.pool.size(), 250);
  for (int turn = 0; turn < most_turns && work.rows.pile.work <= most_pile_work; ++turn) {
    ImpactTime found = ImpactTime::not_converged;
    if (solved || solve(scene, tau, node, work)) {
      if (launch != nullptr) f.has_missed_energy = !meet(scene, tau, *launch, node, f);
      launch = nullptr;
      solved = false;
      bool changes = change_rows(scene, node, f);
      if (!changes && !(knows_hits && is_same_arc(f))) find_hits(scene, node, f);
      if (!changes && f.hits.empty() && !work.is_rough) find_sinking_bodies(scene, node, f);
      changes = changes || rest_soft_hits(scene, node, f);
      work.rough = changes ? rough_look : 0;
      const std::optional<Hit> hit = changes ? std::nullopt : take_first(f.hits);
      // a look is enough of an arc that will be shortened along a smooth path, too
      const bool is_cut = hit && has_smooth_path(node.pool[hit->slot], work);
      if (changes || (work.is_rough && !is_cut)) {
        knows_hits = false;
        continue;
      }
      if (!hit) return arrived(scene, node, f);
      const bool is_look = work.is_rough;
      found = shorten(scene, *hit, tau, node, memory, f);
      knows_hits = found == ImpactTime::missed && !is_look;
    } else if (level_held_ends(scene, node, work.rows)) {
      work.arc.v = node.v;
      knows_hits = false;
      continue;
    }
    if (found == ImpactTime::not_located) return FlightOutcome::impact_not_located;
    solved = found == ImpactTime::found;
    if (solved) tau = work.arc.tau;
    if (found != ImpactTime::not_converged) continue;
    if (!is_matched(&work.line)) return no_arc(work);
    give_up(node, f);
    tau = left;
  }
  return FlightOutcome::no_progress;
}

}  // namespace saltus
