#include "variational/flight/flight.hpp"

#include <cmath>

#include "saltus/collision/chord.hpp"
#include "variational/flight/held_arc.hpp"
#include "variational/flight/impact_time.hpp"
#include "variational/flight/launch.hpp"

namespace saltus {
namespace {

/// A pair met for the first time in this flight.
void fit(int pairs, Flight& f) {
  if (static_cast<int>(f.passed.size()) >= pairs) return;
  f.passed.resize(static_cast<std::size_t>(pairs), 0);
  f.passes.resize(static_cast<std::size_t>(pairs), 0);
}

bool is_clear_on_chord(const ModelData& model, const Pair& solid, const Node& node) {
  const ChordHit hit = first_hit_on_chord(model.tree, solid, node.q, node.dq, 0);
  return hit.outcome == ChordHit::Outcome::clear;
}

struct FirstHit {
  int pair = -1;
  double s = 2;
};

bool is_watched(const Node& node, const Flight& f, int pair) {
  if (f.passed[pair] || std::isinf(node.sunk[pair])) return false;
  const int contact = node.contact_of[pair];
  return contact < 0 || node.contacts[contact].motion != Contact::Motion::rests;
}

/// The pair whose gap closes first on the arc's chord.
FirstHit first_hit(const ModelData& model, Node& node, Flight& f) {
  FirstHit first;
  if (model.pairs.empty()) return first;
  node.dq = f.arc.tau * f.arc.v;
  double margin = 0;
  find_candidates(model.tree, model.shapes, model.pairs, node.kin, node.dq, margin, f.broad);
  const Pair* solid = nullptr;
  bool is_clear = false;
  for (const int number : f.broad.candidates) {
    const int pair = place_of(model, number, node);
    fit(node.pool.size(), f);
    if (node.pool.solid(pair) != solid) {  // no part is nearer than the whole
      solid = node.pool.solid(pair);
      is_clear = solid != nullptr && is_clear_on_chord(model, *solid, node);
    }
    if (is_clear || !is_watched(node, f, pair)) continue;
    const ChordHit hit =
        first_hit_on_chord(model.tree, node.pool[pair], node.q, node.dq, floor_of(node, pair));
    if (hit.outcome != ChordHit::Outcome::clear && hit.s < first.s) first = {pair, hit.s};
  }
  return first;
}

/// A pair that touches at the node and leaves, yet closes along the chord (node.dq) from the start:
/// it hops, and is back before the arc ends.
bool is_hop(const Node& node, int pair) {
  const int contact = node.contact_of[pair];
  return contact >= 0 && dot(node.trees, node.contacts[contact].n, node.dq) <= 0;
}

/// M^-1 p at the node as the guess. @return false where the mass matrix is singular
bool guess_from_momenta(const ModelData& model, Node& node, Flight& f) {
  if (!start_from_momenta(model, node)) return false;
  f.arc.v = node.v;
  return true;
}

/// The arc over the whole remaining time, from the extrapolated guess or, should that lead astray,
/// from the velocity at the node, last from M^-1 p there.
bool solve_first_arc(const ModelData& model, const StepOptions& options, double left, Node& node,
                     Flight& f) {
  const bool is_free = f.rows.active.empty();
  // From where bodies turn by a radian an arc, its velocity is no smooth function of those before
  if (fastest_turn(model.tree, node.v, left).angle > 1 && is_free) {
    if (guess_from_momenta(model, node, f) && solve_flight_arc(model, options, left, node, f)) {
      return true;
    }
  }
  if (f.history.extrapolate(node.t + left / 2, f.arc.v)) {
    if (solve_flight_arc(model, options, left, node, f)) return true;
    forget_impulses(f.rows);
  }
  f.arc.v = node.v;
  if (f.has_rate) {  // of the arc that ended here at an impact: its acceleration goes on, nearly
    f.arc.v += left * f.rate;
    if (solve_flight_arc(model, options, left, node, f)) return true;
    forget_impulses(f.rows);
    f.arc.v = node.v;
  }
  if (solve_flight_arc(model, options, left, node, f)) return true;
  return is_free && guess_from_momenta(model, node, f) &&
         solve_flight_arc(model, options, left, node, f);
}

FlightOutcome no_arc(const Flight& f) {
  const bool has_arc = !f.rows.active.empty() && f.arc.residual <= most_residual;
  return has_arc ? FlightOutcome::law_not_met : FlightOutcome::not_converged;
}

/// Rows of what rests, and the arc over the whole time left.
FlightOutcome begin(const ModelData& model, const StepOptions& options, double left, Node& node,
                    Flight& f) {
  fit(node.pool.size(), f);
  std::fill(f.passed.begin(), f.passed.end(), 0);
  std::fill(f.passes.begin(), f.passes.end(), 0);
  f.is_launched = false;
  make_rows(model, left, node, f.rows);
  return solve_first_arc(model, options, left, node, f) ? FlightOutcome::arrived : no_arc(f);
}

/// No impact of the pair is to be found on this arc.
void let_pass(int pair, Flight& f) {
  f.passed[pair] = 1;
  ++f.passes[pair];
}

/// What may pass on one arc is watched on one that others hold. A few times: then it passes.
void watch_again(Flight& f) {
  constexpr char most_passes = 3;
  for (std::size_t i = 0; i < f.passes.size(); ++i) {
    if (f.passes[i] < most_passes) f.passed[i] = 0;
  }
}

/// An end of a rod whose axis is held on an edge, where the edge comes to that end: the two touch
/// in the same point, and that of the end only grazes.
bool grazes_with_axis(const ModelData& model, int end, const Node& node, Flight& f) {
  const Pair& pair = node.pool[end];
  const auto* ball = std::get_if<Sphere>(&pair.on_a.shape);
  if (pair.kind != PairKind::corner || ball == nullptr || !(ball->radius > 0)) return false;
  place_end(model, f.arc.q_end, f.scratch);
  const Vec3 p_WA = pair_gap_at_end(model, pair, f.scratch).p_WA;
  constexpr double same_point = 1e-3;  // of the radius
  for (const int i : f.rows.active) {
    const Row& row = f.rows.row[i];
    if (node.pool.solid(row.place) != node.pool.solid(end) ||
        row.pair->kind != PairKind::crossing) {
      continue;
    }
    const Gap g = pair_gap_at_end(model, *row.pair, f.scratch);
    const double apart = std::min((g.p_WA - p_WA).norm(), (g.p_WB - p_WA).norm());
    if (apart < same_point * ball->radius) return true;
  }
  return false;
}

/// Shortens the arc of duration tau to where the pair closes, or says why that is no impact.
ImpactTime shorten(const ModelData& model, const StepOptions& options, const FirstHit& hit,
                   double tau, Node& node, Flight& f) {
  const bool hop = is_hop(node, hit.pair);
  f.start_v = f.arc.v;
  f.closing = hit.pair;
  ImpactTime found = find_impact_time(model, options, hit.pair, hop ? 0 : hit.s, node, f);
  if (found == ImpactTime::found && grazes_with_axis(model, hit.pair, node, f)) {
    found = ImpactTime::missed;
  }
  if (found == ImpactTime::found) {
    // Nothing more to find: both ends of its chord touch, or the arc ends at it already (far from
    // the origin the chord tells gaps apart no better than their rounding).
    if (hop || f.arc.tau > tau * (1 - 1e-9)) let_pass(hit.pair, f);
    return found;
  }
  if (found == ImpactTime::missed) let_pass(hit.pair, f);
  if (found == ImpactTime::settles) {
    f.settlings.push_back({node.t + f.settling_time, hit.pair});
  }
  // The law of the arc takes the last hop away, together with all that rests: in a pile one after
  // the other would make each other hop.
  if (found == ImpactTime::settles || found == ImpactTime::at_rest) {
    rest_from_now(model, node.contact_of[hit.pair], node, f.rows);
  }
  f.arc.v = f.start_v;
  return found;
}

}  // namespace

Flight::Flight(const ModelData& model, const StepOptions& options, bool with_friction)
    : history(model.tree.n_v),
      rows(model, with_friction),
      scratch(model, options.law),
      broad(model.tree, model.shapes, model.pairs) {
  if (options.law == ImpactLaw::shadow_energy) meter.emplace(model);
  settlings.reserve(64);
  const int n_v = model.tree.n_v;
  for (VecX* x : {&arc.q_start, &arc.q_end}) x->setZero(model.tree.n_q);
  for (VecX* x : {&arc.v, &arc.p_end, &rate, &start_v, &before_v, &n}) x->setZero(n_v);
  for (VecX* x : {&launch.n, &launch.row, &launch.column}) x->setZero(n_v);
  closings.reserve(64);
}

FlightOutcome fly(const ModelData& model, const StepOptions& options, double left, Node& node,
                  Flight& f, bool& fallback) {
  FlightOutcome outcome = begin(model, options, left, node, f);
  f.has_rate = false;
  double tau = left;
  bool solved = true;
  // every turn presses a row, lets a pair pass, or shortens the arc to an earlier impact
  const int most_turns = 100 + 4 * node.pool.size();
  for (int turn = 0; turn < most_turns && outcome == FlightOutcome::arrived; ++turn) {
    ImpactTime found = ImpactTime::not_converged;
    if (solved || solve_flight_arc(model, options, tau, node, f)) {
      if (node.launch.pending) fallback = !launch(model, options, tau, node, f);
      solved = false;
      if (press_rows(model, f.arc.q_end, node, f.rows, f.scratch)) {
        watch_again(f);
        continue;
      }
      const FirstHit hit = first_hit(model, node, f);
      if (hit.pair < 0) {
        remember_impulses(f.rows);
        return FlightOutcome::arrived;
      }
      found = shorten(model, options, hit, tau, node, f);
    } else if (level_held_ends(model, node, f.rows)) {
      f.arc.v = node.v;
      continue;
    }
    if (found == ImpactTime::not_located) return FlightOutcome::impact_not_located;
    solved = found == ImpactTime::found;
    if (solved) tau = f.arc.tau;
    if (found != ImpactTime::not_converged) continue;
    if (!drop_launch(node, f)) return no_arc(f);
    fallback = true;
    tau = left;
  }
  return outcome == FlightOutcome::arrived ? FlightOutcome::no_progress : outcome;
}

}  // namespace saltus
