#include "variational/step/standing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {
namespace {

/// That a tree is watched for before it stands: noise that never turns in so many is rare.
constexpr int steps_watched = 8;

/// [rad] Rounding of a pose's rotation.
constexpr double turn_rounding = 16 * std::numeric_limits<double>::epsilon();

/// What moves on by no more than this part of rounding in all the steps that it is watched for
/// would take days to be seen: the velocity that friction leaves of rounding, for instance.
constexpr double part_of_rounding = 1e-2;

/// Writes standing.rounding. A stop has none that is a length: it is a number, near 1.
void find_held(const HalfKick& kick, const Node& node, Standing& standing) {
  std::fill(standing.rounding.begin(), standing.rounding.end(), 0);
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const Contact& c = *kick.contacts[i];
    if (c.bound > 0 || !(kick.p[i][0] > 0)) continue;
    const Pair& pair = node.pool[c.slot];
    const double size = pair.is_stop() ? turn_rounding : gap_rounding(c, pair);
    for (const ContactVector::Part& part : c.n.part) {
      if (part.tree < 0) continue;
      standing.rounding[part.tree] = std::max(standing.rounding[part.tree], size);
    }
  }
}

/// True where the tree moved by rounding in the step, and would in the next.
bool moves_by_rounding(const Scene& scene, std::size_t list, const State& start, const Node& node,
                       const Standing& standing) {
  const double length = standing.rounding[list];
  if (!(length > 0)) return false;
  for (const int c : scene.trees.of[list]) {
    const double most = standing.is_length[c] ? length : turn_rounding;
    if (!(scene.options.h * std::abs(node.v[c]) <= most)) return false;
  }
  const double most = std::max(length, turn_rounding);
  return std::all_of(standing.places[list].begin(), standing.places[list].end(),
                     [&](int k) { return std::abs(node.q[k] - start.q[k]) <= most; });
}

void begin(const std::vector<int>& places, const VecX& x, Standing::Path& path) {
  for (const int k : places) path.first[k] = path.last[k] = x[k], path.length[k] = 0;
}

void go_on(const std::vector<int>& places, const VecX& x, Standing::Path& path) {
  for (const int k : places) {
    path.length[k] += std::abs(x[k] - path.last[k]);
    path.last[k] = x[k];
  }
}

/// True where x has turned round, and so is nearer to where it was than its path is long, or has
/// not moved at all.
/// @param none moves that are none
bool has_turned(const std::vector<int>& places, const Standing::Path& path, double none) {
  return std::all_of(places.begin(), places.end(), [&](int k) {
    return std::abs(path.last[k] - path.first[k]) <= std::max(0.9 * path.length[k], none);
  });
}

/// One more step that moved it by rounding.
void watch(const Scene& scene, std::size_t list, const Node& node, Standing& standing) {
  const std::vector<int>&places = standing.places[list], &velocities = scene.trees.of[list];
  int& steps = standing.steps[list];
  if (steps == 0) {
    begin(places, node.q, standing.q);
    begin(velocities, node.v, standing.v);
  } else {
    go_on(places, node.q, standing.q);
    go_on(velocities, node.v, standing.v);
  }
  if (++steps <= steps_watched) return;
  const double none = part_of_rounding * std::min(standing.rounding[list], turn_rounding);
  standing.stands[list] = has_turned(places, standing.q, none) &&
                          has_turned(velocities, standing.v, none / scene.options.h);
  steps = 0;
}

/// Where velocities write in q, each once.
std::vector<int> places_of(const Tree& tree, const std::vector<int>& velocities) {
  std::vector<int> out;
  for (const int c : velocities) out.push_back(tree.coordinate[c]);
  for (const Ball& ball : tree.balls) {
    if (std::find(out.begin(), out.end(), ball.coordinate) == out.end()) continue;
    for (int k = 1; k < 4; ++k) out.push_back(ball.coordinate + k);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

Standing::Standing(const Scene& scene) {
  const Tree& tree = scene.model.tree;
  const std::size_t lists = scene.trees.of.size();
  const bool has_functions =
      !scene.model.forces.functions.empty() || !scene.model.mass.potentials.functions.empty();
  is_timeless = !has_functions && scene.model.equalities.rows == 0;
  steps.resize(lists);
  stands.resize(lists);
  rounding.resize(lists);
  for (const std::vector<int>& each : scene.trees.of) places.push_back(places_of(tree, each));
  is_length.assign(static_cast<std::size_t>(tree.n_v), 0);
  for (int i = 0; i < tree.joints(); ++i) {
    if (!tree.joint[i].turns()) is_length[tree.drive[i].velocity] = 1;
  }
  for (VecX* x : {&q.first, &q.last, &q.length}) x->setZero(tree.n_q);
  for (VecX* x : {&v.first, &v.last, &v.length}) x->setZero(tree.n_v);
}

void forget(Standing& standing) {
  std::fill(standing.steps.begin(), standing.steps.end(), 0);
  std::fill(standing.stands.begin(), standing.stands.end(), 0);
  standing.steps_on = false;
}

void stand_still(const Scene& scene, const State& start, const HalfKick& kick, Node& node,
                 Standing& standing) {
  standing.steps_on = false;
  if (!standing.is_timeless || kick.contacts.empty() || !node.has_factors) return;
  find_held(kick, node, standing);
  for (std::size_t list = 0; list < standing.stands.size(); ++list) {
    if (!moves_by_rounding(scene, list, start, node, standing)) {
      standing.steps[list] = standing.stands[list] = 0;
      continue;
    }
    if (!standing.stands[list]) watch(scene, list, node, standing);
    if (!standing.stands[list]) continue;
    for (const int k : standing.places[list]) node.q[k] = start.q[k];
    for (const int c : scene.trees.of[list]) node.p[c] = node.v[c] = 0;
  }
  standing.steps_on = node.q == start.q && node.p == start.p;
}

}  // namespace saltus
