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
  add_forces();
  m_.mass.gravity = d_.gravity;
  add_springs();
  add_compensations();
  add_functions();
  if (!m_.forces.functions.empty() || !m_.mass.potentials.functions.empty()) {
    m_.has_checked_functions = std::make_shared<std::atomic<bool>>(false);
  }
  m_.packed = pack(m_.tree, m_.mass, d_.solver);
  const int joining = m_.packed.columns + m_.forces.n_columns();
  m_.packed.dense_arcs = joining > 0 && 3 * (joining + m_.forces.n_coupled()) > m_.tree.n_v;
  check_moments();
  check_masses();
  add_loops();
  add_shapes();
  check_visuals();
}

Model Assembly::build() {
  check();
  m_.name = d_.name;
  m_.warnings.insert(m_.warnings.begin(), d_.warnings.begin(), d_.warnings.end());
  m_.source = d_.source;
  m_.description = std::make_shared<const ModelDescription>(d_);
  add_pairs();
  add_limits();
  warn_of_states();
  warn_of_unsaid_contacts();
  return Model(std::move(m_));
}

Assembly::Place Assembly::add_frame(const Place& at, const Axis& axis, int spec, int velocity) {
  JointInfo& info = m_.joints.back();
  const auto note = [&](int joint, int v) {
    info.frames.push_back(joint);
    info.velocities.push_back(v);
  };
  if (axis.kind == Joint::Kind::ball) {
    const int last = add_ball(m_.tree, at.joint, at.X_JF);
    for (int k = 0; k < 3; ++k) note(last - 2 + k, velocity + k);
    const int first = m_.tree.balls.back().coordinate;
    for (int k = 0; k < 4; ++k) info.coordinates.push_back(first + k);
    return {last, {}};
  }
  const Mat3 A = rotation_z_to(axis.axis);
  Drive drive = drive_[spec];
  drive.velocity = velocity;
  const Joint joint{axis.kind, d_.joints[spec].pitch};
  const int i = add_joint(m_.tree, at.joint, joint, at.X_JF * Pose{A, Vec3::Zero()}, drive);
  note(i, velocity);
  info.coordinates.push_back(m_.tree.coordinate[velocity]);
  return {i, {A.transpose(), Vec3::Zero()}};
}

void Assembly::describe(const JointSpec& joint, JointInfo& info) const {
  info.index = static_cast<int>(m_.joints.size()) - 1;
  info.X_PJ = joint.X_PJ;
  if (has_axis(joint.type)) info.axis = joint.axis.stableNormalized();
  info.pitch = joint.pitch;
  if (joint.mimic) {
    info.mimics = joint.mimic->joint;
    info.multiplier = joint.mimic->multiplier;
    info.offset = joint.mimic->offset;
  }
  info.lower = joint.lower;
  info.upper = joint.upper;
}

Assembly::Place Assembly::add_joint_frames(const Place& parent, int spec) {
  const JointSpec& joint = d_.joints[spec];
  m_.joints.push_back({joint.name, joint.type, joint.parent, joint.child, {}, {}, {}});
  describe(joint, m_.joints.back());
  const Mat3 A =
      has_axis(joint.type) ? rotation_z_to(joint.axis.stableNormalized()) : Mat3(Mat3::Identity());
  Place at{parent.joint, parent.X_JF * joint.X_PJ * Pose{A, Vec3::Zero()}};
  int velocity = first_velocity_[base_[spec]];
  for (const Axis& axis : composition(joint.type)) at = add_frame(at, axis, spec, velocity++);
  at.X_JF = at.X_JF * Pose{A.transpose(), Vec3::Zero()};
  return at;
}

void Assembly::add_frames() {
  place_.resize(d_.links.size());
  group_.resize(d_.links.size());
  for (const int j : order_) {
    const int parent = link_.at(d_.joints[j].parent), child = link_.at(d_.joints[j].child);
    place_[child] = add_joint_frames(place_[parent], j);
    group_[child] = d_.joints[j].type == JointType::fixed ? group_[parent] : child;
  }
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    const LinkSpec& link = d_.links[i];
    m_.links.push_back({link.name, place_[i].joint, place_[i].X_JF, link.inertia.mass, link.inertia,
                        static_cast<int>(i)});
  }
}

}  // namespace saltus
