// Shapes in joint frames, and which pairs of them are watched.
#include <algorithm>
#include <map>

#include "model/assembly.hpp"

namespace saltus {

void Assembly::add_shapes() {
  std::map<std::string, int> count;
  for (const ModelBuilder::ShapeSpec& spec : b_.shapes_) {
    const int link =
        link_index(spec.link, "a " + shape_name(spec.shape) + " is put on", "link", spec.link);
    const Place& place = place_[link];
    std::string name = spec.name.empty() ? spec.link : spec.name;
    if (const int k = ++count[name]; k > 1) name.append("#").append(std::to_string(k));
    m_.shapes.push_back({spec.shape, place.joint, place.X_JF * spec.X_LG, link, name});
  }
  for (const ModelBuilder::Exclusion& exclusion : b_.exclusions_) {
    const int a = link_index(exclusion.a, "an exclusion names", "link", exclusion.a);
    const int b = link_index(exclusion.b, "an exclusion names", "link", exclusion.b);
    excluded_.insert(std::minmax(a, b));
  }
}

// Links on both sides of one joint overlap at it by design. A free or planar joint is no such
// place, and a half-space is a floor to be fallen on.
std::vector<std::pair<int, int>> Assembly::adjacent_links() const {
  std::map<int, std::vector<int>> welded;  // links by the first of those welded together
  for (int i = 0; i < static_cast<int>(group_.size()); ++i) welded[group_[i]].push_back(i);
  std::vector<std::pair<int, int>> out;
  for (const auto& [first, links] : welded) {
    const int joint = parent_joint_[first];
    if (joint < 0) continue;
    const JointSpec& spec = b_.joints_[joint];
    if (spec.type == JointType::floating || spec.type == JointType::planar) continue;
    for (const int parent : welded[group_[link_.at(spec.parent)]]) {
      for (const int child : links) out.emplace_back(parent, child);
    }
  }
  return out;
}

// Shapes are sorted by link, so that the few links next to each are looked at, not all pairs.
void Assembly::add_pairs() {
  std::map<int, std::vector<int>> on_link;
  for (int i = 0; i < static_cast<int>(m_.shapes.size()); ++i) {
    on_link[m_.shapes[i].link].push_back(i);
  }
  PairRules rules;
  rules.group.assign(m_.shapes.size(), 0);
  const auto exclude = [&](int link_a, int link_b, bool floors) {
    for (const int i : on_link[link_a]) {
      for (const int j : on_link[link_b]) {
        const bool floor = std::holds_alternative<HalfSpace>(m_.shapes[i].shape) ||
                           std::holds_alternative<HalfSpace>(m_.shapes[j].shape);
        if (floors || !floor) rules.excluded.emplace_back(i, j);
      }
    }
  };
  for (const auto& [a, b] : excluded_) exclude(a, b, true);
  for (const auto& [a, b] : adjacent_links()) exclude(a, b, false);
  m_.pairs = PairTable(m_.shapes, rules);
}

}  // namespace saltus
