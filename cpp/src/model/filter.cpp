// Which links are let pass through each other: by pair, by group, by a joint between them.
#include <algorithm>

#include "model/assembly.hpp"

namespace saltus {

void Assembly::add_filter() {
  const FilterSpec& filter = d_.filter;
  const auto add_links = [&](const FilterSpec::Names& named, Pairs& pairs) {
    for (const auto& [first, second] : named) {
      const int a = link_index(first, "an exclusion names", "link", first);
      const int b = link_index(second, "an exclusion names", "link", second);
      pairs.insert(std::minmax(a, b));
    }
  };
  add_links(filter.links, excluded_);
  add_links(filter.bodies, excluded_bodies_);

  std::vector<std::string> groups;
  const auto find = [&](const std::string& group) {
    return static_cast<int>(std::find(groups.begin(), groups.end(), group) - groups.begin());
  };
  collision_group_.assign(d_.links.size(), -1);
  for (const auto& [link, group] : filter.group_of) {
    const int index = find(group);
    if (index == static_cast<int>(groups.size())) groups.push_back(group);
    const std::string user = "group " + quoted(group) + " names";
    collision_group_[link_index(link, user, "group", group)] = index;
  }
  for (const auto& [first, second] : filter.groups) {
    for (const std::string& group : {first, second}) {
      if (find(group) < static_cast<int>(groups.size())) continue;
      throw ModelError("an exclusion names group " + quoted(group) +
                           ", which no link is in; groups are " +
                           (groups.empty() ? "none" : list_names(groups)),
                       "group", group);
    }
    const int a = find(first), b = find(second);
    excluded_groups_.insert(std::minmax(a, b));
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
    const JointSpec& spec = d_.joints[joint];
    if (spec.type == JointType::floating || spec.type == JointType::planar) continue;
    for (const int parent : welded.at(group_[link_.at(spec.parent)])) {
      for (const int child : links) out.emplace_back(parent, child);
    }
  }
  for (const LoopSpec& loop : d_.loops) {  // they overlap there as at a joint
    if (loop.type != LoopType::point && loop.type != LoopType::weld) continue;
    for (const int a : welded.at(group_[link_.at(loop.a.link)])) {
      for (const int b : welded.at(group_[link_.at(loop.b.link)])) out.emplace_back(a, b);
    }
  }
  return out;
}

}  // namespace saltus
