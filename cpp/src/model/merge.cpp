// One description put into another: names, floors and contacts of the two brought together.
#include <algorithm>
#include <set>
#include <sstream>

#include "model/assembly.hpp"
#include "model/merge_names.hpp"

namespace saltus {
namespace {

bool is_half_space(const ShapeSpec& shape) {
  return std::holds_alternative<HalfSpace>(shape.shape);
}

std::string name_of(const ShapeSpec& shape) { return shape.name.empty() ? shape.link : shape.name; }

/// What a shape is made of; "" where nothing says it.
std::string material_of(const ModelDescription& d, const ShapeSpec& shape) {
  if (!shape.material.empty()) return shape.material;
  const auto found = d.materials.of_link.find(shape.link);
  return found == d.materials.of_link.end() ? "" : found->second;
}

/// What two descriptions say of one thing; @throws where they contradict each other.
std::optional<ContactProperties> agreed(const std::optional<ContactProperties>& a,
                                        const std::optional<ContactProperties>& b,
                                        const std::string& what, const std::string& advice) {
  if (a && b && !(*a == *b)) {
    throw ModelError(
        what + " has " + in_words(*a) + ", and in what is added " + in_words(*b) + "; " + advice,
        "contact", what);
  }
  return a ? a : b;
}

/// Finds the other's half-spaces in ours, gives ours what the other says of them, and takes them
/// out of the other. Returns what the materials of the other's are called in ours.
std::map<std::string, std::string> merge_floors(const Pose& X_WR, ModelDescription& ours,
                                                ModelDescription& other) {
  std::map<std::string, std::string> renamed;
  const auto is_merged = [&](const ShapeSpec& shape) {
    if (!is_half_space(shape)) return false;
    const std::optional<Pose> X_RL = fixed_pose(other, shape.link);
    if (!X_RL) return false;
    for (ShapeSpec& floor : ours.shapes) {
      if (!is_half_space(floor)) continue;
      const std::optional<Pose> X_WL = fixed_pose(ours, floor.link);
      if (!X_WL || !same_plane(*X_WL * floor.X_LG, X_WR * *X_RL * shape.X_LG)) continue;
      agreed(floor.contact ? floor.contact : ours.materials.standard,
             shape.contact ? shape.contact : other.materials.standard,
             "half-space " + quoted(name_of(floor)), "they are one plane: give both the same");
      if (!floor.contact) floor.contact = shape.contact;
      for (SensorSpec& sensor : other.sensors) {
        if (!shape.name.empty() && sensor.other == shape.name) sensor.other = name_of(floor);
      }
      const std::string mine = material_of(ours, floor), its = material_of(other, shape);
      if (mine.empty()) floor.material = its;
      if (!mine.empty() && !its.empty() && mine != its) renamed[its] = mine;
      return true;
    }
    return false;
  };
  std::vector<ShapeSpec> rest;
  for (const ShapeSpec& shape : other.shapes) {
    if (!is_merged(shape)) rest.push_back(shape);
  }
  other.shapes = std::move(rest);
  return renamed;
}

/// Adds the other's contacts; those of a floor that is made of one of our materials are now of it.
void merge_contacts(const std::map<std::string, std::string>& renamed,
                    const ModelDescription& other, ModelDescription& ours) {
  std::set<std::string> used;
  for (const auto& [link, material] : other.materials.of_link) used.insert(material);
  for (const ShapeSpec& shape : other.shapes) used.insert(material_of(other, shape));
  const auto names = [&](const std::string& material) {
    std::vector<std::string> both;
    const auto found = renamed.find(material);
    if (found != renamed.end()) both.push_back(found->second);
    if (found == renamed.end() || used.count(material) > 0) both.push_back(material);
    return both;
  };
  for (const auto& [pair, properties] : other.materials.contact) {
    for (const std::string& a : names(pair.first)) {
      for (const std::string& b : names(pair.second)) {
        const auto [at, is_new] = ours.materials.contact.emplace(std::minmax(a, b), properties);
        if (is_new) continue;
        agreed(at->second, properties, "the contact between " + quoted(a) + " and " + quoted(b),
               "own_materials keeps the materials of the two apart");
      }
    }
  }
}

void check_rules(const ModelDescription& ours, const ModelDescription& other) {
  const auto said = [](const ModelDescription& d) {
    return d.filter.adjacent == AdjacentLinks::watched ? "watched" : "excluded";
  };
  if (ours.filter.adjacent != other.filter.adjacent) {
    throw ModelError("gaps between adjacent links are " + std::string(said(ours)) + " in " +
                     quoted(ours.name) + " and " + said(other) + " in what is added, " +
                     quoted(other.name) + "; set_adjacent_links makes them equal");
  }
}

/// Functions of q and v know those of their own model alone.
void check_functions(const ModelDescription& d) {
  const auto refuse = [&](const char* kind, const std::string& name) {
    throw ModelError(std::string(kind) + " " + quoted(name) + " of " + quoted(d.name) +
                         " is a function of that model's q and cannot be added to another; add it "
                         "to the whole",
                     kind, name);
  };
  if (!d.forces.empty()) refuse("force", d.forces.front().name);
  if (!d.potentials.empty()) refuse("potential", d.potentials.front().name);
}

/// Where the other's root link is in the world; nothing where it moves.
std::optional<Pose> check_parent(const ModelDescription& ours, const ModelDescription& other,
                                 const std::string& parent, const Pose& X) {
  std::vector<std::string> links;
  for (const LinkSpec& link : ours.links) links.push_back(link.name);
  if (std::find(links.begin(), links.end(), parent) == links.end()) {
    throw ModelError(quoted(other.name) + " is to be carried by link " + quoted(parent) +
                         ", which does not exist; links are " + list_names(links),
                     "link", parent);
  }
  const std::optional<Pose> X_WP = fixed_pose(ours, parent);
  if (X_WP) return *X_WP * X;
  for (const ShapeSpec& shape : other.shapes) {
    if (!is_half_space(shape)) continue;
    throw ModelError("half-space " + quoted(name_of(shape)) + " of " + quoted(other.name) +
                         " would move with link " + quoted(parent) +
                         "; half-spaces are fixed to the world",
                     "half_space", name_of(shape));
  }
  return {};
}

template <class Items>
void append(const Items& from, Items& to) {
  to.insert(to.end(), from.begin(), from.end());
}

void warn_of_gravity(const ModelDescription& other, ModelDescription& ours) {
  if (ours.gravity == other.gravity) return;
  const auto show = [](const Vec3& g) {
    std::ostringstream text;
    text << "(" << g[0] << " " << g[1] << " " << g[2] << ")";
    return text.str();
  };
  ours.warnings.push_back("gravity of " + quoted(other.name) + " is " + show(other.gravity) +
                          " and not used: that of " + quoted(ours.name) + " holds, " +
                          show(ours.gravity));
}

}  // namespace

std::optional<Pose> fixed_pose(const ModelDescription& d, const std::string& link) {
  Pose X;
  std::string at = link;
  for (std::size_t hops = 0; at != d.root; ++hops) {
    const auto above = std::find_if(d.joints.begin(), d.joints.end(),
                                    [&](const JointSpec& joint) { return joint.child == at; });
    if (above == d.joints.end() || above->type != JointType::fixed) return {};
    if (hops > d.joints.size()) return {};  // a cycle, which build() refuses
    X = above->X_PJ * X;
    at = above->parent;
  }
  return X;
}

ModelBuilder& ModelBuilder::add(ModelDescription other, const AddSpec& how) {
  add_prefix(how, other);
  const std::string parent = how.parent.empty() ? d_.root : how.parent;
  ModelBuilder whole = *this;  // becomes this one when nothing is wrong
  ModelDescription& d = whole.d_;
  const std::optional<Pose> X_WR = check_parent(d, other, parent, how.X);
  check_rules(d, other);
  for (const ModelDescription* each : {&d, &other}) check_functions(*each);
  const std::optional<ContactProperties> standard =
      agreed(d.materials.standard, other.materials.standard,
             "the default contact of " + quoted(d.name), "set_default_contact makes them equal");
  std::map<std::string, std::string> renamed;
  if (X_WR) renamed = merge_floors(*X_WR, d, other);
  check_names(d, other, how.prefix);
  merge_contacts(renamed, other, d);
  d.materials.standard = standard;
  warn_of_gravity(other, d);

  JointSpec joint;
  joint.name = other.root;
  joint.type = JointType::fixed;
  joint.parent = parent;
  joint.child = other.root;
  joint.X_PJ = how.X;
  const Names mine = names_of(d), others = names_of(other);
  while (mine.joints.count(joint.name) + others.joints.count(joint.name) > 0) joint.name += "_";
  whole.add_joint(joint);
  append(other.links, d.links);
  append(other.joints, d.joints);
  append(other.actuators, d.actuators);
  append(other.loops, d.loops);
  append(other.couplings, d.couplings);
  append(other.prescribed, d.prescribed);
  append(other.states, d.states);
  append(other.sensors, d.sensors);
  append(other.springs, d.springs);
  append(other.shapes, d.shapes);
  append(other.visuals, d.visuals);
  append(other.warnings, d.warnings);
  append(other.filter.links, d.filter.links);
  append(other.filter.bodies, d.filter.bodies);
  append(other.filter.groups, d.filter.groups);
  d.filter.group_of.insert(other.filter.group_of.begin(), other.filter.group_of.end());
  d.materials.of_link.insert(other.materials.of_link.begin(), other.materials.of_link.end());
  *this = std::move(whole);
  return *this;
}

}  // namespace saltus
