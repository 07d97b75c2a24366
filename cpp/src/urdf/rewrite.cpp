#include "urdf/rewrite.hpp"

#include <cmath>

#include "urdf/attributes.hpp"
#include "urdf/checks.hpp"
#include "urdf/joint_elements.hpp"
#include "urdf/numbers.hpp"
#include "urdf/schema.hpp"
#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

using tinyxml2::XMLPrinter;

std::string print_numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    text += print_number(std::isinf(value) ? std::copysign(no_limit, value) : value);
  }
  return text;
}

/// Roll, pitch, yaw of Rz(yaw) Ry(pitch) Rx(roll); by atan2, which keeps all digits at pitch +-90.
std::vector<double> rpy_from_quaternion(const std::vector<double>& xyzw) {
  const Mat3 R = rotation_from_quaternion(xyzw);
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  // where cos_pitch vanishes, this is any angle; roll is then taken from what it leaves
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const double s = std::sin(yaw), c = std::cos(yaw);
  return {std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)),
          std::atan2(-R(2, 0), cos_pitch), yaw};
}

void write_attributes(XMLPrinter& printer, const XMLElement& element, const ElementRule& rule) {
  for (const TextRule& text : rule.texts) {
    const char* value = element.Attribute(text.name);
    if (value != nullptr) printer.PushAttribute(text.name, value);
  }
  for (const NumberRule& number : rule.numbers) {
    const char* value = element.Attribute(number.name);
    if (value == nullptr) continue;
    std::vector<double> values = parse_numbers(value).values;
    values.resize(std::min(values.size(), number.count));
    if (number.name == std::string("quat_xyzw")) {
      printer.PushAttribute("rpy", print_numbers(rpy_from_quaternion(values)).c_str());
    } else {
      printer.PushAttribute(number.name, print_numbers(values).c_str());
    }
  }
}

void write(XMLPrinter& printer, const XMLElement& element, const ElementRule& rule);

void write_children(XMLPrinter& printer, const XMLElement& element, const ElementRule& rule) {
  for (auto e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const ElementRule* known = rule.child(e->Name());
    if (known != nullptr) write(printer, *e, *known);
  }
}

/// All parts, as urdfdom wants them; those that are not there are 0.
void write_inertial(XMLPrinter& printer, const XMLElement& inertial) {
  const auto put = [&](const char* name, const std::vector<const char*>& attributes) {
    const XMLElement* element = inertial.FirstChildElement(name);
    printer.OpenElement(name);
    for (const char* each : attributes) {
      const double value = element == nullptr ? 0 : number(*element, each, 0);
      printer.PushAttribute(each, print_number(value).c_str());
    }
    printer.CloseElement();
  };
  put("mass", {"value"});
  put("inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
}

/// Null: the joint has none. What is not there, or not as URDF has it, is no limit.
void write_limit(XMLPrinter& printer, const XMLElement* limit) {
  printer.OpenElement("limit");
  for (const char* name : {"lower", "upper", "effort", "velocity"}) {
    const bool is_position = name[0] == 'l' || name[0] == 'u';
    const bool is_given = limit != nullptr && limit->Attribute(name) != nullptr;
    if (is_given && !(is_position && are_crossed(*limit))) {
      const Numbers numbers = parse_numbers(attribute(*limit, name));
      printer.PushAttribute(name, print_numbers(numbers.values).c_str());
    } else {
      printer.PushAttribute(name, print_number(name[0] == 'l' ? -no_limit : no_limit).c_str());
    }
  }
  printer.CloseElement();
}

void write_joint(XMLPrinter& printer, const XMLElement& joint, const ElementRule& rule) {
  const std::string type = attribute(joint, "type");
  printer.PushAttribute("name", attribute(joint, "name").c_str());
  printer.PushAttribute("type", is_spherical(type) ? "floating" : type.c_str());
  if (joint.FirstChildElement("limit") == nullptr) write_limit(printer, nullptr);
  write_children(printer, joint, rule);
}

/// Shapes are read from the document: urdfdom knows but few, and only counts them.
void write_stand_in(XMLPrinter& printer) {
  printer.OpenElement("sphere");
  printer.PushAttribute("radius", "1");
  printer.CloseElement();
}

void write(XMLPrinter& printer, const XMLElement& element, const ElementRule& rule) {
  const std::string name = rule.name;
  if (name == "collision" && usable_shape(element) == nullptr) return;
  const bool has_dynamics = element.Attribute("damping") || element.Attribute("friction");
  if (name == "dynamics" && !has_dynamics) return;  // urdfdom would refuse it
  if (shape_in_geometry(name) != nullptr) return write_stand_in(printer);
  if (name == "limit") return write_limit(printer, &element);
  printer.OpenElement(name.c_str());
  if (name == "joint") {
    write_joint(printer, element, rule);
  } else if (name == "inertial") {
    const XMLElement* origin = element.FirstChildElement("origin");
    if (origin != nullptr) write(printer, *origin, *rule.child("origin"));
    write_inertial(printer, element);
  } else {
    write_attributes(printer, element, rule);
    write_children(printer, element, rule);
  }
  printer.CloseElement();
}

}  // namespace

Mat3 rotation_from_quaternion(const std::vector<double>& xyzw) {
  Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  q.coeffs() /= q.coeffs().cwiseAbs().maxCoeff();  // so that no square under- or overflows
  return q.normalized().toRotationMatrix();
}

const XMLElement* usable_shape(const XMLElement& collision) {
  const XMLElement* geometry = collision.FirstChildElement("geometry");
  const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  return shape == nullptr || shape_in_geometry(shape->Name()) == nullptr ? nullptr : shape;
}

std::string rewrite(const Document& document) {
  XMLPrinter printer(nullptr, true);
  printer.OpenElement("robot");
  printer.PushAttribute("name", "robot");  // URDF asks for one; ours is read from the document
  for (const char* element : {"link", "joint"}) {
    for (const XMLElement* e : document.all(element)) {
      write(printer, *e, *schema().child(element));
    }
  }
  printer.CloseElement();
  return {printer.CStr(), static_cast<std::size_t>(printer.CStrSize() - 1)};
}

}  // namespace saltus::reader
