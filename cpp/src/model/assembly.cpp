#include "model/assembly.hpp"

namespace saltus {
namespace {

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
  m_.mass.gravity = b_.gravity_;
  m_.packed = pack(m_.tree, m_.mass, b_.solver_);
  check_moments();
  check_masses();
  add_shapes();
}

Model Assembly::build() {
  check();
  m_.name = b_.name_;
  m_.warnings.insert(m_.warnings.begin(), b_.warnings_.begin(), b_.warnings_.end());
  m_.source = b_.source_;
  add_pairs();
  return Model(std::move(m_));
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
  const Mat3 A =
      has_axis(joint.type) ? rotation_z_to(joint.axis.normalized()) : Mat3(Mat3::Identity());
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

}  // namespace saltus
