#include <algorithm>
#include <map>

#include "saltus/model/model.hpp"
#include "urdf/checks.hpp"
#include "urdf/numbers.hpp"

namespace saltus::reader {
namespace {

const std::vector<std::string>& joint_types() {
  static const std::vector<std::string> types = {"revolute", "continuous", "prismatic", "fixed",
                                                 "floating", "planar",     "spherical", "ball"};
  return types;
}

void check_names(const Document& document, const char* element) {
  std::map<std::string, const XMLElement*> seen;
  for (const XMLElement* e : document.all(element)) {
    const std::string name = attribute(*e, "name");
    const auto [first, is_new] = seen.emplace(name, e);
    if (is_new) continue;
    throw ModelError(document.at(*e) + "two " + element + "s are named " + in_quotes(name) +
                         "; the first is in line " + std::to_string(first->second->GetLineNum()),
                     element, name);
  }
}

bool is_zero(const XMLElement& element, const char* name) {
  const std::vector<double> values = parse_numbers(attribute(element, name)).values;
  return std::all_of(values.begin(), values.end(), [](double x) { return x == 0; });
}

void check_joint(const Document& document, const XMLElement& joint, Warnings& warnings) {
  const Owner owner{"joint", attribute(joint, "name")};
  const std::string type = attribute(joint, "type");
  const std::vector<std::string>& types = joint_types();
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    document.fail(joint, owner, "has type " + in_quotes(type) + "; types are " + list_names(types));
  }
  const XMLElement* mimic = joint.FirstChildElement("mimic");
  if (type == "fixed" && mimic != nullptr) {  // what remains where a gripper was locked
    warnings.push_back(document.at(*mimic) + owner.show() +
                       " is fixed, so its <mimic> is not used");
  }
  const XMLElement* axis = joint.FirstChildElement("axis");
  if (has_axis(type) && axis != nullptr && is_zero(*axis, "xyz")) {
    document.fail(*axis, owner, "has zero axis");
  }
  const bool limited = type == "revolute" || type == "prismatic";
  if (limited && joint.FirstChildElement("limit") == nullptr) {
    document.fail(joint, owner,
                  "is " + type + " and has no <limit>, which such a joint needs: " +
                      "<limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"1\"/>" +
                      (type == "revolute" ? ", or type \"continuous\"" : ""));
  }
}

/// Of every `<origin>` below an element that owns some.
void check_origins(const Document& document, const XMLElement& parent, const Owner& owner) {
  for (auto e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (e->Name() != std::string("origin")) {
      check_origins(document, *e, owner);
    } else if (e->Attribute("quat_xyzw") != nullptr) {
      if (e->Attribute("rpy") != nullptr) {
        document.fail(*e, owner, "has <origin> with both rpy and quat_xyzw; give one");
      }
      if (is_zero(*e, "quat_xyzw")) document.fail(*e, owner, "has <origin> with zero quat_xyzw");
    }
  }
}

void check_collisions(const Document& document, const XMLElement& link, const Owner& owner,
                      Warnings& warnings) {
  for (auto c = link.FirstChildElement("collision"); c; c = c->NextSiblingElement("collision")) {
    const XMLElement* geometry = c->FirstChildElement("geometry");
    const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr) {
      warnings.push_back(document.at(*c) + owner.show() + " has a <collision> without a shape");
    } else if (const XMLElement* second = shape->NextSiblingElement()) {
      document.fail(*second, owner,
                    "has two shapes in one <geometry>, <" + std::string(shape->Name()) + "> and <" +
                        second->Name() + ">; give each its own <collision>");
    }
  }
}

void check_version(const Document& document, Warnings& warnings) {
  const std::string version = attribute(document.robot(), "version");
  for (const char* known : {"", "1", "1.0", "1.1", "1.2"}) {
    if (version == known) return;
  }
  warnings.push_back(document.at(document.robot()) + "URDF version " + in_quotes(version) +
                     " is read as 1.2, the latest that is known");
}

}  // namespace

bool is_spherical(const std::string& joint_type) {
  return joint_type == "spherical" || joint_type == "ball";
}

bool has_axis(const std::string& joint_type) {
  return joint_type != "fixed" && joint_type != "floating" && !is_spherical(joint_type);
}

void check_elements(const Document& document, Warnings& warnings) {
  check_version(document, warnings);
  for (const char* element : {"link", "joint"}) {
    check_names(document, element);
    for (const XMLElement* e : document.all(element)) {
      check_origins(document, *e, {element, attribute(*e, "name")});
    }
  }
  for (const XMLElement* block : document.all("saltus"))
    check_origins(document, *block, {"saltus", ""});
  for (const XMLElement* link : document.all("link")) {
    check_collisions(document, *link, {"link", attribute(*link, "name")}, warnings);
  }
  for (const XMLElement* joint : document.all("joint")) check_joint(document, *joint, warnings);
}

}  // namespace saltus::reader
