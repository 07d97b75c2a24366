// Who is made of what, and the table of what happens between them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"

namespace saltus {

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

std::string in_words(const ContactProperties& properties) {
  std::ostringstream text;
  text << "restitution " << properties.restitution << " and friction " << properties.friction;
  return text.str();
}

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

std::vector<std::string> Assembly::materials_of_links() const {
  std::vector<std::string> materials(d_.links.size());
  for (const auto& [link, material] : d_.materials.of_link) {
    const std::string user = "material " + quoted(material) + " is given to";
    for (const ShapeSpec& shape : d_.shapes) {
      if (shape.name != link || link_.count(link) > 0) continue;
      throw ModelError(user + " half-space " + quoted(link) +
                           ", not to a link; add_floor(material=...) gives it one",
                       "material", material);
    }
    materials[link_index(link, user, "material", material)] = material;
  }
  return materials;
}

void Assembly::add_materials() {
  using Own = std::optional<ContactProperties>;
  const MaterialSpec& given = d_.materials;
  MaterialTable& table = m_.materials;
  std::vector<Own> own(1);  // (rows) of floors that have properties
  const auto row_of = [&](const std::string& name, const Own& contact) {
    std::size_t row = 0;
    while (row < own.size() && !(table.names[row] == name && own[row] == contact)) ++row;
    if (row == own.size()) {
      table.names.push_back(name);
      own.push_back(contact);
    }
    return static_cast<int>(row);
  };
  const std::vector<std::string> of_link = materials_of_links();
  for (const auto& [link, material] : given.of_link) row_of(material, {});
  for (const ShapeSpec& shape : d_.shapes) {
    const std::string& name =
        shape.material.empty() ? of_link[link_.at(shape.link)] : shape.material;
    table.of_shape.push_back(row_of(name, shape.contact));
  }
  const std::set<std::string> known(table.names.begin(), table.names.end());
  for (const auto& [pair, properties] : given.contact) {
    for (const std::string& name : {pair.first, pair.second}) {
      if (!name.empty() && known.count(name) > 0) continue;
      const std::vector<std::string> names(std::next(known.begin()), known.end());  // without ""
      throw ModelError("a contact names material " + quoted(name) +
                           ", which no link has; materials are " +
                           (names.empty() ? "none" : list_names(names)),
                       "material", name);
    }
  }
  std::vector<ContactProperties> contact;
  // What is said first holds: of two materials, of the floor, of all. No two floors ever meet.
  const std::size_t k = table.names.size();
  for (std::size_t a = 0; a < k; ++a) {
    for (std::size_t b = 0; b < k; ++b) {
      const auto pair = given.contact.find(std::minmax(table.names[a], table.names[b]));
      const Own of_floor = own[a] ? own[a] : own[b];
      const Own said = pair != given.contact.end() ? Own(pair->second)
                       : of_floor                  ? of_floor
                                                   : given.standard;
      said_.push_back(said.has_value());
      contact.push_back(said.value_or(ContactProperties{}));
    }
  }
  table.contact = std::move(contact);
}

}  // namespace saltus
