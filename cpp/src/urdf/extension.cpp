#include "urdf/extension.hpp"

#include "urdf/numbers.hpp"
#include "urdf/rewrite.hpp"

namespace saltus::reader {
namespace {

double number(const XMLElement& element, const char* name, double otherwise) {
  const std::vector<double> values = parse_numbers(attribute(element, name)).values;
  return values.empty() ? otherwise : values.front();
}

Vec3 vector(const XMLElement& element, const char* name, const Vec3& otherwise) {
  const std::vector<double> values = parse_numbers(attribute(element, name)).values;
  return values.empty() ? otherwise : Vec3(values[0], values[1], values[2]);
}

Pose origin(const XMLElement& element) {
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return {};
  const std::vector<double> q = parse_numbers(attribute(*origin, "quat_xyzw")).values;
  const Vec3 rpy = vector(*origin, "rpy", Vec3::Zero());
  return {q.empty() ? rotation_from_rpy(rpy[0], rpy[1], rpy[2]) : rotation_from_quaternion(q),
          vector(*origin, "xyz", Vec3::Zero())};
}

std::string link(const Document& document, const XMLElement& element, const char* name) {
  const std::string link = attribute(element, name);
  if (document.find("link", link) == nullptr) {
    document.fail(element, {element.Name(), ""},
                  "names link " + in_quotes(link) + ", which does not exist; links are " +
                      list_names(document.names("link")));
  }
  return link;
}

void add_half_space(const Document& document, const XMLElement& element, ModelBuilder& builder) {
  const std::string name = attribute(element, "name");
  const Owner owner{"half_space", name};
  const Vec3 normal = vector(element, "normal", Vec3::UnitZ());
  if (normal.norm() == 0) document.fail(element, owner, "has zero normal");
  if (document.find("half_space", name) != &element) {
    document.fail(element, owner,
                  name.empty() ? "is the second without a name; give it one"
                               : "has the name of another half_space");
  }
  builder.add_half_space(name.empty() ? "half_space" : name, normal, number(element, "offset", 0));
}

void add(const Document& document, const XMLElement& element, ModelBuilder& builder) {
  const std::string kind = element.Name();
  if (kind == "half_space") {
    add_half_space(document, element, builder);
  } else if (kind == "capsule") {
    builder.add_shape(link(document, element, "link"),
                      Capsule{number(element, "radius", 0), 0.5 * number(element, "length", 0)},
                      origin(element));
  } else if (kind == "exclude") {
    builder.add_exclusion(link(document, element, "link1"), link(document, element, "link2"));
  }
}

}  // namespace

void add_extension(const Document& document, ModelBuilder& builder) {
  for (const XMLElement* block : document.all("saltus")) {
    for (auto e = block->FirstChildElement(); e; e = e->NextSiblingElement()) {
      add(document, *e, builder);
    }
  }
}

}  // namespace saltus::reader
