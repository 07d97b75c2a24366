// Model floor: springs between points, compensation of gravity, forces that are functions.
#include "bindings.hpp"
#include "functions.hpp"
#include "pickle.hpp"
#include "saltus/model/check_derivatives.hpp"
#include "spring_docs.hpp"

namespace saltus::bindings {
namespace {

constexpr auto self = py::return_value_policy::reference_internal;
using B = ModelBuilder;

B& add_joint_spring(B& builder, const std::string& joint, double stiffness, double rest,
                    const std::optional<std::pair<std::vector<double>, std::vector<double>>>& curve,
                    const std::optional<std::array<double, 2>>& slopes) {
  if (!curve) {
    if (!slopes) return builder.add_joint_spring(joint, stiffness, rest);
    throw ModelError("slopes are of a curve, and joint \"" + joint + "\" is given none", "joint",
                     joint);
  }
  if (stiffness != 0 || rest != 0) {
    throw ModelError("joint \"" + joint + "\" is given a curve, and a stiffness or rest besides",
                     "joint", joint);
  }
  return builder.add_joint_spring(joint, curve->first, curve->second, slopes);
}

void check_function(const py::object& force, const Model& model,
                    const std::vector<std::string>& coordinates) {
  FunctionForce checked{"function", {}, to_force_function("function", force)};
  for (const std::string& name : coordinates) {
    checked.velocities.push_back(model.velocity_index(name));
  }
  for (int c = 0; c < model.n_v() && coordinates.empty(); ++c) checked.velocities.push_back(c);
  check_derivatives(model, checked);
}

}  // namespace

void bind_points(py::module_& m) {
  py::class_<PythonMoment>(m, "ForceMoment", docs::force_moment)
      .def_readonly("t", &PythonMoment::t)
      .def_property_readonly(
          "q", [](const PythonMoment& now) { return now.q; }, "shape (n_q,)")
      .def_property_readonly(
          "v", [](const PythonMoment& now) { return now.v; }, "shape (n_v,)")
      .def("__repr__", [](const PythonMoment& now) {
        return "ForceMoment(t=" + py::repr(py::float_(now.t)).cast<std::string>() + ")";
      });
}

void bind_springs(py::class_<B>& c) {
  c.def("add_joint_spring", &add_joint_spring, self, docs::add_joint_spring, py::arg("joint"),
        py::kw_only(), py::arg("stiffness") = 0.0, py::arg("rest") = 0.0,
        py::arg("curve") = py::none(), py::arg("slopes") = py::none())
      .def(
          "add_spring",
          [](B& builder, const std::string& name, const AtOrLink& a, const AtOrLink& b,
             double stiffness, double length, double damping) -> B& {
            return builder.add_spring({name, to_at(a), to_at(b), stiffness, length, damping});
          },
          self, docs::add_spring, py::arg("name"), py::kw_only(), py::arg("a"), py::arg("b"),
          py::arg("stiffness") = 0.0, py::arg("length") = 0.0, py::arg("damping") = 0.0)
      .def("set_gravity_compensation", &B::set_gravity_compensation, self,
           docs::set_gravity_compensation, py::arg("link"), py::arg("part") = 1.0)
      .def(
          "add_force",
          [](B& builder, const std::string& name,
             const py::typing::Callable<py::object(PythonMoment)>& function,
             const std::vector<std::string>& coordinates) -> B& {
            return builder.add_force({name, to_force_function(name, function), coordinates});
          },
          self, docs::add_force, py::arg("name"), py::arg("function"), py::kw_only(),
          py::arg_v("coordinates", std::vector<std::string>{}, "()"))
      .def(
          "add_potential",
          [](B& builder, const std::string& name,
             const py::typing::Callable<py::object(VecX)>& value,
             const py::typing::Callable<py::object(VecX)>& gradient,
             const py::typing::Callable<py::object(VecX)>& hessian) -> B& {
            return builder.add_potential(to_potential(name, value, gradient, hessian));
          },
          self, docs::add_potential, py::arg("name"), py::arg("value"), py::arg("gradient"),
          py::arg("hessian"));
}

void bind_check_derivatives(py::module_& m) {
  using Force = py::typing::Union<py::str, py::typing::Callable<py::object(PythonMoment)>>;
  m.def(
      "check_derivatives",
      [](const Force& force, const Model& model, const std::vector<std::string>& coordinates) {
        if (py::isinstance<py::str>(force)) {
          check_derivatives(model, py::str(force).cast<std::string>());
        } else {
          check_function(force, model, coordinates);
        }
      },
      docs::check_derivatives, py::arg("force"), py::arg("model"), py::kw_only(),
      py::arg_v("coordinates", std::vector<std::string>{}, "()"));
}

}  // namespace saltus::bindings
