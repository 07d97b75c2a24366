#include "variational/flight/impact_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/arc/closing_arc.hpp"
#include "variational/flight/sinking.hpp"
#include "variational/flight/soft.hpp"

namespace saltus {

double phi_at_end(const Scene& scene, const Pair& pair, ArcWork& work) {
  place_end(scene.model, work.arc.q_end, work.scratch);
  return pair_gap_at_end(scene.model, pair, work.scratch).phi;
}

namespace {

bool has_rim(const Pair& pair) {
  return std::holds_alternative<Rim>(pair.kind) || std::holds_alternative<RimCrossing>(pair.kind);
}

/// What does not leaps where its parts change sides: no impact. So do rims that pass level.
bool faces_at_end(const Scene& scene, const Pair& pair, ArcWork& work) {
  const ModelData& model = scene.model;
  place_end(model, work.arc.q_end, work.scratch);
  const Gap gap = pair_gap_at_end(model, pair, work.scratch);
  return !has_rim(pair) && !is_silent(model.tree, work.scratch.kin_end, pair, gap);
}

/// g and g' at the end of flight.arc.
struct GapAtEnd {
  double phi;
  double slope;
};

/// Also writes memory.rate = v'(tau), the next guess's slope.
GapAtEnd gap_at_end(const Scene& scene, const Pair& pair, Memory& memory, Flight& f) {
  const ModelData& model = scene.model;
  const Arc& arc = f.work.arc;
  ArcScratch& s = f.work.scratch;
  place_end(model, arc.q_end, s);
  const Gap g = pair_gap_at_end(model, pair, s);
  place_chain_at_end(model, pair, s);
  f.n.setZero();
  add_gap_gradient(model.tree, s.kin_end, pair, g, f.n);
  arc_rate(model, arc, s, memory.rate);
  pull_back_end(model.packed, s.J, f.n);
  memory.has_rate = true;
  return {g.phi, f.n.dot(arc.v) + arc.tau * f.n.dot(memory.rate)};
}

struct Bracket {
  double lo, hi;      ///< g(lo) > 0
  bool hi_is_closed;  ///< g(hi) < 0 is known
};

/// Newton's next tau, kept inside the bracket.
double next_tau(const Bracket& b, double tau, const GapAtEnd& g) {
  const double newton = tau - g.phi / g.slope;
  if (std::isfinite(newton) && newton > b.lo && newton < b.hi) return newton;
  if (!b.hi_is_closed && (!std::isfinite(newton) || newton >= b.hi)) return b.hi;
  return (b.lo + b.hi) / 2;
}

bool is_free(const ArcWork& work) {
  return work.rows.active.empty() && work.line.use == LaunchLine::Use::none && !work.scratch.loops;
}

}  // namespace

bool has_smooth_path(const Pair& pair, const ArcWork& work) {
  if (is_free(work) || work.line.use != LaunchLine::Use::none || has_rim(pair)) return false;
  return std::none_of(work.rows.active.begin(), work.rows.active.end(), [&](int i) {
    const Row& row = work.rows.row[i];
    return !row.is_joint() && has_rim(*row.pair);
  });
}

namespace {

/// Time and velocity at once; false leaves the arc's guess as it was.
bool refine_at_once(const Scene& scene, const Pair& pair, double tau, double longest,
                    const Node& node, Memory& memory, Flight& f) {
  if (!is_free(f.work)) return false;
  Arc& arc = f.work.arc;
  f.before_v = arc.v;
  const ClosingGap gap{pair, longest, f.n, memory.rate};
  const ArcProblem problem = arc_problem(scene, tau, node, f.work);
  const bool closed = solve_closing_arc(scene.model, problem, gap, arc, f.work.scratch);
  f.work.iterations += arc.iterations;
  memory.has_rate = memory.has_rate || arc.iterations > 0;
  if (!closed) arc.v = f.before_v;
  return closed;
}

/// The gap where the path has been for tau, whose velocity it leaves in arc.v.
double gap_on_path(const Scene& scene, const Pair& pair, double tau, const Node& node, Flight& f) {
  const ModelData& model = scene.model;
  ArcWork& work = f.work;
  f.path.velocity(tau, work.arc.v);
  integrate(model.tree, node.q, tau, work.arc.v, work.scratch.q);
  place_end(model, work.scratch.q, work.scratch);
  return pair_gap_at_end(model, pair, work.scratch).phi;
}

/// Where the gap closes on the path: within the bracket, of which the path knows the ends nearly.
/// Regula falsi as the Illinois method has it (M. Dowell & P. Jarratt, BIT 11, 1971).
double root_on_path(const Scene& scene, const Pair& pair, const Bracket& b, const Node& node,
                    Flight& f) {
  double lo = b.lo, hi = b.hi;
  double g_lo = gap_on_path(scene, pair, lo, node, f), g_hi = gap_on_path(scene, pair, hi, node, f);
  if (!(g_lo > 0)) return (lo + hi) / 2;
  if (!(g_hi < 0)) {  // the path is known about its start
    double step = (b.hi - b.lo) / 256;
    for (hi = lo + step; hi < b.hi; lo = hi, g_lo = g_hi, hi = lo + step) {
      g_hi = gap_on_path(scene, pair, hi, node, f);
      if (g_hi < 0) break;
      step *= 2;
    }
    if (!(g_hi < 0)) return (b.lo + b.hi) / 2;
  }
  int side = 0;
  for (int k = 0; k < 30 && hi - lo > 1e-14 * b.hi; ++k) {
    const double tau = std::clamp((lo * g_hi - hi * g_lo) / (g_hi - g_lo), lo, hi);
    const double g = gap_on_path(scene, pair, tau, node, f);
    if (std::abs(g) <= 1e-4 * pair.touch) return tau;
    if (g > 0) {
      lo = tau, g_lo = g;
      if (side > 0) g_hi /= 2;
    } else {
      hi = tau, g_hi = g;
      if (side < 0) g_lo /= 2;
    }
    side = g > 0 ? 1 : -1;
  }
  return (lo + hi) / 2;
}

bool solve_roughly(const Scene& scene, double tau, double rough, const Node& node, ArcWork& work) {
  work.rough = rough;
  const bool is_solved = solve(scene, tau, node, work);
  work.rough = 0;
  return is_solved;
}

/// Of an arc that contacts hold, whose gap is closed at its end, b.hi, with f.start_v there.
/// @return false where it comes to no end: the arc is that of before
bool refine_on_path(const Scene& scene, const Pair& pair, Bracket b, const Node& node, Flight& f) {
  constexpr int most_arcs = 8;  // 3 or 4 are usual
  const double whole = b.hi;
  f.before_v = f.work.arc.v;
  f.path.start();
  if (node.has_factors) f.path.add(0, node.v);
  if (b.lo > 0 && f.work.arc.tau == b.lo) f.path.add(b.lo, f.work.arc.v);
  f.path.add(whole, f.start_v);
  for (int k = 0; k < most_arcs; ++k) {
    const double tau = root_on_path(scene, pair, b, node, f);
    f.path.velocity(tau, f.work.arc.v);
    // the path through the first is not known well yet: a look is enough
    if (!solve_roughly(scene, tau, k == 0 ? rough_look : 0, node, f.work)) break;
    if (f.work.is_rough) {
      f.path.add(tau, f.work.arc.v);
      continue;
    }
    const double phi = phi_at_end(scene, pair, f.work);
    if (std::abs(phi) <= 1e-3 * pair.touch) return true;
    (phi > 0 ? b.lo : b.hi) = tau;
    if (b.hi - b.lo <= 4e-16 * whole) break;
    f.path.add(tau, f.work.arc.v);
  }
  f.work.arc.v = f.before_v;
  return false;
}

ImpactTime refine(const Scene& scene, const Pair& pair, double tau, Bracket b, const Node& node,
                  Memory& memory, Flight& f) {
  if (refine_at_once(scene, pair, tau, b.hi, node, memory, f)) return ImpactTime::found;
  if (b.hi_is_closed && has_smooth_path(pair, f.work)) {
    if (refine_on_path(scene, pair, b, node, f)) return ImpactTime::found;
  }
  const double touch = pair.touch;
  const double whole = b.hi;
  double phi_before = std::numeric_limits<double>::infinity();
  double tau_last = tau, phi_last = phi_before;
  // bisection alone takes 60 halvings to the last bit; Newton 3 to 5 steps
  for (int k = 0; k < 100; ++k) {
    if (!solve(scene, tau, node, f.work)) return ImpactTime::not_converged;
    GapAtEnd g = gap_at_end(scene, pair, memory, f);
    // the slope of a held arc leaves aside what holds it
    const double secant = (g.phi - phi_last) / (tau - tau_last);
    if (k > 2 && !is_free(f.work) && std::isfinite(secant)) g.slope = secant;
    tau_last = tau;
    phi_last = g.phi;
    // a stop is a number: there what stalls is a slope that leaves aside what holds the arc
    const double near = pair.is_stop() ? 1e-2 * touch : touch / 2;
    const bool stalled = std::abs(g.phi) <= near && std::abs(g.phi) >= phi_before / 2;
    if (std::abs(g.phi) <= 1e-3 * touch || stalled) return ImpactTime::found;
    if (g.phi > 0 && tau >= whole) return ImpactTime::missed;
    if (g.phi > 0) {
      b.lo = tau;
    } else {
      b.hi = tau;
      b.hi_is_closed = true;
    }
    // what many rows hold is no sharper than what its Newton iteration leaves
    const double known = is_free(f.work) ? touch : noisy_touches * touch;
    const double width = b.hi - b.lo;
    const bool is_noise = b.hi_is_closed && std::abs(g.slope) * width < std::abs(g.phi) / 4;
    if (is_noise && std::abs(g.phi) <= known) return ImpactTime::found;
    // the bracket is a few ulp wide: the root is as good as doubles can tell it
    if (width <= 4e-16 * whole) {
      if (std::abs(g.phi) <= known) return ImpactTime::found;
      const bool is_open = g.phi > 0 && b.hi == whole;  // where the arc before was closed
      const bool is_root = b.hi_is_closed && !is_open && faces_at_end(scene, pair, f.work);
      return is_root ? ImpactTime::not_located : ImpactTime::missed;
    }
    if (!b.hi_is_closed && g.slope >= 0) return ImpactTime::missed;
    phi_before = std::abs(g.phi);
    // slopes leave constraints aside, and may lead nowhere
    const bool halve = k >= 10 && b.hi_is_closed;
    const double next = halve ? (b.lo + b.hi) / 2 : next_tau(b, tau, g);
    f.work.arc.v += (next - tau) * memory.rate;
    tau = next;
  }
  // no duration was found at which the gap is closed: it grazes, a double root and no impact
  return b.hi_is_closed ? ImpactTime::not_located : ImpactTime::missed;
}

/// A pair that touches, leaves and comes back within the arc.
ImpactTime find_return(const Scene& scene, int slot, const Node& node, Memory& memory, Flight& f) {
  const Contact& c = node.contacts[node.contact_at(slot)];
  const Pair& pair = node.pool[slot];
  const double tau = f.work.arc.tau;
  const Return hop = return_of(scene, slot, node, f.work);
  if (!(hop.drop < 0)) return ImpactTime::missed;
  const double back = hop.back;
  if (c.u * back / 4 <= pair.touch) return ImpactTime::at_rest;  // height of the hop
  // half the way back is near the top of the hop, where the gap is open; if not, it comes back
  // sooner: as the gap there says, or half of that
  double lo = back / 2;
  for (int k = 0;; ++k) {
    if (!solve_roughly(scene, lo, rough_look, node, f.work)) return ImpactTime::not_converged;
    const double phi = phi_at_end(scene, pair, f.work);
    if (phi > pair.touch) break;
    if (k == 40) return ImpactTime::at_rest;
    const double drop = phi - c.phi - c.u * lo;
    lo = std::min(lo / 2, std::max(-c.u * lo * lo / drop / 2, lo / 16));
  }
  const double start = back > lo ? back : 1.5 * lo;
  const bool closes = c.phi + c.u * tau + hop.drop < 0;
  return refine(scene, pair, std::min(start, tau), {lo, tau, closes}, node, memory, f);
}

}  // namespace

ImpactTime find_impact_time(const Scene& scene, const Hit& hit, const Node& node, Memory& memory,
                            Flight& f) {
  if (hit.sinks) return find_sinking_time(scene, hit, node, f);
  if (hit.hops || hit.s <= 0) {
    // a part that does not face the other any more is none
    if (node.contact_at(hit.slot) < 0) return ImpactTime::missed;
    return find_return(scene, hit.slot, node, memory, f);
  }
  const Pair& pair = node.pool[hit.slot];
  ArcWork& work = f.work;
  const double tau = work.arc.tau;
  // most often the velocity of the shorter arc can be told from the arcs before
  if (is_free(work) && memory.velocities.extrapolate(node.t + hit.s * tau / 2, work.arc.v)) {
    if (refine_at_once(scene, pair, hit.s * tau, tau, node, memory, f)) return ImpactTime::found;
    work.arc.v = f.start_v;
    if (!solve(scene, tau, node, work)) return ImpactTime::not_converged;
  }
  const bool closed = gap_at_end(scene, pair, memory, f).phi < 0;
  work.arc.v += (hit.s - 1) * tau * memory.rate;
  return refine(scene, pair, hit.s * tau, {0, tau, closed}, node, memory, f);
}

}  // namespace saltus
