#include "urdf/actuators.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <sstream>

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

namespace {

/// Of stiffness and rest, or of a curve.
void add_joint_spring(const Document& document, const XMLElement& e, const Owner& owner,
                      ModelBuilder& builder) {
  const bool has_curve = e.Attribute("angles") != nullptr || e.Attribute("forces") != nullptr;
  if (e.Attribute("slopes") != nullptr && !has_curve) {
    document.fail(e, owner, "has slopes, which are of a curve: angles and forces say it");
  }
  if (!has_curve) {
    if (e.Attribute("stiffness") == nullptr) return;
    builder.add_joint_spring(owner.name, number(e, "stiffness", 0), number(e, "rest", 0));
    return;
  }
  if (e.Attribute("stiffness") != nullptr || e.Attribute("rest") != nullptr) {
    document.fail(e, owner, "has a spring's curve, and a stiffness or rest besides");
  }
  std::optional<std::array<double, 2>> slopes;
  const std::vector<double> ends = numbers(document, e, owner, "slopes");
  if (!ends.empty()) slopes = {ends[0], ends[1]};
  builder.add_joint_spring(owner.name, numbers(document, e, owner, "angles"),
                           numbers(document, e, owner, "forces"), slopes);
}

void set_joint(const Document& document, const XMLElement& e, const Owner& owner,
               ModelBuilder& builder) {
  const std::string& name = owner.name;
  if (e.Attribute("armature")) builder.set_armature(name, number(e, "armature", 0));
  if (e.Attribute("damping")) builder.set_damping(name, number(e, "damping", 0));
  if (e.Attribute("friction")) builder.set_friction(name, number(e, "friction", 0));
  add_joint_spring(document, e, owner, builder);
  if (e.Attribute("limit_restitution")) {
    builder.set_limit_restitution(name, number(e, "limit_restitution", 0));
  }
}

/// Affine in the sum of ratio times displacement over its joints.
void add_any_actuator(const Document& document, const XMLElement& e, const Owner& owner,
                      ModelBuilder& builder) {
  ActuatorSpec spec;
  spec.name = owner.name;
  spec.gain = number(e, "gain", 1);
  const std::vector<double> ratios = numbers(document, e, owner, "ratios");
  std::istringstream words(attribute(e, "joints"));
  for (std::string joint; words >> joint;) {
    const std::size_t k = spec.joints.size();
    spec.joints.emplace_back(joint, k < ratios.size() ? ratios[k] : 1);
  }
  if (!ratios.empty() && ratios.size() != spec.joints.size()) {
    document.fail(e, owner,
                  "has " + std::to_string(ratios.size()) + " ratios for " +
                      counted(static_cast<long>(spec.joints.size()), "joint") +
                      "; they are equally many, or none where all are 1");
  }
  const Vec3 bias = vector(e, "bias", Vec3::Zero());
  spec.bias = bias[0];
  spec.bias_l = bias[1];
  spec.bias_v = bias[2];
  spec.effort = number(e, "effort", infinity);
  const std::vector<double> control = numbers(document, e, owner, "control");
  if (!control.empty()) {
    spec.lower = control[0];
    spec.upper = control[1];
  }
  builder.add_actuator(spec);
}

}  // namespace

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
      set_joint(document, e, {kind, name}, builder);
    } else if (kind == "actuator") {
      add_any_actuator(document, e, {kind, name}, builder);
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
    if (std::string(error.what()).find(document.at(e)) == 0) throw;
    throw ModelError(document.at(e) + error.what(), error.element, error.name);
  }
  return true;
}

}  // namespace saltus::reader
