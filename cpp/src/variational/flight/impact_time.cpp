#include "variational/flight/impact_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "variational/arc/closing_arc.hpp"
#include "variational/flight/held_arc.hpp"

namespace saltus {
namespace {

/// g and g' at the end of flight.arc.
struct GapAtEnd {
  double phi;
  double slope;
};

double phi_at_end(const ModelData& model, const Pair& pair, Flight& f) {
  place_end(model, f.arc.q_end, f.scratch);
  return pair_gap_at_end(model, pair, f.scratch).phi;
}

/// Also writes flight.rate = v'(tau), the next guess's slope.
GapAtEnd gap_at_end(const ModelData& model, const Pair& pair, Flight& f) {
  place_end(model, f.arc.q_end, f.scratch);
  const Gap g = pair_gap_at_end(model, pair, f.scratch);
  f.n.setZero();
  add_gap_gradient(model.tree, f.scratch.kin_end, pair, g, f.n);
  arc_rate(model, f.arc, f.scratch, f.rate);
  pull_back_end(model.packed, f.scratch.J, f.n);
  f.has_rate = true;
  return {g.phi, f.n.dot(f.arc.v) + f.arc.tau * f.n.dot(f.rate)};
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

/// Time and velocity at once; false leaves the flight's guess as it was.
bool refine_at_once(const ModelData& model, const StepOptions& options, const Pair& pair,
                    double tau, double longest, Node& node, Flight& f) {
  if (!f.rows.active.empty() || f.is_launched) return false;
  f.before_v = f.arc.v;
  f.arc.tau = tau;
  const ClosingGap gap{pair, longest, f.n, f.rate};
  const bool closed = solve_closing_arc(model, node.q, node.p, options, gap, f.arc, f.scratch);
  f.iterations += f.arc.iterations;
  f.has_rate = f.has_rate || f.arc.iterations > 0;
  if (!closed) f.arc.v = f.before_v;
  return closed;
}

ImpactTime refine(const ModelData& model, const StepOptions& options, const Pair& pair, double tau,
                  Bracket b, Node& node, Flight& f) {
  if (refine_at_once(model, options, pair, tau, b.hi, node, f)) return ImpactTime::found;
  const double touch = pair.touch;
  const double whole = b.hi;
  double phi_before = std::numeric_limits<double>::infinity();
  // bisection alone takes 60 halvings to the last bit; Newton 3 to 5 steps
  for (int k = 0; k < 100; ++k) {
    if (!solve_flight_arc(model, options, tau, node, f)) return ImpactTime::not_converged;
    const GapAtEnd g = gap_at_end(model, pair, f);
    const bool stalled = std::abs(g.phi) <= touch / 2 && std::abs(g.phi) >= phi_before / 2;
    if (std::abs(g.phi) <= 1e-3 * touch || stalled) return ImpactTime::found;
    if (g.phi > 0 && tau >= whole) return ImpactTime::missed;
    if (g.phi > 0) {
      b.lo = tau;
    } else {
      b.hi = tau;
      b.hi_is_closed = true;
    }
    // the bracket is a few ulp wide: the root is as good as doubles can tell it
    if (b.hi - b.lo <= 4e-16 * whole) {
      return std::abs(g.phi) <= touch ? ImpactTime::found : ImpactTime::missed;
    }
    if (!b.hi_is_closed && g.slope >= 0) return ImpactTime::missed;
    phi_before = std::abs(g.phi);
    // slopes leave constraints aside, and may lead nowhere
    const bool halve = k >= 10 && b.hi_is_closed;
    const double next = halve ? (b.lo + b.hi) / 2 : next_tau(b, tau, g);
    f.arc.v += (next - tau) * f.rate;
    tau = next;
  }
  // no duration was found at which the gap is closed: it grazes, a double root and no impact
  return b.hi_is_closed ? ImpactTime::not_located : ImpactTime::missed;
}

/// A pair that touches, leaves and comes back within the arc: g(0) = 0 is the root not wanted.
/// From g ~ u tau + a tau^2 / 2 through the arc's end, the return is near -2 u / a.
ImpactTime find_return(const ModelData& model, const StepOptions& options, int place, Node& node,
                       Flight& f) {
  const int contact = node.contact_of[place];
  if (contact < 0) return ImpactTime::missed;  // a part that does not face the other any more
  const Contact& c = node.contacts[contact];
  const Pair& pair = node.pool[place];
  const double tau = f.arc.tau;
  const double drop = phi_at_end(model, pair, f) - c.phi - c.u * tau;
  if (!(drop < 0)) return ImpactTime::missed;
  const double back = std::min(tau, -c.u * tau * tau / drop);
  // Bounces after it take e, e^2, ... of its time (theory, section 6, Zeno).
  f.settling_time = back / (1 - c.restitution);
  if (c.u > 0 && c.restitution < 1 && f.settling_time <= tau) return ImpactTime::settles;
  if (c.u * back / 4 <= pair.touch) return ImpactTime::at_rest;  // height of the hop
  // half the way back is near the top of the hop, where the gap is open; halve on if not
  double lo = back / 2;
  for (int k = 0;; ++k) {
    if (!solve_flight_arc(model, options, lo, node, f)) return ImpactTime::not_converged;
    if (phi_at_end(model, pair, f) > pair.touch) break;
    if (k == 40) return ImpactTime::at_rest;
    lo /= 2;
  }
  const double start = back > lo ? back : 1.5 * lo;
  return refine(model, options, pair, std::min(start, tau), {lo, tau, false}, node, f);
}

}  // namespace

ArcProblem arc_problem(const StepOptions& options, double tau, const Node& node, Flight& f) {
  return {node.q, node.p, tau, f.is_launched ? &f.launch : nullptr, whole_step(options)};
}

ArcProblem held_arc_problem(const StepOptions& options, double tau, const Node& node, Flight& f) {
  return {node.q, f.rows.momentum, tau, f.is_launched ? &f.launch : nullptr, whole_step(options)};
}

bool solve_flight_arc(const ModelData& model, const StepOptions& options, double tau, Node& node,
                      Flight& f) {
  const bool is_held = tau > 0 && !f.rows.active.empty();
  const bool converged =
      is_held ? solve_held_arc(model, options, tau, node, f)
              : solve_arc(model, arc_problem(options, tau, node, f), options, f.arc, f.scratch);
  f.iterations += f.arc.iterations;
  return converged;
}

ImpactTime find_impact_time(const ModelData& model, const StepOptions& options, int place, double s,
                            Node& node, Flight& f) {
  if (s <= 0) return find_return(model, options, place, node, f);
  const Pair& pair = node.pool[place];
  const double tau = f.arc.tau;
  // most often the velocity of the shorter arc can be told from the arcs before
  if (f.rows.active.empty() && !f.is_launched &&
      f.history.extrapolate(node.t + s * tau / 2, f.arc.v)) {
    if (refine_at_once(model, options, pair, s * tau, tau, node, f)) return ImpactTime::found;
    f.arc.v = f.start_v;
    if (!solve_flight_arc(model, options, tau, node, f)) return ImpactTime::not_converged;
  }
  const bool closed = gap_at_end(model, pair, f).phi < 0;
  f.arc.v += (s - 1) * tau * f.rate;
  return refine(model, options, pair, s * tau, {0, tau, closed}, node, f);
}

}  // namespace saltus
