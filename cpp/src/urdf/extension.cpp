#include "urdf/extension.hpp"

#include "urdf/attributes.hpp"

namespace saltus::reader {
namespace {

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
  } else if (kind == "ellipsoid") {
    builder.add_shape(link(document, element, "link"),
                      Ellipsoid{vector(element, "radii", Vec3::Zero())}, origin(element));
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

std::map<std::string, MeshUse> mesh_uses(const Document& document) {
  const std::map<std::string, MeshUse> uses = {{"hull", MeshUse::hull}, {"none", MeshUse::none}};
  std::map<std::string, MeshUse> found;
  for (const XMLElement* block : document.all("saltus")) {
    for (auto e = block->FirstChildElement("mesh"); e; e = e->NextSiblingElement("mesh")) {
      const Owner owner{"mesh", ""};
      const std::string use = attribute(*e, "use"), of = link(document, *e, "link");
      if (uses.count(use) == 0) {
        document.fail(*e, owner, "has use=" + in_quotes(use) + "; known are hull, none");
      }
      if (!found.emplace(of, uses.at(use)).second) {
        document.fail(*e, owner, "is the second for link " + in_quotes(of));
      }
    }
  }
  return found;
}

}  // namespace saltus::reader
