// From what a user gives for controls and forces to what drives a run.
#pragma once

#include "bindings.hpp"
#include "saltus/rollout/control.hpp"

namespace saltus::bindings {

/// A force and a torque on a body, as a user writes them.
struct Wrench {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero(), point = Vec3::Zero();
  bool in_body = false;
};

/// What a user gives for forces: wrenches by the names of links, or None.
struct Wrenches {
  static constexpr auto type_name =
      py::detail::const_name("collections.abc.Mapping[str, Wrench] | None");
  py::object value;
};

/// None, a mapping of actuators' names, or an array (n_u). @throws ModelError on what is neither
VecX to_control(const py::object& x, const Model& model);

/// `forces` by the names of links.
ForceInput to_input(const py::object& control, const Wrenches& forces, const Velocities& qfrc,
                    const Model& model);

/// `control` also (steps, n_u), or a function of a Moment; the function is kept by the caller.
Policy to_policy(const py::object& control, const Wrenches& forces, const Velocities& qfrc,
                 const Model& model);

}  // namespace saltus::bindings
