// Which links are let pass through each other: by pair, by group, by a joint between them.
#include <algorithm>

#include "model/assembly.hpp"

namespace saltus {

void Assembly::add_filter() {
  const ModelBuilder::Filter& filter = b_.filter_;
  const auto add_links = [&](const std::vector<ModelBuilder::Exclusion>& named, Pairs& pairs) {
    for (const ModelBuilder::Exclusion& exclusion : named) {
      const int a = link_index(exclusion.a, "an exclusion names", "link", exclusion.a);
      const int b = link_index(exclusion.b, "an exclusion names", "link", exclusion.b);
      pairs.insert(std::minmax(a, b));
    }
  };
  add_links(filter.links, excluded_);
  add_links(filter.bodies, excluded_bodies_);

  std::vector<std::string> groups;
  const auto find = [&](const std::string& group) {
    return static_cast<int>(std::find(groups.begin(), groups.end(), group) - groups.begin());
  };
  collision_group_.assign(b_.links_.size(), -1);
  for (const auto& [link, group] : filter.group_of) {
    const int index = find(group);
    if (index == static_cast<int>(groups.size())) groups.push_back(group);
    const std::string user = "group " + quoted(group) + " names";
    collision_group_[link_index(link, user, "group", group)] = index;
  }
  for (const ModelBuilder::Exclusion& exclusion : filter.groups) {
    for (const std::string& group : {exclusion.a, exclusion.b}) {
      if (find(group) < static_cast<int>(groups.size())) continue;
      throw ModelError("an exclusion names group " + quoted(group) +
                           ", which no link is in; groups are " +
                           (groups.empty() ? "none" : list_names(groups)),
                       "group", group);
    }
    const int a = find(exclusion.a), b = find(exclusion.b);
    excluded_groups_.insert(std::minmax(a, b));
  }
}

bool Assembly::is_excluded(int link_a, int link_b) const {
  if (excluded_.count(std::minmax(link_a, link_b)) > 0) return true;
  const int a = collision_group_[link_a], b = collision_group_[link_b];
  return a >= 0 && b >= 0 && excluded_groups_.count(std::minmax(a, b)) > 0;
}

bool Assembly::is_excluded_body(int link_a, int link_b) const {
  if (excluded_bodies_.count(std::minmax(link_a, link_b)) > 0) return true;
  return b_.filter_.adjacent == AdjacentLinks::excluded && is_adjacent(link_a, link_b);
}

// Links on both sides of one joint overlap at it by design. A free or planar joint is no such
// place, and a half-space is a floor to be fallen on.
bool Assembly::is_adjacent(int link_a, int link_b) const {
  const auto hangs_on = [&](int child, int parent) {
    const int joint = parent_joint_[group_[child]];
    if (joint < 0) return false;
    const JointSpec& spec = b_.joints_[joint];
    if (spec.type == JointType::floating || spec.type == JointType::planar) return false;
    return group_[link_.at(spec.parent)] == group_[parent];
  };
  return hangs_on(link_a, link_b) || hangs_on(link_b, link_a);
}

}  // namespace saltus
