// States by name: said of joints, checked, and found again.
#include "saltus/model/named_state.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"

namespace saltus {

int coordinates_of(JointType type) {
  switch (type) {
    case JointType::fixed:
      return 0;
    case JointType::planar:
      return 3;
    case JointType::floating:
      return 7;
    case JointType::spherical:
      return 4;
    default:
      return 1;
  }
}

int velocities_of(JointType type) {
  const bool has_ball = type == JointType::floating || type == JointType::spherical;
  return coordinates_of(type) - (has_ball ? 1 : 0);
}

namespace {

[[noreturn]] void fail(const StateSpec& state, const std::string& what) {
  throw ModelError("state " + quoted(state.name) + " " + what, "state", state.name);
}

/// "q["elbow"]"
std::string entry(const char* what, const std::string& joint) {
  return std::string(what) + "[" + quoted(joint) + "]";
}

const JointSpec& joint_of(const StateSpec& state, const std::string& name,
                          const ModelDescription& d) {
  std::vector<std::string> names;
  for (const JointSpec& joint : d.joints) {
    if (joint.name == name) return joint;
    if (joint.type != JointType::fixed && !joint.mimic) names.push_back(joint.name);
  }
  fail(state, "names joint " + quoted(name) + ", which does not exist; joints that move are " +
                  list_names(names));
}

void check_numbers(const StateSpec& state, const char* what, const JointSpec& joint,
                   const std::vector<double>& numbers, int count) {
  if (joint.mimic) {
    fail(state, "names joint " + quoted(joint.name) + ", which mimics joint " +
                    quoted(joint.mimic->joint) + " and follows it");
  }
  if (count == 0) fail(state, "names joint " + quoted(joint.name) + ", which is fixed");
  if (static_cast<int>(numbers.size()) != count) {
    fail(state, "has " + counted(static_cast<long>(numbers.size()), "number") + " in " +
                    entry(what, joint.name) + "; the joint takes " + counted(count, "number"));
  }
  for (const double x : numbers) {
    if (std::isfinite(x)) continue;
    std::ostringstream text;
    text << "has " << x << " in " << entry(what, joint.name) << "; numbers are finite";
    fail(state, text.str());
  }
}

void check_quaternion(const StateSpec& state, const JointSpec& joint,
                      const std::vector<double>& q) {
  if (joint.type != JointType::floating && joint.type != JointType::spherical) return;
  const double square = Eigen::Map<const Eigen::Vector4d>(q.data() + q.size() - 4).squaredNorm();
  if (std::abs(square - 1) <= 2e-6) return;  // as Model::checked_q
  std::ostringstream text;
  text.precision(9);
  text << "has a quaternion of length " << std::sqrt(square) << " in " << entry("q", joint.name)
       << "; its length is 1 (x y z w, the identity is 0 0 0 1)";
  fail(state, text.str());
}

void check_limits(const StateSpec& state, const JointSpec& joint, const std::vector<double>& q) {
  if (!Assembly::has_one_coordinate(joint.type) || !has(joint.effects, JointEffects::limits)) {
    return;
  }
  if (q[0] >= joint.lower && q[0] <= joint.upper) return;
  std::ostringstream text;
  text << "has " << entry("q", joint.name) << " = " << q[0] << ", outside of its limits "
       << joint.lower << " to " << joint.upper;
  fail(state, text.str());
}

}  // namespace

ModelBuilder& ModelBuilder::add_state(const StateSpec& state) {
  if (state.name.empty()) throw ModelError("a state has no name", "state", "");
  for (const StateSpec& other : d_.states) {
    if (other.name == state.name) {
      throw ModelError("two states are named " + quoted(state.name), "state", state.name);
    }
  }
  for (const auto& [name, numbers] : state.q) {
    const JointSpec& joint = joint_of(state, name, d_);
    check_numbers(state, "q", joint, numbers, coordinates_of(joint.type));
    check_quaternion(state, joint, numbers);
    check_limits(state, joint, numbers);
  }
  for (const auto& [name, numbers] : state.v) {
    const JointSpec& joint = joint_of(state, name, d_);
    check_numbers(state, "v", joint, numbers, velocities_of(joint.type));
  }
  d_.states.push_back(state);
  return *this;
}

namespace {

/// Writes the numbers of the joints that are named; joints that were changed since are left out.
void set_numbers(const ModelData& model, const StateSpec::Numbers& given,
                 std::vector<int> JointInfo::* of_joint, VecX& x) {
  for (const JointInfo& joint : model.joints) {
    const auto found = given.find(joint.name);
    if (found == given.end() || !joint.mimics.empty()) continue;
    const std::vector<int>& indices = joint.*of_joint;
    const std::size_t count = std::min(indices.size(), found->second.size());
    for (std::size_t k = 0; k < count; ++k) x[indices[k]] = found->second[k];
  }
}

const StateSpec& spec_of(const Model& model, const std::string& name) {
  return named(model->description->states, "state", name, "there");
}

}  // namespace

/// What a state says may be outside of limits that were set after it, or that a mimic has.
void Assembly::warn_of_states() {
  for (const StateSpec& state : d_.states) {
    VecX q = VecX::Zero(m_.tree.n_q);
    for (const JointLimit& limit : m_.limits) q[limit.coordinate] = limit.stop.bound;
    set_numbers(m_, state.q, &JointInfo::coordinates, q);
    for (const JointLimit& limit : m_.limits) {
      const std::string& joint = m_.coordinates[limit.coordinate].joint;
      if (state.q.count(joint) == 0) continue;
      if (limit.stop.side * (q[limit.coordinate] - limit.stop.bound) >= 0) continue;
      std::ostringstream text;
      text << "state " << quoted(state.name) << " has " << entry("q", joint) << " = "
           << q[limit.coordinate] << ", beyond the " << limit.name << " " << limit.stop.bound
           << "; no run starts there";
      m_.warnings.push_back(text.str());
    }
  }
}

std::vector<std::string> state_names(const Model& model) {
  std::vector<std::string> names;
  for (const StateSpec& state : model->description->states) names.push_back(state.name);
  return names;
}

VecX named_q(const Model& model, const std::string& name) {
  VecX q = model.neutral();
  set_numbers(*model, spec_of(model, name).q, &JointInfo::coordinates, q);
  return model.checked_q(q, "q");
}

VecX named_v(const Model& model, const std::string& name) {
  VecX v = VecX::Zero(model.n_v());
  set_numbers(*model, spec_of(model, name).v, &JointInfo::velocities, v);
  return v;
}

State named_state(const Model& model, const std::string& name, double t) {
  return model.state(named_q(model, name), named_v(model, name), t);
}

}  // namespace saltus
