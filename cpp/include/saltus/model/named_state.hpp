// States that a model has by name: "home", "ready". MuJoCo's keyframes, MoveIt's group states.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "saltus/model/model.hpp"

namespace saltus {

/// A state by name, as add_state takes it.
struct StateSpec {
  /// Joint -> its numbers.
  using Numbers = std::map<std::string, std::vector<double>>;

  std::string name;  ///< of the state
  Numbers q = {};    ///< by joint: all its coordinates; of other joints as in Model::neutral
  Numbers v = {};    ///< by joint: all its velocities; 0 of other joints
};

/// How many numbers a joint has in q.
SALTUS_EXPORT int coordinates_of(JointType type);
/// How many numbers a joint has in v.
SALTUS_EXPORT int velocities_of(JointType type);

/// In the order in which they were added.
SALTUS_EXPORT std::vector<std::string> state_names(const Model& model);

/// @throws ModelError on a name that no state has, with those there are.
SALTUS_EXPORT VecX named_q(const Model& model, const std::string& name);  ///< (n_q)
SALTUS_EXPORT VecX named_v(const Model& model, const std::string& name);  ///< (n_v)
/// Both, at a time [s]. @throws ModelError likewise.
SALTUS_EXPORT State named_state(const Model& model, const std::string& name, double t = 0);

}  // namespace saltus
