#include "model/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/lagrangian/arc_matrix.hpp"

namespace saltus {
namespace {

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

struct Axis {
  const char* suffix;  ///< of the coordinate's name
  Joint::Kind kind;
  Vec3 axis;           ///< in the frame of the joint before it
};

/// The one-degree joints that a joint is composed of; axes in the joint's own (z = axis) frame.
std::vector<Axis> composition(JointType type) {
  using Kind = Joint::Kind;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  switch (type) {
    case JointType::fixed:
      return {};
    case JointType::revolute:
    case JointType::continuous:
      return {{"", Kind::revolute, z}};
    case JointType::prismatic:
      return {{"", Kind::prismatic, z}};
    case JointType::helical:
      return {{"", Kind::helical, z}};
    case JointType::planar:
      return {{"_x", Kind::prismatic, x}, {"_y", Kind::prismatic, y}, {"_yaw", Kind::revolute, z}};
    case JointType::spherical:
      return {{"_yaw", Kind::revolute, z},
              {"_pitch", Kind::revolute, y},
              {"_roll", Kind::revolute, x}};
    case JointType::floating:
      return {{"_x", Kind::prismatic, x},  {"_y", Kind::prismatic, y},
              {"_z", Kind::prismatic, z},  {"_yaw", Kind::revolute, z},
              {"_pitch", Kind::revolute, y}, {"_roll", Kind::revolute, x}};
  }
  return {};
}

bool has_axis(JointType type) {
  return type != JointType::fixed && type != JointType::floating && type != JointType::spherical;
}

}  // namespace

void Assembly::check() {
  find_links();
  order_joints();
  resolve_mimic();
  number_coordinates();
  add_frames();
  add_masses();
  check_masses();
  add_shapes();
}

Model Assembly::build() {
  check();
  m_.name = b_.name_;
  m_.mass.gravity = b_.gravity_;
  m_.warnings = b_.warnings_;
  m_.source = b_.source_;
  add_pairs();
  return Model(std::move(m_));
}

int Assembly::link_index(const std::string& name, const std::string& joint,
                         const std::string& role) const {
  const auto found = link_.find(name);
  if (found != link_.end()) return found->second;
  std::vector<std::string> names;
  for (const LinkSpec& link : b_.links_) names.push_back(link.name);
  throw ModelError("joint " + quoted(joint) + " names " + role + " link " + quoted(name) +
                       ", which does not exist; links are " + list_names(names),
                   "joint", joint);
}

void Assembly::find_links() {
  for (std::size_t i = 0; i < b_.links_.size(); ++i) {
    link_[b_.links_[i].name] = static_cast<int>(i);
  }
  parent_joint_.assign(b_.links_.size(), -1);
  below_.resize(b_.links_.size());
  for (int j = 0; j < static_cast<int>(b_.joints_.size()); ++j) {
    const JointSpec& joint = b_.joints_[j];
    joint_[joint.name] = j;
    const int parent = link_index(joint.parent, joint.name, "parent");
    const int child = link_index(joint.child, joint.name, "child");
    if (parent_joint_[child] >= 0) {
      throw ModelError("link " + quoted(joint.child) + " is the child of two joints, " +
                           quoted(b_.joints_[parent_joint_[child]].name) + " and " +
                           quoted(joint.name),
                       "joint", joint.name);
    }
    parent_joint_[child] = j;
    below_[parent].push_back(j);
  }
}

void Assembly::order_joints() {
  if (parent_joint_[0] >= 0) {
    throw ModelError("the root link " + quoted(b_.root_) + " is the child of joint " +
                         quoted(b_.joints_[parent_joint_[0]].name),
                     "link", b_.root_);
  }
  std::vector<char> reached(b_.links_.size(), 0);
  std::vector<int> stack{0};
  reached[0] = 1;
  std::vector<int> joints(below_[0].rbegin(), below_[0].rend());
  while (!joints.empty()) {
    const int j = joints.back();
    joints.pop_back();
    order_.push_back(j);
    const int child = link_.at(b_.joints_[j].child);
    reached[child] = 1;
    joints.insert(joints.end(), below_[child].rbegin(), below_[child].rend());
  }
  std::vector<std::string> cycle;
  for (std::size_t i = 0; i < b_.links_.size(); ++i) {
    const std::string& name = b_.links_[i].name;
    if (reached[i]) continue;
    if (parent_joint_[i] < 0) {
      throw ModelError("two roots: link " + quoted(name) + " has no joint above it, and neither has " +
                           quoted(b_.root_),
                       "link", name);
    }
    cycle.push_back(name);
  }
  if (!cycle.empty()) {
    throw ModelError("a cycle of joints: links " + list_names(cycle) +
                         " hang on each other, not on the root " + quoted(b_.root_),
                     "link", cycle.front());
  }
}

void Assembly::resolve_mimic() {
  std::vector<std::string> names;
  for (const JointSpec& joint : b_.joints_) names.push_back(joint.name);
  for (int j = 0; j < static_cast<int>(b_.joints_.size()); ++j) {
    const auto fail = [&](const std::string& what) {
      const std::string& name = b_.joints_[j].name;
      throw ModelError("joint " + quoted(name) + " " + what, "joint", name);
    };
    Drive drive;
    int at = j;
    for (std::size_t hops = 0; b_.joints_[at].mimic; ++hops) {
      const Mimic& mimic = *b_.joints_[at].mimic;
      if (hops > b_.joints_.size()) fail("mimics itself through a cycle");
      if (composition(b_.joints_[at].type).size() != 1) {
        fail("mimics another, which only joints of one coordinate can");
      }
      drive.offset += drive.multiplier * mimic.offset;
      drive.multiplier *= mimic.multiplier;
      const auto target = joint_.find(mimic.joint);
      if (target == joint_.end()) {
        fail("mimics joint " + quoted(mimic.joint) + ", which does not exist; joints are " +
             list_names(names));
      }
      at = target->second;
    }
    if (at != j && composition(b_.joints_[at].type).size() != 1) {
      fail("mimics joint " + quoted(b_.joints_[at].name) + ", which has not one coordinate");
    }
    drive_.push_back(drive);
    base_.push_back(at);
  }
}

void Assembly::number_coordinates() {
  first_coordinate_.assign(b_.joints_.size(), -1);
  std::set<std::string> names;
  for (const int j : order_) {
    if (base_[j] != j) continue;
    const JointSpec& joint = b_.joints_[j];
    first_coordinate_[j] = static_cast<int>(m_.coordinates.size());
    for (const Axis& axis : composition(joint.type)) {
      Coordinate c{joint.name + axis.suffix, joint.name, axis.kind != Joint::Kind::prismatic,
                   joint.lower, joint.upper, joint.velocity, joint.effort,
                   joint.damping, joint.friction};
      if (!names.insert(c.name).second) {
        throw ModelError("two coordinates are named " + quoted(c.name), "joint", joint.name);
      }
      m_.coordinates.push_back(std::move(c));
    }
  }
}

Assembly::Place Assembly::add_frame(const Place& at, const Vec3& axis, Joint joint, int spec,
                                    int coordinate) {
  const Mat3 A = rotation_z_to(axis);
  Drive drive = drive_[spec];
  drive.coordinate = coordinate;
  const int i = add_joint(m_.tree, at.joint, joint, at.X_JF * Pose{A, Vec3::Zero()}, drive);
  m_.joints.back().frames.push_back(i);
  m_.joints.back().coordinates.push_back(coordinate);
  return {i, {A.transpose(), Vec3::Zero()}};
}

Assembly::Place Assembly::add_joint_frames(const Place& parent, int spec) {
  const JointSpec& joint = b_.joints_[spec];
  m_.joints.push_back({joint.name, joint.type, joint.parent, joint.child, {}, {}});
  const Mat3 A = has_axis(joint.type) ? rotation_z_to(joint.axis.normalized())
                                      : Mat3(Mat3::Identity());
  Place at{parent.joint, parent.X_JF * joint.X_PJ * Pose{A, Vec3::Zero()}};
  int coordinate = first_coordinate_[base_[spec]];
  for (const Axis& axis : composition(joint.type)) {
    at = add_frame(at, axis.axis, {axis.kind, joint.pitch}, spec, coordinate++);
  }
  at.X_JF = at.X_JF * Pose{A.transpose(), Vec3::Zero()};
  return at;
}

void Assembly::add_frames() {
  place_.resize(b_.links_.size());
  group_.resize(b_.links_.size());
  for (const int j : order_) {
    const int parent = link_.at(b_.joints_[j].parent), child = link_.at(b_.joints_[j].child);
    place_[child] = add_joint_frames(place_[parent], j);
    group_[child] = b_.joints_[j].type == JointType::fixed ? group_[parent] : child;
  }
  for (std::size_t i = 0; i < b_.links_.size(); ++i) {
    const LinkSpec& link = b_.links_[i];
    m_.links.push_back({link.name, place_[i].joint, place_[i].X_JF, link.inertia.mass});
  }
  m_.tree.coordinates = static_cast<int>(m_.coordinates.size());
}

void Assembly::add_masses() {
  m_.mass.body.resize(m_.tree.parent.size());
  for (std::size_t i = 0; i < b_.links_.size(); ++i) {
    if (place_[i].joint < 0) continue;  // fixed to the world: cannot move
    BodyInertia& body = m_.mass.body[place_[i].joint];
    body = weld(body, transform(place_[i].X_JF, b_.links_[i].inertia));
  }
}

// A pivot of the sweep at joint i is the inertia that i feels with all joints below it free. Where
// it vanishes against the inertia with them locked, no force is needed to move the joint.
void Assembly::check_masses() const {
  const Tree& tree = m_.tree;
  if (tree.joints() == 0) return;
  Kinematics kin(tree);
  Composite comp(tree);
  ArcMatrix M(tree);
  VecX q(tree.coordinates);
  for (int i = 0; i < q.size(); ++i) q[i] = 0.3 + 0.1 * (i % 7);  // no special configuration
  set_configuration(tree, q, kin);
  set_velocity(tree, VecX::Zero(tree.coordinates), kin);
  first_pass(tree, m_.mass, kin, comp);
  second_pass(tree, m_.mass, kin, comp);
  const bool regular = factorize(tree, kin, comp, 0, M);
  for (const JointInfo& joint : m_.joints) {
    for (const int i : joint.frames) {
      const double locked = kin.joint[i].S.dot(comp.joint[i].U);
      // 1e-12: rounding of the sweep
      const bool moves = locked > 0 && (!tree.one_to_one || M.joint[i].inverse_D * locked < 1e12);
      if (moves) continue;
      throw ModelError("joint " + quoted(joint.name) + " moves no mass: give link " +
                           quoted(joint.child) + " or a link below it a mass and an inertia",
                       "joint", joint.name);
    }
  }
  if (!regular) throw ModelError("the mass matrix is singular: some joint moves no mass");
}

void Assembly::add_shapes() {
  std::map<std::string, int> count;
  for (const ModelBuilder::ShapeSpec& spec : b_.shapes_) {
    const auto found = link_.find(spec.link);
    if (found == link_.end()) {
      throw ModelError("a " + shape_name(spec.shape) + " is put on link " + quoted(spec.link) +
                           ", which does not exist",
                       "link", spec.link);
    }
    const Place& place = place_[found->second];
    std::string name = spec.name.empty() ? spec.link : spec.name;
    if (const int k = ++count[name]; k > 1) name += "#" + std::to_string(k);
    m_.shapes.push_back({spec.shape, place.joint, place.X_JF * spec.X_LG, found->second, name});
  }
  for (const ModelBuilder::Exclusion& exclusion : b_.exclusions_) {
    for (const std::string& name : {exclusion.a, exclusion.b}) {
      if (link_.count(name) == 0) {
        throw ModelError("an exclusion names link " + quoted(name) + ", which does not exist",
                         "link", name);
      }
    }
    excluded_.insert(std::minmax(link_.at(exclusion.a), link_.at(exclusion.b)));
  }
}

// Links on both sides of one joint overlap at it by design. A free or planar joint is no such
// place, and a half-space is a floor to be fallen on.
bool Assembly::is_adjacent(int link_a, int link_b) const {
  const auto hangs_on = [&](int child, int parent) {
    const int joint = parent_joint_[group_[child]];
    if (joint < 0) return false;
    const JointSpec& spec = b_.joints_[joint];
    if (spec.type == JointType::floating || spec.type == JointType::planar) return false;
    return group_[link_.at(spec.parent)] == group_[parent];
  };
  return hangs_on(link_a, link_b) || hangs_on(link_b, link_a);
}

bool Assembly::is_watched(const PlacedShape& a, const PlacedShape& b) const {
  if (a.joint == b.joint || excluded_.count(std::minmax(a.link, b.link)) > 0) return false;
  const bool floor = std::holds_alternative<HalfSpace>(a.shape) ||
                     std::holds_alternative<HalfSpace>(b.shape);
  return floor || !is_adjacent(a.link, b.link);
}

void Assembly::add_pairs() {
  std::map<std::string, std::vector<std::string>> unsupported;
  const int n = static_cast<int>(m_.shapes.size());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      const PlacedShape &a = m_.shapes[i], &b = m_.shapes[j];
      if (!is_watched(a, b)) continue;
      if (!has_gap(a.shape, b.shape)) {
        unsupported[shape_name(a.shape) + "-" + shape_name(b.shape)].push_back(a.name + " ~ " +
                                                                               b.name);
        continue;
      }
      const bool swap = !std::holds_alternative<Sphere>(a.shape);
      Pair pair{swap ? j : i, swap ? i : j, {}, 0};
      pair.chain = chain_between(m_.tree, m_.shapes[pair.b].joint, m_.shapes[pair.a].joint);
      // epsilon_phi: 1e-10 of the smaller shape is far above the rounding of positions (1e-16 of
      // the scene) and far below what anybody can see
      pair.touch = 1e-10 * std::min(feature_size(a.shape), feature_size(b.shape));
      m_.pairs.push_back(std::move(pair));
    }
  }
  for (const auto& [kinds, names] : unsupported) {
    m_.warnings.push_back("no gap function for " + kinds + " pairs; these pass through each other: " +
                          list_names(names));
  }
}

}  // namespace saltus
