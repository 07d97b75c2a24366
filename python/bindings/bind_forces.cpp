// Model floor: what drives joints.
#include <pybind11/native_enum.h>

#include <limits>

#include "bindings.hpp"
#include "control.hpp"
#include "force_docs.hpp"
#include "pickle.hpp"
#include "saltus/model/model_builder.hpp"
#include "saltus/model/stiff_damping.hpp"

namespace saltus::bindings {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto self = py::return_value_policy::reference_internal;
using B = ModelBuilder;

void bind_wrench(py::module_& m) {
  const auto show = [](const Vec3& x) {
    return py::str(py::cast(x).attr("tolist")()).cast<std::string>();
  };
  py::class_<Wrench>(m, "Wrench", docs::wrench)
      .def(py::init([](const Vec3& force, const Vec3& torque, const Vec3& point,
                       const std::string& frame) {
             if (frame != "world" && frame != "body") {
               throw ModelError("frame = \"" + frame + "\"; it is \"world\" or \"body\"");
             }
             return Wrench{force, torque, point, frame == "body"};
           }),
           py::arg_v("force", Vec3(Vec3::Zero()), "(0, 0, 0)"),
           py::arg_v("torque", Vec3(Vec3::Zero()), "(0, 0, 0)"), py::kw_only(),
           py::arg_v("point", Vec3(Vec3::Zero()), "(0, 0, 0)"), py::arg("frame") = "world")
      .def_readonly("force", &Wrench::force, "[N]")
      .def_readonly("torque", &Wrench::torque, "[N m]")
      .def_readonly("point", &Wrench::point, "[m] in the link's frame")
      .def_property_readonly("frame", [](const Wrench& w) { return w.in_body ? "body" : "world"; })
      .def("__repr__",
           [show](const Wrench& w) {
             return "Wrench(force=" + show(w.force) + ", torque=" + show(w.torque) +
                    ", point=" + show(w.point) + ", frame='" + (w.in_body ? "body" : "world") +
                    "')";
           })
      .def(pickle_fields<Wrench, &Wrench::force, &Wrench::torque, &Wrench::point,
                         &Wrench::in_body>());
}

B& add_actuator(B& builder, const std::string& name, const std::map<std::string, double>& joints,
                double gain, const std::array<double, 3>& bias, double effort,
                const std::array<double, 2>& control) {
  return builder.add_actuator({.name = name,
                               .joints = {joints.begin(), joints.end()},
                               .gain = gain,
                               .bias = bias[0],
                               .bias_l = bias[1],
                               .bias_v = bias[2],
                               .effort = effort,
                               .lower = control[0],
                               .upper = control[1]});
}

}  // namespace

void bind_joint_effects(py::module_& m) {
  py::native_enum<JointEffects>(m, "JointEffects", "enum.Flag", docs::joint_effects)
      .value("none", JointEffects::none)
      .value("limits", JointEffects::limits)
      .value("damping", JointEffects::damping)
      .value("friction", JointEffects::friction)
      .value("motors", JointEffects::motors)
      .value("all", JointEffects::all)
      .finalize();
  bind_wrench(m);
}

void bind_actuators(py::class_<B>& c) {
  c.def("add_motor", &B::add_motor, self, docs::add_motor, py::arg("name"), py::kw_only(),
        py::arg("joint"), py::arg("gear") = 1.0, py::arg_v("effort", infinity, "math.inf"))
      .def("add_position_servo", &B::add_position_servo, self, docs::add_position_servo,
           py::arg("name"), py::kw_only(), py::arg("joint"), py::arg("kp"), py::arg("kd") = 0.0,
           py::arg_v("effort", infinity, "math.inf"))
      .def("add_velocity_servo", &B::add_velocity_servo, self, docs::add_velocity_servo,
           py::arg("name"), py::kw_only(), py::arg("joint"), py::arg("kv"),
           py::arg_v("effort", infinity, "math.inf"))
      .def("add_actuator", &add_actuator, self, docs::add_actuator, py::arg("name"), py::kw_only(),
           py::arg("joints"), py::arg("gain") = 1.0,
           py::arg_v("bias", std::array<double, 3>{}, "(0.0, 0.0, 0.0)"),
           py::arg_v("effort", infinity, "math.inf"),
           py::arg_v("control", std::array<double, 2>{-infinity, infinity},
                     "(-math.inf, math.inf)"));
}

void bind_joint_forces(py::class_<B>& c) {
  c.def("set_armature", &B::set_armature, self,
        "[kg m^2 | kg] of a motor's rotor, as the joint feels it; returns the builder.",
        py::arg("joint"), py::arg("armature"))
      .def("set_damping", &B::set_damping, self,
           "[N m s/rad | N s/m] viscous; returns the builder. Of a floating or spherical joint it "
           "acts on the angular velocity.",
           py::arg("joint"), py::arg("damping"))
      .def("set_friction", &B::set_friction, self, "[N m | N] dry; returns the builder.",
           py::arg("joint"), py::arg("friction"))
      .def("set_limit", &B::set_limit, self, docs::set_limit, py::arg("joint"), py::arg("lower"),
           py::arg("upper"), py::kw_only(), py::arg("restitution") = 0.0)
      .def(
          "set_effects",
          [](B& builder, const Choice<JointEffects>& effects,
             const std::optional<std::string>& joint) -> B& {
            const JointEffects chosen = to_enum(effects, "effects");
            return joint ? builder.set_effects(*joint, chosen) : builder.set_effects(chosen);
          },
          self, docs::set_effects, py::arg("effects"), py::arg("joint") = py::none());
}

void bind_model_forces(py::class_<Model>& c) {
  const auto of_coordinates = [](const Model& m, const VecX& x) {
    return x.size() > 0 ? x : VecX(VecX::Zero(m.n_v()));
  };
  c.def_property_readonly(
       "n_u", [](const Model& m) { return m->forces.n_u(); }, "number of actuators")
      .def(
          "stiff_joints",
          [](const Model& m, double h, const Coordinates& q) {
            return stiff_joints(m, h, to_vector(q, m));
          },
          docs::stiff_joints, py::arg("h"), py::arg("q") = py::none())
      .def_property_readonly(
          "control_names", [](const Model& m) { return names_of(m->forces.actuators); },
          "names of the actuators, in the order of controls")
      .def_property_readonly(
          "control_limits",
          [](const Model& m) {
            MatX limits(m->forces.n_u(), 2);
            for (int k = 0; k < m->forces.n_u(); ++k) {
              const Actuator& a = m->forces.actuators[static_cast<std::size_t>(k)];
              limits.row(k) << a.lower, a.upper;
            }
            return limits;
          },
          "range of each control, shape (n_u, 2)")
      .def_property_readonly(
          "limit_names", [](const Model& m) { return names_of(m->limits); },
          "names of the joints' stops, which contacts and impacts may be at")
      .def_property_readonly(
          "damping", [=](const Model& m) { return of_coordinates(m, m->forces.damping); },
          "[N m s/rad | N s/m] that acts, shape (n_v,)")
      .def_property_readonly(
          "friction", [=](const Model& m) { return of_coordinates(m, m->forces.friction); },
          "[N m | N] that acts, shape (n_v,)")
      .def_property_readonly(
          "armature", [=](const Model& m) { return of_coordinates(m, m->mass.armature); },
          "[kg m^2 | kg] shape (n_v,)");
}

}  // namespace saltus::bindings
