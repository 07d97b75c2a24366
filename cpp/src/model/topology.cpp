// Names to indices: which link hangs on which, in what order, driven by which coordinate.
#include "model/assembly.hpp"

namespace saltus {
namespace {

using Numbers = std::vector<const char*>;
const Numbers one_number = {""}, vector_numbers = {"x", "y", "z"},
              quaternion_numbers = {"x", "y", "z", "w"};

}  // namespace

std::vector<Assembly::Axis> Assembly::composition(JointType type) {
  using Kind = Joint::Kind;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  switch (type) {
    case JointType::fixed:
      return {};
    case JointType::revolute:
    case JointType::continuous:
      return {{"", "", Kind::revolute, z}};
    case JointType::prismatic:
      return {{"", "", Kind::prismatic, z}};
    case JointType::helical:
      return {{"", "", Kind::helical, z}};
    case JointType::planar:
      return {{"_x", "_x", Kind::prismatic, x},
              {"_y", "_y", Kind::prismatic, y},
              {"_yaw", "_yaw", Kind::revolute, z}};
    case JointType::spherical:
      return {{"_q", "_w", Kind::ball, z}};
    case JointType::floating:
      return {{"_x", "_vx", Kind::prismatic, x},
              {"_y", "_vy", Kind::prismatic, y},
              {"_z", "_vz", Kind::prismatic, z},
              {"_q", "_w", Kind::ball, z}};
  }
  return {};
}

bool Assembly::has_one_coordinate(JointType type) {
  const std::vector<Axis> axes = composition(type);
  return axes.size() == 1 && axes[0].kind != Joint::Kind::ball;
}

int Assembly::link_index(const std::string& name, const std::string& user,
                         const std::string& element, const std::string& culprit) const {
  const auto found = link_.find(name);
  if (found != link_.end()) return found->second;
  std::vector<std::string> names;
  for (const LinkSpec& link : d_.links) names.push_back(link.name);
  throw ModelError(
      user + " link " + quoted(name) + ", which does not exist; links are " + list_names(names),
      element, culprit);
}

void Assembly::find_links() {
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    link_[d_.links[i].name] = static_cast<int>(i);
  }
  parent_joint_.assign(d_.links.size(), -1);
  below_.resize(d_.links.size());
  for (int j = 0; j < static_cast<int>(d_.joints.size()); ++j) {
    const JointSpec& joint = d_.joints[j];
    joint_[joint.name] = j;
    const std::string names = "joint " + quoted(joint.name) + " names ";
    const int parent = link_index(joint.parent, names + "parent", "joint", joint.name);
    const int child = link_index(joint.child, names + "child", "joint", joint.name);
    if (parent_joint_[child] >= 0) {
      throw ModelError("link " + quoted(joint.child) + " is the child of two joints, " +
                           quoted(d_.joints[parent_joint_[child]].name) + " and " +
                           quoted(joint.name),
                       "joint", joint.name);
    }
    parent_joint_[child] = j;
    below_[parent].push_back(j);
  }
}

void Assembly::order_joints() {
  if (parent_joint_[0] >= 0) {
    throw ModelError("the root link " + quoted(d_.root) + " is the child of joint " +
                         quoted(d_.joints[parent_joint_[0]].name),
                     "link", d_.root);
  }
  std::vector<char> reached(d_.links.size(), 0);
  reached[0] = 1;
  std::vector<int> joints(below_[0].rbegin(), below_[0].rend());
  while (!joints.empty()) {
    const int j = joints.back();
    joints.pop_back();
    order_.push_back(j);
    const int child = link_.at(d_.joints[j].child);
    reached[child] = 1;
    joints.insert(joints.end(), below_[child].rbegin(), below_[child].rend());
  }
  std::vector<std::string> cycle;
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    const std::string& name = d_.links[i].name;
    if (reached[i]) continue;
    if (parent_joint_[i] < 0) {
      throw ModelError("two roots: link " + quoted(name) +
                           " has no joint above it, and neither has " + quoted(d_.root),
                       "link", name);
    }
    cycle.push_back(name);
  }
  if (!cycle.empty()) {
    throw ModelError("a cycle of joints: links " + list_names(cycle) +
                         " hang on each other, not on the root " + quoted(d_.root),
                     "link", cycle.front());
  }
}

void Assembly::resolve_mimic() {
  std::vector<std::string> names;
  for (const JointSpec& joint : d_.joints) names.push_back(joint.name);
  for (int j = 0; j < static_cast<int>(d_.joints.size()); ++j) {
    const auto fail = [&](const std::string& what) {
      const std::string& name = d_.joints[j].name;
      throw ModelError("joint " + quoted(name) + " " + what, "joint", name);
    };
    Drive drive;
    int at = j;
    for (std::size_t hops = 0; d_.joints[at].mimic; ++hops) {
      const Mimic& mimic = *d_.joints[at].mimic;
      if (hops > d_.joints.size()) fail("mimics itself through a cycle");
      if (!has_one_coordinate(d_.joints[at].type)) {
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
    if (at != j && !has_one_coordinate(d_.joints[at].type)) {
      fail("mimics joint " + quoted(d_.joints[at].name) + ", which has not one coordinate");
    }
    drive_.push_back(drive);
    base_.push_back(at);
  }
}

void Assembly::number_coordinates() {
  first_velocity_.assign(d_.joints.size(), -1);
  std::set<std::string> names, velocity_names;
  for (const int at : order_) {  // as the tree meets them: a mimic joint may come before its base
    const int j = base_[at];
    if (first_velocity_[j] >= 0) continue;
    const JointSpec& joint = d_.joints[j];
    first_velocity_[j] = static_cast<int>(m_.velocity_names.size());
    for (const Axis& axis : composition(joint.type)) {
      const bool is_ball = axis.kind == Joint::Kind::ball;
      const Unit unit = is_ball                               ? Unit::one
                        : axis.kind == Joint::Kind::prismatic ? Unit::metre
                                                              : Unit::radian;
      for (const char* number : is_ball ? quaternion_numbers : one_number) {
        Coordinate c{joint.name + axis.suffix + number,
                     joint.name,
                     unit,
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
      for (const char* number : is_ball ? vector_numbers : one_number) {
        m_.velocity_names.push_back(joint.name + axis.velocity_suffix + number);
        if (velocity_names.insert(m_.velocity_names.back()).second) continue;
        throw ModelError("two velocities are named " + quoted(m_.velocity_names.back()), "joint",
                         joint.name);
      }
    }
  }
}

}  // namespace saltus
