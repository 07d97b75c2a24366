#include "urdf/attributes.hpp"

#include "urdf/numbers.hpp"
#include "urdf/rewrite.hpp"

namespace saltus::reader {

double number(const XMLElement& element, const char* name, double otherwise) {
  const std::vector<double> values = parse_numbers(attribute(element, name)).values;
  return values.empty() ? otherwise : values.front();
}

Vec3 vector(const XMLElement& element, const char* name, const Vec3& otherwise) {
  const std::vector<double> values = parse_numbers(attribute(element, name)).values;
  return values.empty() ? otherwise : Vec3(values[0], values[1], values[2]);
}

std::vector<double> numbers(const Document& document, const XMLElement& element, const Owner& owner,
                            const char* name) {
  const Numbers numbers = parse_numbers(attribute(element, name));
  if (!numbers.bad.empty()) {
    document.fail(element, owner,
                  "has " + in_quotes(numbers.bad) + " in " + name + "; it is numbers");
  }
  return numbers.values;
}

Pose origin(const XMLElement& element) {
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return {};
  const std::vector<double> q = parse_numbers(attribute(*origin, "quat_xyzw")).values;
  const Vec3 rpy = vector(*origin, "rpy", Vec3::Zero());
  return {q.empty() ? rotation_from_rpy(rpy[0], rpy[1], rpy[2]) : rotation_from_quaternion(q),
          vector(*origin, "xyz", Vec3::Zero())};
}

At end_on(const XMLElement& element, const char* link, const char* xyz, const char* rpy) {
  const Vec3 angles = vector(element, rpy, Vec3::Zero());
  return {attribute(element, link),
          {rotation_from_rpy(angles[0], angles[1], angles[2]), vector(element, xyz, Vec3::Zero())}};
}

}  // namespace saltus::reader
