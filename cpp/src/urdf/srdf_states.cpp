// States by name, from SRDF.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "urdf/numbers.hpp"
#include "urdf/srdf.hpp"
#include "urdf/warnings.hpp"

namespace saltus::reader {
namespace {

class GroupStates {
 public:
  GroupStates(const Document& srdf, const ModelDescription& description, bool strict)
      : srdf_(srdf), d_(description), warnings_(strict) {}

  std::vector<StateSpec> read() {
    std::map<std::string, int> count;
    const std::vector<const XMLElement*> elements = srdf_.all("group_state");
    for (const XMLElement* e : elements) ++count[given(srdf_, *e, "name")];
    std::vector<StateSpec> states;
    for (const XMLElement* e : elements) {
      std::string name = given(srdf_, *e, "name");
      if (count[name] > 1) name = given(srdf_, *e, "group") + "/" + name;
      const bool is_taken = std::any_of(states.begin(), states.end(),
                                        [&](const StateSpec& state) { return state.name == name; });
      if (is_taken) {
        warnings_.add_flaw("twice", srdf_.at(*e) + "two states are named " + in_quotes(name),
                           "; the first is used");
        continue;
      }
      states.push_back(state(*e, name));
    }
    return states;
  }

  std::vector<std::string> warnings() const { return warnings_.lines(); }

 private:
  StateSpec state(const XMLElement& element, const std::string& name) {
    StateSpec state{name};
    for (auto e = element.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      const std::string said = given(srdf_, *e, "name"), joint = own_name(said);
      if (joint.empty()) continue;
      const std::string start =
          srdf_.at(*e) + "state " + in_quotes(name) + " names joint " + in_quotes(said);
      const std::vector<double> values = numbers(*e);
      const auto found = std::find_if(d_.joints.begin(), d_.joints.end(),
                                      [&](const JointSpec& each) { return each.name == joint; });
      if (found == d_.joints.end()) {
        warnings_.add("unknown joint", start + ", which the robot has not; it is not used");
      } else if (is_usable(*found, start, values)) {
        state.q[joint] = within_limits(*found, start, values);
      }
    }
    drop_mimics(element, state);
    return state;
  }

  /// A virtual joint is the one that holds its child to the world, under whatever name; "" where
  /// the child is the root itself, which does not move.
  std::string own_name(const std::string& joint) const {
    for (const XMLElement* e : srdf_.all("virtual_joint")) {
      if (attribute(*e, "name") != joint) continue;
      for (const JointSpec& each : d_.joints) {
        if (each.parent == d_.root && each.child == attribute(*e, "child_link")) return each.name;
      }
      return "";
    }
    return joint == "root_joint" ? free_root() : joint;
  }

  /// "root_joint" is what Pinocchio calls a free root: that of this name, or the one at the root.
  std::string free_root() const {
    std::string root;
    for (const JointSpec& each : d_.joints) {
      if (each.name == "root_joint") return each.name;
      if (each.parent == d_.root && each.type == JointType::floating) root = each.name;
    }
    return root;
  }

  std::vector<double> numbers(const XMLElement& joint) const {
    const std::string text = given(srdf_, joint, "value");
    const Numbers read = parse_numbers(text);
    const auto is_number = [](double x) { return std::isfinite(x); };
    if (read.bad.empty() && !read.values.empty() &&
        std::all_of(read.values.begin(), read.values.end(), is_number)) {
      return read.values;
    }
    srdf_.fail(joint, {"joint", attribute(joint, "name")},
               "has value=" + in_quotes(text) + "; it is a number, or several");
  }

  bool is_usable(const JointSpec& joint, const std::string& start,
                 const std::vector<double>& values) {
    if (joint.type == JointType::fixed) {
      warnings_.add("fixed joint", start + ", which is fixed; it is not used");
      return false;
    }
    const auto count = static_cast<std::size_t>(coordinates_of(joint.type));
    const bool fits = values.size() == count;
    if (!fits) {
      warnings_.add_flaw("count",
                         start + " with " + counted(static_cast<long>(values.size()), "number") +
                             "; it takes " + counted(static_cast<long>(count), "number"),
                         "; it is not used");
    }
    return fits;
  }

  std::vector<double> within_limits(const JointSpec& joint, const std::string& start,
                                    std::vector<double> values) {
    if (!has(joint.effects, JointEffects::limits) || values.size() != 1 || joint.mimic) {
      return values;
    }
    const double nearest = std::clamp(values[0], joint.lower, joint.upper);
    if (nearest == values[0]) return values;
    warnings_.add_flaw("limits",
                       start + " at " + print_number(values[0]) + ", outside of its limits " +
                           print_number(joint.lower) + " to " + print_number(joint.upper),
                       "; it is put onto the limit");
    return {nearest};
  }

  /// Joints that mimic others follow them: files that name them all say the same twice.
  void drop_mimics(const XMLElement& element, StateSpec& state) {
    const StateSpec::Numbers all = state.q;
    for (const JointSpec& joint : d_.joints) {
      if (!joint.mimic || state.q.erase(joint.name) == 0) continue;
      const auto of = all.find(joint.mimic->joint);
      const double base = of == all.end() ? 0 : of->second.front();
      const double follows = joint.mimic->multiplier * base + joint.mimic->offset;
      const double said = all.at(joint.name).front();
      if (std::abs(said - follows) <= 1e-3) continue;  // of numbers of three digits
      warnings_.add_flaw("mimic",
                         srdf_.at(element) + "state " + in_quotes(state.name) + " puts joint " +
                             in_quotes(joint.name) + " to " + print_number(said) + ", which is " +
                             print_number(follows) + " as it mimics joint " +
                             in_quotes(joint.mimic->joint),
                         "; it follows that");
    }
  }

  const Document& srdf_;
  const ModelDescription& d_;
  Warnings warnings_;
};

}  // namespace

void add_group_states(const Document& srdf, bool strict, ModelBuilder& builder) {
  GroupStates states(srdf, builder.description(), strict);
  for (const StateSpec& state : states.read()) {
    try {
      builder.add_state(state);
    } catch (const ModelError& error) {
      throw ModelError(srdf.label() + ": " + error.what(), error.element, error.name);
    }
  }
  for (const std::string& warning : states.warnings()) builder.add_warning(warning);
}

}  // namespace saltus::reader
