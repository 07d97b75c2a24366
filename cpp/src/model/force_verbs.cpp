// ModelBuilder's verbs for forces.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "model/force_checks.hpp"

namespace saltus {
namespace {

[[noreturn]] void fail(const std::string& element, const std::string& name,
                       const std::string& what) {
  throw ModelError(element + " " + quoted(name) + " " + what, element, name);
}

std::string show(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

void check_not_negative(const JointSpec& joint, double number, const std::string& what) {
  if (is_force_number(number, false)) return;
  fail("joint", joint.name, "has " + what + " " + refused_number(number, false));
}

}  // namespace

bool is_force_number(double number, bool may_be_negative) {
  return std::abs(number) <= most_number && (may_be_negative || number >= 0);
}

std::string refused_number(double number, bool may_be_negative) {
  std::string text = show(number) + "; it is finite";
  if (!may_be_negative) text += " and at least 0";
  if (std::isfinite(number) && std::abs(number) > most_number) {
    text += ", and at most " + show(most_number) + ", beyond which arithmetic ends";
  }
  return text;
}

void check_forces(const JointSpec& joint) {
  // friction and damping that are nothing but information may be what they are
  if (has(joint.effects, JointEffects::damping)) {
    check_not_negative(joint, joint.damping, "damping");
    check_not_negative(joint, joint.armature, "armature");
    check_not_negative(joint, joint.stiffness, "stiffness");
    if (!is_force_number(joint.rest, true)) {
      fail("joint", joint.name, "has a spring's rest at " + refused_number(joint.rest, true));
    }
    check_curve(joint);
  }
  if (has(joint.effects, JointEffects::friction)) {
    check_not_negative(joint, joint.friction, "friction");
  }
  if (!(joint.limit_restitution >= 0 && joint.limit_restitution <= 1)) {
    fail("joint", joint.name,
         "has restitution " + show(joint.limit_restitution) + " at its limits; it is in 0 .. 1");
  }
  const bool is_ball = joint.type == JointType::floating || joint.type == JointType::spherical;
  if (is_ball && joint.friction > 0 && has(joint.effects, JointEffects::friction)) {
    fail("joint", joint.name,
         "has dry friction, which only joints of one coordinate and planar ones can have");
  }
  const bool has_spring = joint.stiffness > 0 || !joint.curve_x.empty();
  if ((joint.armature > 0 || has_spring) && !Assembly::has_one_coordinate(joint.type)) {
    fail("joint", joint.name,
         "has an armature or a spring, which only joints of one coordinate can");
  }
}

void check_actuator(const ActuatorSpec& a) {
  if (a.name.empty()) throw ModelError("an actuator has no name", "actuator", "");
  for (const char* other : other_sources) {
    if (a.name != other) continue;
    fail("actuator", a.name, "has a name that work has already: damping, friction, applied");
  }
  if (a.joints.empty()) fail("actuator", a.name, "moves no joint");
  for (const double number : {a.gain, a.bias, a.bias_l, a.bias_v}) {
    if (is_force_number(number, true)) continue;
    fail("actuator", a.name, "has a gain or bias of " + refused_number(number, true));
  }
  for (const auto& [joint, ratio] : a.joints) {
    if (is_force_number(ratio, true)) continue;
    fail("actuator", a.name,
         "moves joint " + quoted(joint) + " with a ratio of " + refused_number(ratio, true));
  }
  if (!(a.effort > 0)) {
    fail("actuator", a.name, "has effort " + show(a.effort) + "; it is positive, or infinite");
  }
  if (!(a.lower <= a.upper)) {
    fail("actuator", a.name,
         "takes controls from " + show(a.lower) + " to " + show(a.upper) + ", which are none");
  }
}

JointSpec& ModelBuilder::joint(const std::string& name) {
  return named(d_.joints, "joint", name, "joints");
}

ModelBuilder& ModelBuilder::add_actuator(const ActuatorSpec& actuator) {
  check_actuator(actuator);
  for (const ActuatorSpec& other : d_.actuators) {
    if (other.name != actuator.name) continue;
    throw ModelError("two actuators are named " + quoted(actuator.name), "actuator", actuator.name);
  }
  for (const auto& [name, ratio] : actuator.joints) {
    const JointSpec& moved = joint(name);
    if (Assembly::has_one_coordinate(moved.type)) continue;
    fail("actuator", actuator.name,
         "moves joint " + quoted(name) + ", which has not one coordinate");
  }
  d_.actuators.push_back(actuator);
  return *this;
}

ModelBuilder& ModelBuilder::add_motor(const std::string& name, const std::string& joint,
                                      double gear, double effort) {
  return add_actuator({.name = name,
                       .joints = {{joint, gear}},
                       .effort = effort,
                       .lower = -effort,
                       .upper = effort});
}

namespace {

void check_servo_gain(const std::string& servo, const char* gain, double value) {
  if (value >= 0) return;
  std::ostringstream text;
  text << "servo \"" << servo << "\" has " << gain << " = " << value
       << "; a servo's gain is at least 0 (add_actuator takes any)";
  throw ModelError(text.str(), "actuator", servo);
}

}  // namespace

ModelBuilder& ModelBuilder::add_position_servo(const std::string& name, const std::string& joint,
                                               double kp, double kd, double effort) {
  check_servo_gain(name, "kp", kp);
  check_servo_gain(name, "kd", kd);
  return add_actuator({.name = name,
                       .joints = {{joint, 1}},
                       .gain = kp,
                       .bias_l = -kp,
                       .bias_v = -kd,
                       .effort = effort});
}

ModelBuilder& ModelBuilder::add_velocity_servo(const std::string& name, const std::string& joint,
                                               double kv, double effort) {
  check_servo_gain(name, "kv", kv);
  return add_actuator(
      {.name = name, .joints = {{joint, 1}}, .gain = kv, .bias_v = -kv, .effort = effort});
}

namespace {

/// Changes a copy, and takes it where it is a joint.
template <class Change>
void change(JointSpec& joint, const Change& change) {
  JointSpec changed = joint;
  change(changed);
  check_forces(changed);
  joint = changed;
}

}  // namespace

ModelBuilder& ModelBuilder::set_armature(const std::string& name, double armature) {
  change(joint(name), [&](JointSpec& j) { j.armature = armature; });
  return *this;
}

ModelBuilder& ModelBuilder::set_damping(const std::string& name, double damping) {
  change(joint(name), [&](JointSpec& j) { j.damping = damping; });
  return *this;
}

ModelBuilder& ModelBuilder::set_friction(const std::string& name, double friction) {
  change(joint(name), [&](JointSpec& j) { j.friction = friction; });
  return *this;
}

ModelBuilder& ModelBuilder::set_limit(const std::string& name, double lower, double upper,
                                      double restitution) {
  JointSpec& limited = joint(name);
  if (!Assembly::has_one_coordinate(limited.type))
    fail("joint", name, "has not one coordinate that limits are of");
  if (!(lower <= upper)) {
    fail("joint", name, "has lower limit " + show(lower) + " and upper limit " + show(upper));
  }
  change(limited, [&](JointSpec& j) {
    j.lower = lower;
    j.upper = upper;
    j.limit_restitution = restitution;
  });
  return *this;
}

ModelBuilder& ModelBuilder::set_limit_restitution(const std::string& name, double restitution) {
  change(joint(name), [&](JointSpec& j) { j.limit_restitution = restitution; });
  return *this;
}

ModelBuilder& ModelBuilder::add_joint_spring(const std::string& name, double stiffness,
                                             double rest) {
  change(joint(name), [&](JointSpec& j) {
    j.stiffness = stiffness;
    j.rest = rest;
    j.curve_x = j.curve_f = {};
    j.curve_slopes.reset();
  });
  return *this;
}

ModelBuilder& ModelBuilder::set_effects(const std::string& name, JointEffects effects) {
  change(joint(name), [&](JointSpec& j) { j.effects = effects; });
  return *this;
}

ModelBuilder& ModelBuilder::set_effects(JointEffects effects) {
  for (JointSpec& each : d_.joints) {
    change(each, [&](JointSpec& j) { j.effects = effects; });
  }
  return *this;
}

}  // namespace saltus
