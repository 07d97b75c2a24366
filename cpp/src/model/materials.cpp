// Who is made of what, and the table of what happens between them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"

namespace saltus {
namespace {

void check_properties(const ContactProperties& p, const std::string& between) {
  std::ostringstream text;
  if (!(p.restitution >= 0 && p.restitution <= 1)) {
    text << "restitution " << p.restitution << "; it is in [0, 1]";
  } else if (!(p.friction >= 0 && std::isfinite(p.friction))) {
    text << "friction " << p.friction << "; it is finite and not negative";
  } else {
    return;
  }
  throw ModelError("the contact between " + between + " has " + text.str(), "contact", between);
}

}  // namespace

ModelBuilder& ModelBuilder::set_material(const std::string& link, const std::string& material) {
  if (material.empty()) {
    throw ModelError("link " + quoted(link) + " is given a material without a name", "link", link);
  }
  d_.materials.of_link[link] = material;
  return *this;
}

ModelBuilder& ModelBuilder::set_default_contact(const ContactProperties& properties) {
  check_properties(properties, "materials that nothing else is said of");
  d_.materials.standard = properties;
  return *this;
}

ModelBuilder& ModelBuilder::set_contact(const std::string& material_a,
                                        const std::string& material_b,
                                        const ContactProperties& properties) {
  check_properties(properties, quoted(material_a) + " and " + quoted(material_b));
  d_.materials.contact[std::minmax(material_a, material_b)] = properties;
  return *this;
}

void Assembly::add_materials() {
  const MaterialSpec& given = d_.materials;
  MaterialTable& table = m_.materials;
  const auto find = [&](const std::string& name) {
    const auto at = std::find(table.names.begin(), table.names.end(), name);
    return static_cast<std::size_t>(at - table.names.begin());
  };
  std::vector<int> of_link(d_.links.size(), 0);
  for (const auto& [link, material] : given.of_link) {
    const std::size_t index = find(material);
    if (index == table.names.size()) table.names.push_back(material);
    const std::string user = "material " + quoted(material) + " is given to";
    of_link[link_index(link, user, "material", material)] = static_cast<int>(index);
  }
  for (const PlacedShape& shape : m_.shapes) table.of_shape.push_back(of_link[shape.link]);

  const std::size_t k = table.names.size();
  table.contact.assign(k * k, given.standard);
  for (const auto& [pair, properties] : given.contact) {
    for (const std::string& name : {pair.first, pair.second}) {
      if (find(name) < k && !name.empty()) continue;
      const std::vector<std::string> known(table.names.begin() + 1, table.names.end());
      throw ModelError("a contact names material " + quoted(name) +
                           ", which no link has; materials are " +
                           (known.empty() ? "none" : list_names(known)),
                       "material", name);
    }
    const std::size_t a = find(pair.first), b = find(pair.second);
    table.contact[a * k + b] = table.contact[b * k + a] = properties;
  }
}

}  // namespace saltus
