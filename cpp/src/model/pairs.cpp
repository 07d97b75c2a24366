// Shapes in joint frames, and which pairs of them are watched.
#include <algorithm>
#include <map>

#include "model/assembly.hpp"

namespace saltus {

void Assembly::add_shapes() {
  std::map<std::string, int> count;
  for (const ShapeSpec& spec : d_.shapes) {
    const int link =
        link_index(spec.link, "a " + shape_name(spec.shape) + " is put on", "link", spec.link);
    const Place& place = place_[link];
    if (std::holds_alternative<HalfSpace>(spec.shape) && place.joint >= 0) {
      throw ModelError("link " + quoted(spec.link) + " carries half-space " + quoted(spec.name) +
                           " and moves; half-spaces are fixed to the world",
                       "link", spec.link);
    }
    std::string name = spec.name.empty() ? spec.link : spec.name;
    if (const int k = ++count[name]; k > 1) name.append("#").append(std::to_string(k));
    m_.shapes.push_back({spec.shape, place.joint, place.X_JF * spec.X_LG, link, name, spec.X_LG});
  }
  add_filter();
  add_materials();
}

// By link, so that the few shapes of two links are looked at, not all pairs of shapes.
void Assembly::add_pairs() {
  std::map<int, std::vector<int>> on_link;
  PairRules rules;
  for (int i = 0; i < static_cast<int>(m_.shapes.size()); ++i) {
    on_link[m_.shapes[i].link].push_back(i);
    rules.group.push_back(collision_group_[m_.shapes[i].link]);
  }
  const auto is_floor = [&](int i) {
    return std::holds_alternative<HalfSpace>(m_.shapes[i].shape);
  };
  const auto exclude = [&](int link_a, int link_b, bool floors) {
    for (const int i : on_link[link_a]) {
      for (const int j : on_link[link_b]) {
        if (floors || !(is_floor(i) || is_floor(j))) rules.excluded.emplace_back(i, j);
      }
    }
  };
  rules.excluded_groups.assign(excluded_groups_.begin(), excluded_groups_.end());
  for (const auto& [a, b] : excluded_) exclude(a, b, true);
  for (const auto& [a, b] : excluded_bodies_) exclude(a, b, false);
  if (d_.filter.adjacent == AdjacentLinks::excluded) {
    for (const auto& [a, b] : adjacent_links()) exclude(a, b, false);
  }
  m_.pairs = PairTable(m_.shapes, rules);
}

}  // namespace saltus
