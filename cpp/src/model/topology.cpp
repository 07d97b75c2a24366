// Names to indices: which link hangs on which, in what order, driven by which coordinate.
#include "model/assembly.hpp"

namespace saltus {

std::vector<Assembly::Axis> Assembly::composition(JointType type) {
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
      return {
          {"_yaw", Kind::revolute, z}, {"_pitch", Kind::revolute, y}, {"_roll", Kind::revolute, x}};
    case JointType::floating:
      return {{"_x", Kind::prismatic, x},    {"_y", Kind::prismatic, y},
              {"_z", Kind::prismatic, z},    {"_yaw", Kind::revolute, z},
              {"_pitch", Kind::revolute, y}, {"_roll", Kind::revolute, x}};
  }
  return {};
}

int Assembly::link_index(const std::string& name, const std::string& user,
                         const std::string& element, const std::string& culprit) const {
  const auto found = link_.find(name);
  if (found != link_.end()) return found->second;
  std::vector<std::string> names;
  for (const LinkSpec& link : b_.links_) names.push_back(link.name);
  throw ModelError(
      user + " link " + quoted(name) + ", which does not exist; links are " + list_names(names),
      element, culprit);
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
    const std::string names = "joint " + quoted(joint.name) + " names ";
    const int parent = link_index(joint.parent, names + "parent", "joint", joint.name);
    const int child = link_index(joint.child, names + "child", "joint", joint.name);
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
      throw ModelError("two roots: link " + quoted(name) +
                           " has no joint above it, and neither has " + quoted(b_.root_),
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
      Coordinate c{joint.name + axis.suffix,
                   joint.name,
                   axis.kind != Joint::Kind::prismatic,
                   joint.lower,
                   joint.upper,
                   joint.velocity,
                   joint.effort,
                   joint.damping,
                   joint.friction};
      if (!names.insert(c.name).second) {
        throw ModelError("two coordinates are named " + quoted(c.name), "joint", joint.name);
      }
      m_.coordinates.push_back(std::move(c));
    }
  }
}

}  // namespace saltus
