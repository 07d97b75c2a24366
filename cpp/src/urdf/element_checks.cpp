#include <algorithm>
#include <map>

#include "saltus/model/model.hpp"
#include "urdf/checks.hpp"
#include "urdf/joint_elements.hpp"
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

/// Where the joint's limits are not as URDF has them; it is then without that limit, or both.
void check_limits(const Document& document, const XMLElement& joint, Warnings& warnings) {
  const std::string type = attribute(joint, "type");
  if (type != "revolute" && type != "prismatic") return;
  const Owner owner{"joint", attribute(joint, "name")};
  const XMLElement* limit = joint.FirstChildElement("limit");
  const std::string place = document.at(limit == nullptr ? joint : *limit) + owner.show();
  if (limit == nullptr) {
    return warnings.add_flaw("no limit",
                             place + " is " + type +
                                 " and has no <limit>, which such a joint "
                                 "needs: <limit lower=\"-1\" upper=\"1\" effort=\"10\" "
                                 "velocity=\"1\"/>" +
                                 (type == "revolute" ? ", or type \"continuous\"" : ""),
                             "; it is read as unlimited", owner);
  }
  const bool has_lower = limit->Attribute("lower") != nullptr;
  const bool has_upper = limit->Attribute("upper") != nullptr;
  if (!has_lower || !has_upper) {
    const std::string what = has_lower ? "upper" : has_upper ? "lower" : "lower and upper";
    warnings.add_flaw("no " + what, place + " has a <limit> without " + what,
                      "; it is read as unlimited there", owner);
  }
  if (!are_crossed(*limit)) return;
  warnings.add_flaw("crossed limits",
                    place + " has lower limit " + attribute(*limit, "lower") + " and upper limit " +
                        attribute(*limit, "upper"),
                    "; it is read as unlimited", owner);
}

/// A mimic joint whose driver is not there, or does not move.
void check_mimic(const Document& document, const XMLElement& joint, Warnings& warnings) {
  const XMLElement* mimic = joint.FirstChildElement("mimic");
  if (mimic == nullptr) return;
  const Owner owner{"joint", attribute(joint, "name")};
  const std::string driver = attribute(*mimic, "joint"), place = document.at(*mimic) + owner.show();
  if (attribute(joint, "type") == "fixed") {  // what remains where a gripper was locked
    warnings.add("fixed mimic", place + " is fixed, so its <mimic> is not used");
  } else if (document.find("joint", driver) == nullptr) {
    const std::string kind = "unknown mimic";  // the names once, not for each of 10^4 joints
    const std::string names = warnings.has(kind) ? "" : list_names(document.names("joint"));
    warnings.add_flaw(kind,
                      place + " mimics joint " + in_quotes(driver) +
                          ", which does not exist; joints are " + names,
                      "; its <mimic> is not used", owner);
  } else if (const std::optional<double> value = locked_displacement(document, joint)) {
    warnings.add_flaw("locked mimic",
                      place + " mimics joint " + in_quotes(driver) + ", which is fixed",
                      "; it stands at " + print_number(*value), owner);
  }
}

void check_joint(const Document& document, const XMLElement& joint, Warnings& warnings) {
  const Owner owner{"joint", attribute(joint, "name")};
  const std::string type = attribute(joint, "type");
  const std::vector<std::string>& types = joint_types();
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    document.fail(joint, owner, "has type " + in_quotes(type) + "; types are " + list_names(types));
  }
  check_mimic(document, joint, warnings);
  const XMLElement* axis = joint.FirstChildElement("axis");
  if (has_axis(type) && axis != nullptr && is_zero(*axis, "xyz")) {
    document.fail(*axis, owner, "has zero axis");
  }
  check_limits(document, joint, warnings);
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
      warnings.add("no shape",
                   document.at(*c) + owner.show() + " has a <collision> without a shape");
    } else if (const XMLElement* second = shape->NextSiblingElement()) {
      warnings.add_flaw("two shapes",
                        document.at(*second) + owner.show() +
                            " has two shapes in one <geometry>, <" + shape->Name() + "> and <" +
                            second->Name() + ">; give each its own <collision>",
                        "; the first is used", owner);
    }
  }
}

/// Other readers take what is not there for 0.
void check_inertial(const Document& document, const XMLElement& link, const Owner& owner,
                    Warnings& warnings) {
  const XMLElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  const std::string place = document.at(*inertial) + owner.show();
  if (inertial->FirstChildElement("mass") == nullptr) {
    warnings.add_flaw("no mass", place + " has no <mass> in <inertial>", "; it is read as 0",
                      owner);
  }
  const XMLElement* inertia = inertial->FirstChildElement("inertia");
  if (inertia == nullptr) {
    return warnings.add_flaw("no inertia", place + " has no <inertia> in <inertial>",
                             "; it is read as a point mass", owner);
  }
  for (const char* product : {"ixy", "ixz", "iyz"}) {
    if (inertia->Attribute(product) != nullptr) continue;
    warnings.add_flaw("no product",
                      document.at(*inertia) + owner.show() + " has <inertia> without attribute " +
                          in_quotes(product),
                      "; it is read as 0", owner);
  }
}

void check_version(const Document& document, Warnings& warnings) {
  const std::string version = attribute(document.robot(), "version");
  for (const char* known : {"", "1", "1.0", "1.1", "1.2"}) {
    if (version == known) return;
  }
  warnings.add("version", document.at(document.robot()) + "URDF version " + in_quotes(version) +
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
    const Owner owner{"link", attribute(*link, "name")};
    check_inertial(document, *link, owner, warnings);
    check_collisions(document, *link, owner, warnings);
  }
  for (const XMLElement* joint : document.all("joint")) check_joint(document, *joint, warnings);
}

}  // namespace saltus::reader
