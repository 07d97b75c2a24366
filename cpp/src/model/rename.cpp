// A description under other names.
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
  for (LoopSpec& loop : d.loops) {
    for (std::string* name : {&loop.name, &loop.a.link, &loop.b.link}) rename(*name);
  }
  for (CouplingSpec& coupling : d.couplings) rename(coupling.joint), rename(coupling.of);
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

}  // namespace saltus
