// Model floor: what a model measures by name.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "pickle.hpp"
#include "saltus/model/named_state.hpp"
#include "saltus/model/sensor.hpp"

namespace saltus::bindings {
namespace {

constexpr auto kind_doc = R"(What a sensor measures; names are MuJoCo's where it has one.

jointpos, jointvel
    [rad | m], [rad/s | m/s] of a joint: one number, or all of a joint of several.
actuatorfrc
    [N m | N] what an actuator pushes with, after its limits.
framepos, framequat
    [m] where a point of a link is, in the world; how its frame is turned, x y z w.
framelinvel, frameangvel
    [m/s], [rad/s] of that frame, in the world's axes.
velocimeter, gyro
    The same in the frame's own axes.
accelerometer
    [m/s^2] acceleration of the point less gravity, in the frame's own axes.
touch
    [N] sum of the normal forces on a link.
contactforce
    [N] sum of the contact forces on a link, friction included, in the world's axes.
)";

constexpr auto sensor_doc = R"(What a model measures by name; made by `ModelBuilder.add_sensor`.)";

constexpr auto add_sensor_doc = R"(Adds a sensor: `run.sensor(name)` reads it from recorded rows.

It has no part in the motion. A policy has it as `now.sensors[name]`.

Parameters
----------
name : str
kind : SensorKind or str
joint : str, optional
    Of jointpos and jointvel.
actuator : str, optional
    Of actuatorfrc.
link : str, optional
    Of all others: the link that carries it.
other : str, optional
    Of touch and contactforce: the link or half-space whose contacts count; None: all.
X : Pose
    Where on the link it is, and how it is turned; of touch and contactforce it has no meaning.

Returns
-------
ModelBuilder
    The builder itself.

Raises
------
ModelError
    On a name that is taken, and on what it is of where that does not exist or is of another kind.

Examples
--------
>>> import saltus
>>> builder = saltus.ModelBuilder()
>>> builder = builder.add_body("stone", saltus.Sphere(0.1), mass=1.0)
>>> model = builder.add_sensor("imu", "accelerometer", link="stone").build()
>>> model.sensors
[Sensor('imu', accelerometer of link 'stone')]
)";

using Name = std::optional<std::string>;

ModelBuilder& add_sensor(ModelBuilder& builder, const std::string& name,
                         const Choice<SensorKind>& kind, const Name& joint, const Name& actuator,
                         const Name& link, const Name& other, const Pose& X) {
  SensorSpec spec{name, to_enum(kind, "kind"), {}, other.value_or(""), X};
  const std::string wanted = sensor_element(spec.kind);
  const std::pair<const char*, const Name*> given[] = {
      {"joint", &joint}, {"actuator", &actuator}, {"link", &link}};
  for (const auto& [element, of] : given) {
    const bool is_wanted = wanted == element;
    if (is_wanted && *of) spec.of = **of;
    if (is_wanted == of->has_value()) continue;
    throw ModelError("sensor \"" + name + "\" is of kind " +
                         py::cast(spec.kind).attr("name").cast<std::string>() +
                         ", which is of one " + wanted + ": give it by " + wanted + "= alone",
                     "sensor", name);
  }
  return builder.add_sensor(spec);
}

}  // namespace

void bind_sensors(py::module_& m) {
  py::native_enum<SensorKind>(m, "SensorKind", "enum.Enum", kind_doc)
      .value("jointpos", SensorKind::jointpos)
      .value("jointvel", SensorKind::jointvel)
      .value("actuatorfrc", SensorKind::actuatorfrc)
      .value("framepos", SensorKind::framepos)
      .value("framequat", SensorKind::framequat)
      .value("framelinvel", SensorKind::framelinvel)
      .value("frameangvel", SensorKind::frameangvel)
      .value("velocimeter", SensorKind::velocimeter)
      .value("gyro", SensorKind::gyro)
      .value("accelerometer", SensorKind::accelerometer)
      .value("touch", SensorKind::touch)
      .value("contactforce", SensorKind::contactforce)
      .finalize();
  using S = SensorSpec;
  py::class_<S>(m, "Sensor", sensor_doc)
      .def_readonly("name", &S::name)
      .def_readonly("kind", &S::kind)
      .def_readonly("of", &S::of, "the joint, the actuator, or the link that carries it")
      .def_readonly("other", &S::other, "whose contacts count, \"\": all")
      .def_readonly("X", &S::X_LS, "Pose in the link's frame")
      .def("__repr__",
           [](const S& s) {
             return "Sensor('" + s.name + "', " +
                    py::cast(s.kind).attr("name").cast<std::string>() + " of " +
                    sensor_element(s.kind) + " '" + s.of + "'" +
                    (s.other.empty() ? "" : " with '" + s.other + "'") + ")";
           })
      .def(pickle_fields<S, &S::name, &S::kind, &S::of, &S::other, &S::X_LS>());
}

void bind_add_sensor(py::class_<ModelBuilder>& c) {
  c.def("add_sensor", &add_sensor, py::return_value_policy::reference_internal, add_sensor_doc,
        py::arg("name"), py::arg("kind"), py::kw_only(), py::arg("joint") = py::none(),
        py::arg("actuator") = py::none(), py::arg("link") = py::none(),
        py::arg("other") = py::none(), py::arg_v("X", Pose{}, "Pose()"));
}

namespace {

/// What actuators push with at many (q, v, u): rows (rows, n_u).
MatX actuator_forces(const Model& model, const MatX& q, const MatX& v, const MatX& control) {
  const ForceModel& forces = model->forces;
  const auto check = [&](const MatX& x, int columns, const char* what) {
    if (x.rows() == q.rows() && x.cols() == columns) return;
    throw ModelError(std::string(what) + " has shape (" + std::to_string(x.rows()) + ", " +
                     std::to_string(x.cols()) + "); it must have shape (" +
                     std::to_string(q.rows()) + ", " + std::to_string(columns) + ")");
  };
  check(q, model.n_q(), "q");
  check(v, model.n_v(), "v");
  check(control, forces.n_u(), "control");
  ForceValues values(forces, model.n_v());
  ForceInput input;
  MatX out(q.rows(), forces.n_u());
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    input.control = control.row(i);
    set_forces(forces, q.row(i).transpose(), v.row(i).transpose(), input, values);
    out.row(i) = values.effort;
  }
  return out;
}

constexpr auto actuator_forces_doc =
    R"(What actuators push with, after their limits and the joints'.

Parameters
----------
q : array_like, shape (rows, n_q)
    [rad | m]
v : array_like, shape (rows, n_v)
    [rad/s | m/s]
control : array_like, shape (rows, n_u)

Returns
-------
numpy.ndarray, shape (rows, n_u)
    [N m | N] of each actuator, before its gear.

Raises
------
ModelError
    On shapes that do not fit.
)";

}  // namespace

void bind_model_sensors(py::class_<Model>& c) {
  c.def_property_readonly(
       "sensors", [](const Model& m) -> const auto& { return m->description->sensors; },
       "what it measures by name, see `ModelBuilder.add_sensor`")
      .def_property_readonly("state_names", &state_names,
                             "of states that `state` gives by name, see `ModelBuilder.add_state`")
      .def_property_readonly("sensor_names",
                             [](const Model& m) { return names_of(m->description->sensors); })
      .def("actuator_forces", &actuator_forces, actuator_forces_doc, py::arg("q"), py::arg("v"),
           py::arg("control"));
}

}  // namespace saltus::bindings
