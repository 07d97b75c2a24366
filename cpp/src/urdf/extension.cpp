#include "urdf/extension.hpp"

#include <algorithm>
#include <sstream>

#include "urdf/actuators.hpp"
#include "urdf/attributes.hpp"
#include "urdf/loops.hpp"
#include "urdf/numbers.hpp"
#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

void check_link(const Document& document, const XMLElement& element, const Owner& owner,
                const std::string& link) {
  if (document.find("link", link) != nullptr) return;
  document.fail(element, owner,
                "names link " + in_quotes(link) + ", which does not exist; links are " +
                    list_names(document.names("link")));
}

std::string link(const Document& document, const XMLElement& element, const char* name) {
  const std::string link = attribute(element, name);
  check_link(document, element, {element.Name(), ""}, link);
  return link;
}

/// Of all elements of this kind in the blocks.
std::vector<std::string> names_in_blocks(const Document& document, const char* kind) {
  std::vector<std::string> names;
  for (const XMLElement* block : document.all("saltus")) {
    for (auto e = block->FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      names.push_back(attribute(*e, "name"));
    }
  }
  return names;
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

/// Two links, or two groups.
void add_exclusion(const Document& document, const XMLElement& element, ModelBuilder& builder) {
  const Owner owner{"exclude", ""};
  const bool of_groups = element.Attribute("group1") || element.Attribute("group2");
  const char *first = of_groups ? "group1" : "link1", *second = of_groups ? "group2" : "link2";
  for (const char* name : {first, second}) {
    if (attribute(element, name).empty()) {
      document.fail(element, owner, "is without attribute " + in_quotes(name));
    }
  }
  if (!of_groups) {
    builder.add_exclusion(link(document, element, first), link(document, element, second));
    return;
  }
  if (element.Attribute("link1") || element.Attribute("link2")) {
    document.fail(element, owner, "names links and groups; give each its own <exclude>");
  }
  for (const char* name : {first, second}) {
    if (document.find("group", attribute(element, name)) != nullptr) continue;
    const std::vector<std::string> groups = names_in_blocks(document, "group");
    document.fail(element, owner,
                  "names group " + in_quotes(attribute(element, name)) +
                      ", which does not exist; groups are " +
                      (groups.empty() ? "none" : list_names(groups)));
  }
  builder.add_group_exclusion(attribute(element, first), attribute(element, second));
}

using NameOf = std::map<std::string, std::string>;  // link -> group or material

/// The links that a group or a material lists; none is in two of a kind.
std::vector<std::string> listed_links(const Document& document, const XMLElement& element,
                                      NameOf& name_of) {
  const std::string kind = element.Name(), name = attribute(element, "name");
  const Owner owner{kind, name};
  std::vector<std::string> links;
  std::istringstream words(attribute(element, "links"));
  for (std::string of; words >> of;) {
    check_link(document, element, owner, of);
    const auto [first, is_new] = name_of.emplace(of, name);
    if (!is_new) {
      document.fail(element, owner,
                    "names link " + in_quotes(of) + ", which is in " + kind + " " +
                        in_quotes(first->second) + " already; a link is in one " + kind +
                        " at most");
    }
    links.push_back(of);
  }
  return links;
}

void add_group(const Document& document, const XMLElement& element, NameOf& group_of,
               ModelBuilder& builder) {
  const std::string name = attribute(element, "name");
  if (document.find("group", name) != &element) {
    document.fail(element, {"group", name}, "has the name of another group");
  }
  for (const std::string& of : listed_links(document, element, group_of)) {
    builder.set_group(of, name);
  }
}

/// Between two materials, or of all pairs that nothing else is said of.
void set_contact(const Document& document, const XMLElement& element, ModelBuilder& builder) {
  const Owner owner{"contact", ""};
  const std::string a = attribute(element, "material1"), b = attribute(element, "material2");
  const ContactProperties properties{number(element, "restitution", 1),
                                     number(element, "friction", 0)};
  if (!(properties.restitution >= 0 && properties.restitution <= 1)) {
    document.fail(element, owner,
                  "has restitution " + print_number(properties.restitution) + "; it is in [0, 1]");
  }
  if (!(properties.friction >= 0)) {
    document.fail(element, owner,
                  "has friction " + print_number(properties.friction) + "; it is not negative");
  }
  if (a.empty() != b.empty()) {
    document.fail(element, owner, "names one material; it names two, or none for all other pairs");
  }
  if (a.empty()) {
    builder.set_default_contact(properties);
    return;
  }
  const std::vector<std::string> known = names_in_blocks(document, "material");
  for (const std::string& name : {a, b}) {
    if (std::count(known.begin(), known.end(), name) > 0) continue;
    document.fail(element, owner,
                  "names material " + in_quotes(name) + ", which does not exist; materials are " +
                      list_names(known));
  }
  builder.set_contact(a, b, properties);
}

void set_adjacent_links(const Document& document, const XMLElement& element,
                        ModelBuilder& builder) {
  const std::string gaps = attribute(element, "gaps");
  if (gaps != "excluded" && gaps != "watched") {
    document.fail(element, {"adjacent_links", ""},
                  "has gaps=" + in_quotes(gaps) + "; known are excluded, watched");
  }
  builder.set_adjacent_links(gaps == "watched" ? AdjacentLinks::watched : AdjacentLinks::excluded);
}

struct NamesOf {
  NameOf group, material;
};

void add(const Document& document, const XMLElement& element, NamesOf& of, ModelBuilder& builder) {
  const std::string kind = element.Name();
  if (kind == "half_space") {
    add_half_space(document, element, builder);
  } else if (const ShapeElement* shape = shape_in_block(kind)) {
    builder.add_shape(link(document, element, "link"), shape->read(element), origin(element));
  } else if (kind == "exclude") {
    add_exclusion(document, element, builder);
  } else if (kind == "adjacent_links") {
    set_adjacent_links(document, element, builder);
  } else if (kind == "group") {
    add_group(document, element, of.group, builder);
  } else if (kind == "material") {
    for (const std::string& name : listed_links(document, element, of.material)) {
      builder.set_material(name, attribute(element, "name"));
    }
  } else if (kind == "contact") {
    set_contact(document, element, builder);
  } else if (!add_loop_element(document, element, builder)) {
    add_force_element(document, element, builder);
  }
}

}  // namespace

void add_extension(const Document& document, ModelBuilder& builder) {
  NamesOf of;
  for (const XMLElement* block : document.all("saltus")) {
    for (auto e = block->FirstChildElement(); e; e = e->NextSiblingElement()) {
      add(document, *e, of, builder);
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
