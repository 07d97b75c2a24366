#include "variational/flight/first_hit.hpp"

#include <algorithm>
#include <cmath>

#include "collision/shapes/facts.hpp"
#include "saltus/collision/chord.hpp"
#include "variational/flight/sinking.hpp"

namespace saltus {
namespace {

/// [radius] Two places that are one.
constexpr double same_point = 1e-3;

/// The other place of two where an edge or a rim crosses a rim touches, or its hits are sought.
bool is_other_watched(const ModelData& model, int crossing, const Node& node) {
  using Place = RimCrossing::Place;
  const Place place = std::get<RimCrossing>(node.pool[crossing].kind).place;
  const bool is_first = place == Place::in || place == Place::left;
  const int number = node.pool.number(crossing) + (is_first ? 1 : -1);
  return !std::isinf(node.sunk_at(node.pool.slot_of(model, number)));
}

bool are_of_same_bodies(const Pair& x, const Pair& y) {
  const int a = y.on_a.joint, b = y.on_b.joint;
  return (x.on_a.joint == a && x.on_b.joint == b) || (x.on_a.joint == b && x.on_b.joint == a);
}

/// What was measured at the node says that the pair cannot close on the chord.
bool is_certified(double distance, const Pair& pair, double floor, const Flight& f) {
  return distance - (f.broad.motion[pair.a] + f.broad.motion[pair.b]) > floor;
}

bool is_clear_on_chord(const Scene& scene, const Pair& solid, int slot, const Node& node,
                       const Flight& f) {
  const int number = node.pool.solid_number(slot);
  const double distance = node.clearances.least(Clearances::solids, number, solid);
  if (is_certified(distance, solid, 0, f)) return true;
  if (node.clearances.most(Clearances::solids, number, solid) <= solid.touch) return false;
  const ChordHit hit = first_hit_on_chord(scene.model.tree, solid, node.q, f.dq, 0);
  return hit.outcome == ChordHit::Outcome::clear;
}

/// It closes by the arc's end already.
bool is_ahead(const Rows& rows, int slot) {
  const auto end = rows.ahead.begin() + rows.count_ahead;
  return std::any_of(rows.ahead.begin(), end, [&](const Contact& c) { return c.slot == slot; });
}

bool is_watched(const Node& node, const Flight& f, int slot) {
  if (f.skips.passes(slot) || std::isinf(node.sunk_at(slot))) return false;
  const int contact = node.contact_at(slot);
  if (contact < 0) return !is_ahead(f.work.rows, slot);
  return node.contacts[contact].motion != Contact::Motion::rests &&
         f.work.rows.of_contact[contact] < 0;
}

/// Of a pair that is watched.
void add_if_hit(const Scene& scene, int slot, const Node& node, Flight& f) {
  const int contact = node.contact_at(slot);
  const double level = contact < 0 ? press_below(node, slot) : floor_of(node, slot);
  const Pair& pair = node.pool[slot];
  const double reachable = pair.kind == PairKind::crossing ? 0 : level;  // edges meet at 0
  const double distance = node.clearances.least(Clearances::pairs, slot, pair);
  if (!pair.is_stop() && is_certified(distance, pair, reachable, f)) return;
  if (is_borne(slot, node)) {
    if (const std::optional<Hit> hit = sinking_hit(scene, slot, node, f)) f.hits.push_back(*hit);
    return;
  }
  const bool hops = contact >= 0 && dot(scene.trees, node.contacts[contact].n, f.dq) <= 0;
  // of edges the chord knows how far they are from each other, not on which side
  if (hops && pair.kind == PairKind::crossing) return f.hits.push_back({slot, 0, hops});
  const ChordHit hit = first_hit_on_chord(scene.model.tree, pair, node.q, f.dq, level);
  if (hit.outcome == ChordHit::Outcome::clear || !(hit.s < 2)) return;
  f.hits.push_back({slot, hit.s, hops});
}

}  // namespace

void find_hits(const Scene& scene, const Node& node, Flight& f) {
  const ModelData& model = scene.model;
  f.hits.clear();
  if (!model.has_gaps()) return;
  f.dq = f.work.arc.tau * f.work.arc.v;
  for (int slot = 0; slot < node.pool.limits(); ++slot) {
    if (is_watched(node, f, slot)) add_if_hit(scene, slot, node, f);
  }
  if (model.pairs.empty()) return;
  double margin = 0;
  find_candidates(model.tree, model.shapes, model.pairs, node.kin, f.dq, margin, f.broad);
  const Pair* solid = nullptr;
  bool is_clear = false;
  double coordinate = 0;  // of the two bodies, whose parts follow each other
  for (const int number : f.broad.candidates) {
    const int slot = node.pool.slot_of(model, number);
    const Pair* of_parts = node.pool.solid(slot);
    if (of_parts == nullptr || of_parts != solid) {
      coordinate = largest_coordinate(scene, node.pool[slot], node);
    }
    if (of_parts != solid) {  // no part is nearer than the whole
      node.pool.know_ulps(slot, coordinate);
      solid = of_parts;
      is_clear = solid != nullptr && is_clear_on_chord(scene, *solid, slot, node, f);
    }
    if (is_clear || !is_watched(node, f, slot)) continue;
    node.pool.know_ulps(slot, coordinate);
    add_if_hit(scene, slot, node, f);
  }
}

std::optional<Hit> take_first(std::vector<Hit>& hits) {
  const auto sooner = [](const Hit& a, const Hit& b) { return a.s < b.s; };
  const auto first = std::min_element(hits.begin(), hits.end(), sooner);
  if (first == hits.end()) return std::nullopt;
  const Hit hit = *first;
  hits.erase(first);
  return hit;
}

bool grazes_with_axis(const Scene& scene, int end, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  const Pair& pair = node.pool[end];
  const auto* ball = std::get_if<Sphere>(&pair.on_a.shape);
  if (pair.kind != PairKind::corner || ball == nullptr || !(ball->radius > 0)) return false;
  place_end(model, work.arc.q_end, work.scratch);
  const Vec3 p_WA = pair_gap_at_end(model, pair, work.scratch).p_WA;
  for (const int i : work.rows.active) {
    const Row& row = work.rows.row[i];
    if (row.is_joint()) continue;
    const bool is_axis =
        node.pool.solid(row.slot) == node.pool.solid(end) && row.pair->kind == PairKind::crossing;
    if (!is_axis) continue;
    const Gap g = pair_gap_at_end(model, *row.pair, work.scratch);
    const double apart = std::min((g.p_WA - p_WA).norm(), (g.p_WB - p_WA).norm());
    if (apart < same_point * ball->radius) return true;
  }
  return false;
}

bool meets_beyond_ends(const Scene& scene, int slot, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  const Pair& pair = node.pool[slot];
  if (!std::holds_alternative<Crossing>(pair.kind)) return false;
  if (!(edge_capsule(pair.on_a.shape).radius + edge_capsule(pair.on_b.shape).radius > 0)) {
    return false;
  }
  place_end(model, work.arc.q_end, work.scratch);
  const Gap gap = pair_gap_at_end(model, pair, work.scratch);
  return is_silent(model.tree, work.scratch.kin_end, pair, gap);
}

bool is_of_other_parts(const Scene& scene, int rim, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  const Pair& pair = node.pool[rim];
  const auto* cylinder = std::get_if<Cylinder>(&pair.on_a.shape);
  if (!std::holds_alternative<Rim>(pair.kind) || cylinder == nullptr) return false;
  place_end(model, work.arc.q_end, work.scratch);
  const Gap gap = pair_gap_at_end(model, pair, work.scratch);
  const bool is_on_cap = gap.a.dim == 2;
  for (int i = 0; i < node.touching; ++i) {
    const Pair& other = node.pool[node.contacts[i].slot];
    if (!are_of_same_bodies(pair, other)) continue;
    const bool crosses = std::holds_alternative<RimCrossing>(other.kind);
    if (!crosses && !is_on_cap) continue;
    const Gap g = pair_gap_at_end(model, other, work.scratch);
    const bool is_there = (g.p_WA - gap.p_WA).norm() < same_point * cylinder->radius;
    if (is_there && (!crosses || is_other_watched(model, node.contacts[i].slot, node))) return true;
  }
  return false;
}

}  // namespace saltus
