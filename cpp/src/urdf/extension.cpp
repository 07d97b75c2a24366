#include "urdf/extension.hpp"

#include <sstream>

#include "urdf/attributes.hpp"

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

using GroupOf = std::map<std::string, std::string>;  // link -> group

void add_group(const Document& document, const XMLElement& element, GroupOf& group_of,
               ModelBuilder& builder) {
  const std::string name = attribute(element, "name");
  const Owner owner{"group", name};
  if (document.find("group", name) != &element) {
    document.fail(element, owner, "has the name of another group");
  }
  std::istringstream links(attribute(element, "links"));
  for (std::string of; links >> of;) {
    check_link(document, element, owner, of);
    const auto [first, is_new] = group_of.emplace(of, name);
    if (!is_new) {
      document.fail(element, owner,
                    "names link " + in_quotes(of) + ", which is in group " +
                        in_quotes(first->second) + " already; a link is in one group at most");
    }
    builder.set_group(of, name);
  }
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

void add(const Document& document, const XMLElement& element, GroupOf& group_of,
         ModelBuilder& builder) {
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
    add_exclusion(document, element, builder);
  } else if (kind == "adjacent_links") {
    set_adjacent_links(document, element, builder);
  } else if (kind == "group") {
    add_group(document, element, group_of, builder);
  }
}

}  // namespace

void add_extension(const Document& document, ModelBuilder& builder) {
  GroupOf group_of;
  for (const XMLElement* block : document.all("saltus")) {
    for (auto e = block->FirstChildElement(); e; e = e->NextSiblingElement()) {
      add(document, *e, group_of, builder);
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
