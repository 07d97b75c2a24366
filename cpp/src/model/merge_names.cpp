// Names of two descriptions that become one.
#include "model/merge_names.hpp"

#include <algorithm>

#include "model/assembly.hpp"

namespace saltus {
namespace {

using Contacts = std::map<std::pair<std::string, std::string>, ContactProperties>;

template <class Value>
std::map<std::string, Value> prefixed(const std::map<std::string, Value>& names,
                                      const std::string& prefix) {
  std::map<std::string, Value> out;
  for (const auto& [name, value] : names) out[prefix + name] = value;
  return out;
}

/// The first name that both have, as kind and name; {"", ""} where there is none.
std::pair<std::string, std::string> clash(const Names& ours, const Names& others,
                                          const std::string& prefix) {
  const auto find = [&](const std::set<std::string>& a, const std::set<std::string>& b) {
    const auto both =
        std::find_if(b.begin(), b.end(), [&](const auto& name) { return a.count(prefix + name); });
    return both == b.end() ? "" : prefix + *both;
  };
  const std::vector<std::pair<std::string, std::string>> found = {
      {"link", find(ours.links, others.links)},
      {"joint", find(ours.joints, others.joints)},
      {"half_space", find(ours.half_spaces, others.half_spaces)},
      {"group", find(ours.groups, others.groups)},
      {"actuator", find(ours.actuators, others.actuators)},
      {"spring", find(ours.springs, others.springs)},
      {"loop", find(ours.loops, others.loops)},
      {"state", find(ours.states, others.states)},
      {"sensor", find(ours.sensors, others.sensors)}};
  for (const auto& each : found) {
    if (!each.second.empty()) return each;
  }
  return {};
}

}  // namespace

void add_prefix(const AddSpec& how, ModelDescription& d) {
  const std::string& prefix = how.prefix;
  const auto rename = [&](std::string& name) { name.insert(0, prefix); };
  rename(d.root);
  for (LinkSpec& link : d.links) rename(link.name);
  for (JointSpec& joint : d.joints) {
    for (std::string* name : {&joint.name, &joint.parent, &joint.child}) rename(*name);
    if (joint.mimic) rename(joint.mimic->joint);
  }
  for (ActuatorSpec& actuator : d.actuators) {
    rename(actuator.name);
    for (auto& [joint, ratio] : actuator.joints) rename(joint);
  }
  for (SpringSpec& spring : d.springs) {
    for (std::string* name : {&spring.name, &spring.a.link, &spring.b.link}) rename(*name);
  }
  for (LoopSpec& loop : d.loops) {
    for (std::string* name : {&loop.name, &loop.a.link, &loop.b.link}) rename(*name);
  }
  for (CouplingSpec& coupling : d.couplings) rename(coupling.joint), rename(coupling.of);
  for (PrescribedSpec& spec : d.prescribed) rename(spec.joint);
  for (StateSpec& state : d.states) {
    rename(state.name);
    state.q = prefixed(state.q, prefix);
    state.v = prefixed(state.v, prefix);
  }
  for (SensorSpec& sensor : d.sensors) {
    rename(sensor.name);
    rename(sensor.of);
    if (!sensor.other.empty()) rename(sensor.other);
  }
  for (FilterSpec::Names* pairs : {&d.filter.links, &d.filter.bodies, &d.filter.groups}) {
    for (auto& [first, second] : *pairs) rename(first), rename(second);
  }
  d.filter.group_of = prefixed(d.filter.group_of, prefix);
  for (auto& [link, group] : d.filter.group_of) rename(group);
  for (ShapeSpec& shape : d.shapes) {
    rename(shape.link);
    if (!shape.name.empty()) rename(shape.name);
  }
  for (Visual& visual : d.visuals) rename(visual.link);
  d.materials.of_link = prefixed(d.materials.of_link, prefix);
  if (!how.own_materials) return;
  for (ShapeSpec& shape : d.shapes) {
    if (!shape.material.empty()) rename(shape.material);
  }
  for (auto& [link, material] : d.materials.of_link) rename(material);
  Contacts contact;
  for (const auto& [pair, properties] : d.materials.contact) {
    contact[std::minmax(prefix + pair.first, prefix + pair.second)] = properties;
  }
  d.materials.contact = std::move(contact);
}

Names names_of(const ModelDescription& d) {
  Names names;
  for (const LinkSpec& link : d.links) names.links.insert(link.name);
  for (const JointSpec& joint : d.joints) names.joints.insert(joint.name);
  for (const ShapeSpec& shape : d.shapes) {
    if (!shape.name.empty()) names.half_spaces.insert(shape.name);
  }
  for (const auto& [link, group] : d.filter.group_of) names.groups.insert(group);
  for (const ActuatorSpec& actuator : d.actuators) names.actuators.insert(actuator.name);
  for (const SpringSpec& spring : d.springs) names.springs.insert(spring.name);
  for (const LoopSpec& loop : d.loops) names.loops.insert(loop.name);
  for (const StateSpec& state : d.states) names.states.insert(state.name);
  for (const SensorSpec& sensor : d.sensors) names.sensors.insert(sensor.name);
  return names;
}

void check_names(const ModelDescription& ours, const ModelDescription& other,
                 const std::string& given) {
  const Names mine = names_of(ours), others = names_of(other);
  const auto [kind, name] = clash(mine, others, "");
  if (kind.empty()) return;
  std::string prefix = other.name + "_";
  for (int k = 2; !clash(mine, others, prefix).first.empty(); ++k) {
    prefix = other.name + "_" + std::to_string(k) + "_";
  }
  throw ModelError("both " + quoted(ours.name) + " and what is added have a " +
                       (kind == "half_space" ? "half-space" : kind) + " " + quoted(name) +
                       "; a prefix makes names differ, for example " + quoted(prefix + given),
                   kind, name);
}

}  // namespace saltus
