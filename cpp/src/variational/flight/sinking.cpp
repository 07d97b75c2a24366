#include "variational/flight/sinking.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// [m] What a rim that is borne may be at, and where it is said to close.
double target_of_rim(int slot, const Node& node) {
  return floor_of(node, slot) + node.pool[slot].touch / 2;
}

/// What sinks: a rim, or the bodies of an edge.
const Pair& pair_of(const Node& node, int slot) {
  return node.pool[slot].kind == PairKind::crossing ? whole_of(node, slot) : node.pool[slot];
}

/// [m] Above the target, where the bodies are at s on the chord.
double height_on_chord(const Scene& scene, const Hit& hit, double s, const Node& node, Flight& f) {
  ArcWork& work = f.work;
  if (s < 1) {
    integrate(scene.model.tree, node.q, s, f.dq, work.scratch.q);
    place_end(scene.model, work.scratch.q, work.scratch);
  } else {
    place_end(scene.model, work.arc.q_end, work.scratch);
  }
  return pair_gap_at_end(scene.model, pair_of(node, hit.slot), work.scratch).phi - hit.target;
}

/// Where heights fall below 0 that are flat above it, of the part that bears the rim, and below it
/// are those of another: a secant through the two last ones below, one step at a time. Where that
/// goes too far, a little less far, by twice as much each time.
class Fall {
 public:
  Fall(double above, double below, double g) : lo_(above), hi_(below), g_(g), hi_before_(below) {}

  double next() const {
    if (misses_ > 0) return lo_ + (hi_ - lo_) * std::min(0.5, std::ldexp(1.0, misses_ - 7));
    const double at = hi_ - g_ * (hi_before_ - hi_) / (g_before_ - g_);
    return at > lo_ && at < hi_ ? at : (lo_ + hi_) / 2;
  }
  void take(double at, double g) {
    if (g > 0) {
      lo_ = at;
      ++misses_;
      return;
    }
    misses_ = 0;
    hi_before_ = std::exchange(hi_, at);
    g_before_ = std::exchange(g_, g);
  }
  bool ends() const { return hi_ - lo_ <= 4e-16 * hi_; }  // a few ulp

 private:
  double lo_, hi_, g_;
  double hi_before_, g_before_ = 0;  // equal places: no secant yet
  int misses_ = 0;
};

constexpr int most_steps = 60;  ///< 5 to 10 are usual, bisection alone takes 30

}  // namespace

bool is_borne(int slot, const Node& node) {
  const Pair& pair = node.pool[slot];
  if (!std::holds_alternative<Rim>(pair.kind) || node.contact_at(slot) >= 0) return false;
  const double phi = node.sunk_at(slot);  // 0 where it is not silent
  return phi != 0 && std::isfinite(phi) && phi <= pair.touch;
}

const Pair& whole_of(const Node& node, int slot) {
  const Pair* solid = node.pool.solid(slot);
  return solid != nullptr ? *solid : node.pool[slot];
}

namespace {

/// Of what is below its target at s, by g < 0: where it falls below.
Hit fall(const Scene& scene, Hit hit, double g, const Node& node, Flight& f) {
  const double touch = node.pool[hit.slot].touch;
  Fall root(0, hit.s, g);
  for (int k = 0; k < most_steps && !root.ends(); ++k) {
    hit.s = root.next();
    const double here = height_on_chord(scene, hit, hit.s, node, f);
    if (std::abs(here) <= touch / 4) break;
    root.take(hit.s, here);
  }
  return hit;
}

}  // namespace

std::optional<Hit> sinking_hit(const Scene& scene, int slot, const Node& node, Flight& f) {
  const double touch = node.pool[slot].touch;
  for (const double s : {1.0, 0.5, 0.25, 0.75}) {
    const Hit hit{slot, s, false, true, target_of_rim(slot, node)};
    const double g = height_on_chord(scene, hit, s, node, f);
    if (g < -touch / 2) return fall(scene, hit, g, node, f);
  }
  return std::nullopt;
}

void find_sinking_bodies(const Scene& scene, const Node& node, Flight& f) {
  const Pair* last = nullptr;
  for (const int slot : node.silent) {
    const Pair& pair = node.pool[slot];
    const Pair* solid = node.pool.solid(slot);
    if (pair.kind != PairKind::crossing || solid == nullptr || solid == last) continue;
    last = solid;
    const double motion = f.broad.motion[pair.a] + f.broad.motion[pair.b];
    if (motion <= noisy_touches * pair.touch || f.skips.passes(slot)) continue;
    const double phi = phi_at_end(scene, *solid, f.work);
    if (phi >= -noisy_touches * pair.touch) continue;
    const double before = std::min(pair_gap(scene.model.tree, node.kin, *solid).phi, 0.0);
    if (phi >= before - noisy_touches * pair.touch) continue;
    const Hit hit{slot, 1, false, true, before - pair.touch / 2};
    f.hits.push_back(fall(scene, hit, phi - hit.target, node, f));
  }
}

ImpactTime find_sinking_time(const Scene& scene, const Hit& hit, const Node& node, Flight& f) {
  ArcWork& work = f.work;
  const Pair& pair = pair_of(node, hit.slot);
  const double whole = work.arc.tau, g_whole = phi_at_end(scene, pair, work) - hit.target;
  if (!(g_whole < 0)) return ImpactTime::missed;  // the arc's end is clear: it grazes
  Fall root(0, whole, g_whole);
  double tau = hit.s * whole;
  for (int k = 0; k < most_steps; ++k) {
    if (!solve(scene, tau, node, work)) return ImpactTime::not_converged;
    const double g = phi_at_end(scene, pair, work) - hit.target;
    if (std::abs(g) <= pair.touch / 4) return ImpactTime::found;
    root.take(tau, g);
    // the ends of arcs that many contacts hold are no sharper
    if (root.ends() && std::abs(g) <= noisy_touches * pair.touch) return ImpactTime::found;
    if (root.ends()) break;
    tau = root.next();
  }
  return ImpactTime::not_located;
}

}  // namespace saltus
