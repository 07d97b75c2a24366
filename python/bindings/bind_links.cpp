// Model floor: the links and joints of a model, as their author described them.
#include <cmath>

#include "bindings.hpp"
#include "model_builder_docs.hpp"
#include "model_docs.hpp"
#include "pickle.hpp"
#include "words.hpp"

namespace saltus::bindings {
namespace {

constexpr auto link_doc = R"(A rigid link of a model.

It stands for its index wherever one is taken.
)";

constexpr auto joint_doc = R"(A joint of a model, as its author described it.

It stands for its index in `joints` wherever one is taken.
)";

std::string number(double x) { return py::repr(py::float_(x)).cast<std::string>(); }

std::string name_of(JointType type) { return py::cast(type).attr("name").cast<std::string>(); }

const char* unit_of(const Coordinate& c) {
  return c.unit == Unit::metre ? "m" : c.unit == Unit::radian ? "rad" : "1";
}

std::string show_coordinate(const Coordinate& c) {
  std::string text = "Coordinate(" + in_quotes(c.name);
  if (c.joint != c.name) text += " of " + in_quotes(c.joint);
  text += std::string(", [") + unit_of(c) + "]";
  if (std::isfinite(c.lower) || std::isfinite(c.upper)) {
    text += ", " + printed("%.4g", c.lower) + " to " + printed("%.4g", c.upper);
  }
  return text + ")";
}

void bind_coordinate(py::module_& m) {
  py::class_<Coordinate>(m, "Coordinate", docs::coordinate)
      .def_readonly("name", &Coordinate::name, "the joint's, `<joint>_x` ... where it has several")
      .def_readonly("joint", &Coordinate::joint, "name of the joint that it belongs to")
      .def_property_readonly(
          "unit", [](const Coordinate& c) { return unit_of(c); },
          "\"m\", \"rad\", or \"1\" of a quaternion's numbers")
      .def_readonly("lower", &Coordinate::lower, "[rad | m] limit, -inf where there is none")
      .def_readonly("upper", &Coordinate::upper, "[rad | m] limit, inf where there is none")
      .def_readonly("velocity", &Coordinate::velocity, "[rad/s | m/s] limit, inf where none")
      .def_readonly("effort", &Coordinate::effort, "[N m | N] limit, inf where there is none")
      .def_readonly("damping", &Coordinate::damping, "[N m s/rad | N s/m]")
      .def_readonly("friction", &Coordinate::friction, "[N m | N]")
      .def("__repr__", &show_coordinate);
}

}  // namespace

void bind_links(py::module_& m) {
  bind_coordinate(m);
  py::class_<Mimic>(m, "Mimic", docs::mimic)
      .def(py::init([](const std::string& joint, double multiplier, double offset) {
             return Mimic{joint, multiplier, offset};
           }),
           py::arg("joint"), py::arg("multiplier") = 1.0, py::arg("offset") = 0.0)
      .def_readonly("joint", &Mimic::joint)
      .def_readonly("multiplier", &Mimic::multiplier)
      .def_readonly("offset", &Mimic::offset, "[rad | m]")
      .def("__repr__",
           [](const Mimic& mimic) {
             return "Mimic(" + in_quotes(mimic.joint) +
                    ", multiplier=" + printed("%g", mimic.multiplier) +
                    ", offset=" + printed("%g", mimic.offset) + ")";
           })
      .def(pickle_fields<Mimic, &Mimic::joint, &Mimic::multiplier, &Mimic::offset>());
  py::class_<Link>(m, "Link", link_doc)
      .def_readonly("name", &Link::name)
      .def_readonly("index", &Link::index, "in the model's `links`")
      .def_readonly("mass", &Link::mass, "[kg] its own, without links that are fixed to it")
      .def_readonly("inertia", &Link::inertia,
                    "BodyInertia: mass [kg], centre of mass c_J [m] and inertia I_J [kg m^2] about "
                    "it, in the link's frame")
      .def("__index__", [](const Link& l) { return l.index; })
      .def("__repr__", [](const Link& l) {
        return "Link('" + l.name + "', index=" + std::to_string(l.index) +
               ", mass=" + number(l.mass) + ")";
      });
  using J = JointInfo;
  py::class_<J>(m, "JointInfo", joint_doc)
      .def_readonly("name", &J::name)
      .def_readonly("type", &J::type)
      .def_readonly("index", &J::index, "in the model's `joints`")
      .def_readonly("parent", &J::parent, "name of the parent link")
      .def_readonly("child", &J::child, "name of the child link")
      .def_readonly("coordinates", &J::coordinates, "indices in q of those that move it")
      .def_readonly("velocities", &J::velocities, "indices in v and p, likewise")
      .def_readonly(
          "X_PJ", &J::X_PJ,
          "Pose of the joint's frame (the child link's at displacement 0) in the parent's")
      .def_readonly("axis", &J::axis, "unit, in the joint's frame, shape (3,); None without one")
      .def_readonly("pitch", &J::pitch, "[m/rad] of a helical joint")
      .def_property_readonly(
          "mimic",
          [](const J& j) -> std::optional<Mimic> {
            if (j.mimics.empty()) return {};
            return Mimic{j.mimics, j.multiplier, j.offset};
          },
          "Mimic: which joint it follows; None for all others")
      .def_readonly("lower", &J::lower, "[rad | m] limit, -inf where there is none")
      .def_readonly("upper", &J::upper, "[rad | m] limit, inf where there is none")
      .def("__index__", [](const J& j) { return j.index; })
      .def("__repr__", [](const J& j) {
        return "JointInfo('" + j.name + "', " + name_of(j.type) + ", '" + j.parent + "' -> '" +
               j.child + "')";
      });
}

}  // namespace saltus::bindings
