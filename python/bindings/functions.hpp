// Forces and potentials that Python functions make.
#pragma once

#include "bindings.hpp"

namespace saltus::bindings {

/// Where a force is asked for, as its function sees it.
struct PythonMoment {
  double t;
  py::array q, v;
};

/// A function(now) that returns Q, or (Q, Q_q, Q_v).
ForceFunction to_force_function(const std::string& name, const py::object& function);

/// A function(t) that returns the displacement of a joint, its rate and perhaps the rate of that.
std::function<PrescribedMotion(double)> to_motion(const std::string& joint,
                                                  const py::object& function);

/// Of functions of q.
PotentialFunction to_potential(const std::string& name, const py::object& value,
                               const py::object& gradient, const py::object& hessian);

}  // namespace saltus::bindings
