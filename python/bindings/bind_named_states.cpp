// Model floor: states by name.
#include "bindings.hpp"
#include "saltus/model/named_state.hpp"

namespace saltus::bindings {
namespace {

constexpr auto add_state_doc =
    R"(Adds a state by name, as MuJoCo's keyframes and SRDF's group states.

`model.state("home")` gives it, and wherever a function takes `q` it takes the name.

Parameters
----------
name : str
q : mapping of joints' names to values, optional
    [rad | m] one number, or for joints of several a sequence or a Pose. Other joints are as in
    `Model.neutral`.
v : mapping of joints' names to values, optional
    [rad/s | m/s] 0 of other joints.

Returns
-------
ModelBuilder
    The builder itself.

Raises
------
ModelError
    On a name that is taken, joints that do not exist, are fixed or mimic others, values that are
    not finite, too many, or outside of limits that act.

Examples
--------
>>> import saltus
>>> builder = saltus.read_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
>>> model = builder.add_state("lifted", q={"swing_0": 0.3}).build()
>>> float(model.state("lifted").q[0])
0.3
)";

/// What a user gives for joints.
struct JointNumbers {
  static constexpr auto type_name =
      py::detail::const_name("collections.abc.Mapping[str, object] | None");
  py::object value;
};

StateSpec::Numbers to_numbers_by_joint(const JointNumbers& given, const char* what) {
  StateSpec::Numbers out;
  if (given.value.is_none()) return out;
  if (!py::hasattr(given.value, "items")) {
    throw ModelError(std::string(what) + " = " + py::repr(given.value).cast<std::string>() +
                     "; it is a mapping of joints' names to numbers");
  }
  for (const py::handle item : given.value.attr("items")()) {
    const auto [key, value] = item.cast<std::pair<py::object, py::object>>();
    const auto joint = py::str(key).cast<std::string>();
    out[joint] = numbers_in(value, std::string(what) + "[\"" + joint + "\"]");
  }
  return out;
}

}  // namespace

void bind_named_states(py::class_<ModelBuilder>& c) {
  c.def(
      "add_state",
      [](ModelBuilder& builder, const std::string& name, const JointNumbers& q,
         const JointNumbers& v) -> ModelBuilder& {
        return builder.add_state({name, to_numbers_by_joint(q, "q"), to_numbers_by_joint(v, "v")});
      },
      py::return_value_policy::reference_internal, add_state_doc, py::arg("name"),
      py::arg("q") = py::none(), py::arg("v") = py::none());
}

}  // namespace saltus::bindings
