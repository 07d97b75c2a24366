// Joints' armature, springs, damping, friction and actuators, by coordinate.
//
// A joint that mimics another moves the other's coordinate: with multiplier m and offset o its
// armature, damping and stiffness count m^2 there, its friction |m|, and its spring rests where the
// coordinate is (rest - o) / m.
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/assembly.hpp"

namespace saltus {
namespace {

void add(double x, int index, int n_v, VecX& to) {
  if (x == 0) return;
  if (to.size() == 0) to.setZero(n_v);
  to[index] += x;
}

/// Velocities that damping acts on: all of a planar joint, the ball of a floating one.
std::vector<int> damped(const JointInfo& joint) {
  if (joint.type != JointType::floating) return joint.velocities;
  return {joint.velocities.end() - 3, joint.velocities.end()};
}

}  // namespace

int Assembly::joint_index(const std::string& name, const std::string& user) const {
  const auto found = joint_.find(name);
  if (found != joint_.end()) return found->second;
  std::vector<std::string> names;
  for (const JointSpec& joint : d_.joints) names.push_back(joint.name);
  throw ModelError(
      user + " joint " + quoted(name) + ", which does not exist; joints are " + list_names(names),
      "joint", name);
}

void Assembly::add_forces() {
  const int n = m_.tree.n_v;
  for (const JointInfo& info : m_.joints) {
    const int spec = joint_.at(info.name);
    const JointSpec& joint = d_.joints[spec];
    const double m = drive_[spec].multiplier, offset = drive_[spec].offset;
    const bool is_damped = has(joint.effects, JointEffects::damping);
    for (const int c : damped(info)) {
      if (is_damped) add(m * m * joint.damping, c, n, m_.forces.damping);
      if (is_damped) add(m * m * joint.armature, c, n, m_.mass.armature);
      if (has(joint.effects, JointEffects::friction)) {
        add(std::abs(m) * joint.friction, c, n, m_.forces.friction);
      }
      if (is_damped && !joint.curve_x.empty() && m != 0) add_curve(joint, c, drive_[spec]);
      if (!is_damped || joint.stiffness == 0 || m == 0) continue;
      add(m * m * joint.stiffness, c, n, m_.mass.stiffness);
      // for now the moment that all springs there have about 0
      add(m * joint.stiffness * (joint.rest - offset), c, n, m_.mass.rest);
    }
  }
  for (Eigen::Index c = 0; c < m_.mass.rest.size(); ++c) {
    if (m_.mass.rest[c] != 0) m_.mass.rest[c] /= m_.mass.stiffness[c];
  }
  for (const ActuatorSpec& spec : d_.actuators) add_actuator(spec);
}

void Assembly::add_curve(const JointSpec& joint, int velocity, const Drive& drive) {
  m_.mass.potentials.curves.push_back(
      {velocity, drive.multiplier, drive.offset,
       make_curve(joint.curve_x, joint.curve_f, joint.curve_slopes)});
}

void Assembly::add_actuator(const ActuatorSpec& spec) {
  Actuator out{spec.name,   {},          spec.gain,  spec.bias, spec.bias_l,
               spec.bias_v, spec.effort, spec.lower, spec.upper};
  for (const auto& [name, ratio] : spec.joints) {
    const int j = joint_index(name, "actuator " + quoted(spec.name) + " moves");
    const JointSpec& joint = d_.joints[j];
    if (!has(joint.effects, JointEffects::motors)) return;
    if (!has_one_coordinate(joint.type)) {
      throw ModelError("actuator " + quoted(spec.name) + " moves joint " + quoted(name) +
                           ", which has not one coordinate",
                       "actuator", spec.name);
    }
    const int c = first_velocity_[base_[j]];
    out.gears.push_back({c, m_.tree.coordinate[c], ratio * drive_[j].multiplier});
    out.bias += spec.bias_l * ratio * drive_[j].offset;
    if (spec.joints.size() > 1 || !std::isfinite(joint.effort) || !(joint.effort > 0)) continue;
    VecX& effort = m_.forces.effort;
    if (effort.size() == 0) {
      effort.setConstant(m_.tree.n_v, std::numeric_limits<double>::infinity());
    }
    effort[c] = std::min(effort[c], std::abs(drive_[j].multiplier) * joint.effort);
  }
  m_.forces.actuators.push_back(std::move(out));
}

namespace {

/// Limits of one coordinate, those of joints that mimic it included.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool is_empty() const { return lower > upper; }
};

/// Limits of a displacement m q + o, as those of q.
Range range_of(const JointSpec& joint, const Drive& drive) {
  if (drive.multiplier == 0) return {};
  const double a = (joint.lower - drive.offset) / drive.multiplier;
  const double b = (joint.upper - drive.offset) / drive.multiplier;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

void Assembly::add_limits() {
  m_.first_limit = m_.pairs.size();
  std::vector<Range> range(static_cast<std::size_t>(m_.tree.n_v));
  // what a joint says itself comes before what its mimics say
  std::vector<JointInfo> joints = m_.joints;
  std::stable_partition(joints.begin(), joints.end(), [&](const JointInfo& info) {
    return base_[joint_.at(info.name)] == joint_.at(info.name);
  });
  for (const JointInfo& info : joints) {
    const int spec = joint_.at(info.name);
    const JointSpec& joint = d_.joints[spec];
    if (!has_one_coordinate(joint.type) || !has(joint.effects, JointEffects::limits)) continue;
    Range& all = range[static_cast<std::size_t>(info.velocities.front())];
    const Range own = range_of(joint, drive_[spec]);
    const Range both{std::max(all.lower, own.lower), std::min(all.upper, own.upper)};
    if (!both.is_empty()) {
      all = both;
      continue;
    }
    m_.warnings.push_back("the limits of joint " + quoted(joint.name) + " and those of joint " +
                          quoted(d_.joints[base_[spec]].name) +
                          ", which it mimics, leave nothing; its own are not used");
  }
  for (const JointInfo& info : m_.joints) {
    const int spec = joint_.at(info.name);
    if (base_[spec] != spec || !has_one_coordinate(info.type)) continue;
    const int c = info.velocities.front();
    const Range& limits = range[static_cast<std::size_t>(c)];
    const double e = d_.joints[spec].limit_restitution;
    const auto add = [&](const char* side, const Stop& stop) {
      if (!std::isfinite(stop.bound)) return;
      m_.limits.push_back({info.name + side, info.frames.front(), m_.tree.coordinate[c], stop, e});
    };
    add(" lower limit", {+1, limits.lower});
    add(" upper limit", {-1, limits.upper});
  }
}

}  // namespace saltus
