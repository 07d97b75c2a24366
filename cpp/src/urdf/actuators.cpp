#include "urdf/actuators.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "urdf/attributes.hpp"

namespace saltus::reader {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Text of a child element, or its attribute `name`.
std::string child_name(const XMLElement& element, const char* child) {
  const XMLElement* found = element.FirstChildElement(child);
  return found == nullptr ? "" : attribute(*found, "name");
}

std::string kind_of(const XMLElement& transmission) {
  const XMLElement* type = transmission.FirstChildElement("type");
  if (type != nullptr && type->GetText() != nullptr) return type->GetText();
  return attribute(transmission, "type");
}

/// "transmission_interface/SimpleTransmission", and the older "pr2_mechanism_model/Simple...".
bool is_simple(const std::string& kind) {
  return kind.empty() || kind.find("SimpleTransmission") != std::string::npos;
}

/// Why it is no motor; "" where it is one.
std::string obstacle(const XMLElement& transmission, const std::string& joint,
                     const ModelDescription& d) {
  const std::string kind = kind_of(transmission);
  if (!is_simple(kind)) return "is of type " + in_quotes(kind);
  const XMLElement* first = transmission.FirstChildElement("joint");
  if (first == nullptr) return "names no joint";
  if (first->NextSiblingElement("joint") != nullptr) return "is of several joints";
  const auto found = std::find_if(d.joints.begin(), d.joints.end(),
                                  [&](const JointSpec& each) { return each.name == joint; });
  if (found == d.joints.end()) return "names joint " + in_quotes(joint) + ", which does not exist";
  const JointType type = found->type;
  const bool moves =
      type == JointType::revolute || type == JointType::continuous || type == JointType::prismatic;
  return moves ? "" : "moves joint " + in_quotes(joint) + ", which has not one coordinate";
}

/// Actuators of one name get their joint's: some files name them all "motor".
std::string free_name(std::string name, const std::string& joint, const ModelDescription& d) {
  const auto is_taken = [&](const std::string& other) {
    if (std::count(other_sources.begin(), other_sources.end(), other) > 0) return true;
    return std::any_of(d.actuators.begin(), d.actuators.end(),
                       [&](const ActuatorSpec& each) { return each.name == other; });
  };
  if (name.empty() || is_taken(name)) name = joint;
  while (is_taken(name)) name += "_";
  return name;
}

}  // namespace

void add_transmissions(const Document& document, ModelBuilder& builder) {
  std::vector<std::string> unused;
  std::set<std::string> driven;
  for (const XMLElement* e : document.all("transmission")) {
    const std::string joint = child_name(*e, "joint");
    const std::string why = obstacle(*e, joint, builder.description());
    if (!why.empty()) {
      unused.push_back(in_quotes(attribute(*e, "name")) + " " + why);
      continue;
    }
    if (!driven.insert(joint).second) continue;  // of one joint and several interfaces
    builder.add_motor(free_name(child_name(*e, "actuator"), joint, builder.description()), joint);
  }
  if (unused.empty()) return;
  builder.add_warning(std::to_string(unused.size()) + " of the transmissions " +
                      (unused.size() == 1 ? "is no motor: " : "are no motors: ") +
                      list_names(unused) + "; add_actuator of a ModelBuilder adds others");
}

bool add_force_element(const Document& document, const XMLElement& e, ModelBuilder& builder) {
  const std::string kind = e.Name(), name = attribute(e, "name");
  const std::string joint = attribute(e, "joint");
  const double effort = number(e, "effort", infinity);
  try {
    if (kind == "motor") {
      builder.add_motor(name, joint, number(e, "gear", 1), effort);
    } else if (kind == "position_servo") {
      builder.add_position_servo(name, joint, number(e, "kp", 0), number(e, "kd", 0), effort);
    } else if (kind == "velocity_servo") {
      builder.add_velocity_servo(name, joint, number(e, "kv", 0), effort);
    } else if (kind == "joint") {
      if (e.Attribute("armature")) builder.set_armature(name, number(e, "armature", 0));
      if (e.Attribute("damping")) builder.set_damping(name, number(e, "damping", 0));
      if (e.Attribute("friction")) builder.set_friction(name, number(e, "friction", 0));
      if (e.Attribute("stiffness")) {
        builder.add_joint_spring(name, number(e, "stiffness", 0), number(e, "rest", 0));
      }
      if (e.Attribute("limit_restitution")) {
        builder.set_limit_restitution(name, number(e, "limit_restitution", 0));
      }
    } else if (kind == "spring") {
      builder.add_spring({name, end_on(e, "link1", "xyz1", "rpy1"),
                          end_on(e, "link2", "xyz2", "rpy2"), number(e, "stiffness", 0),
                          number(e, "length", 0), number(e, "damping", 0)});
    } else if (kind == "gravity_compensation") {
      builder.set_gravity_compensation(attribute(e, "link"), number(e, "part", 1));
    } else {
      return false;
    }
  } catch (const ModelError& error) {
    throw ModelError(document.at(e) + error.what(), error.element, error.name);
  }
  return true;
}

}  // namespace saltus::reader
