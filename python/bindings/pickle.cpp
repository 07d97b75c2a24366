#include "pickle.hpp"

#include "saltus/model/model_builder.hpp"

namespace saltus::bindings {
namespace {

/// A list of tuples of these fields, and back.
template <class T, auto... fields>
struct Listed {
  static py::list from(const std::vector<T>& items) {
    py::list list;
    for (const T& item : items) list.append(to_tuple<fields...>(item));
    return list;
  }
  static std::vector<T> to(const py::handle& list) {
    std::vector<T> items;
    for (const py::handle item : list) {
      items.push_back(from_tuple<T, fields...>(item.cast<py::tuple>()));
    }
    return items;
  }
};

using J = JointSpec;
using Links = Listed<LinkSpec, &LinkSpec::name, &LinkSpec::inertia, &LinkSpec::check,
                     &LinkSpec::compensation>;
using Joints = Listed<J, &J::name, &J::type, &J::parent, &J::child, &J::X_PJ, &J::axis, &J::pitch,
                      &J::mimic, &J::lower, &J::upper, &J::velocity, &J::effort, &J::damping,
                      &J::friction, &J::armature, &J::stiffness, &J::rest, &J::limit_restitution,
                      &J::curve_x, &J::curve_f, &J::curve_slopes, &J::effects>;
using A = ActuatorSpec;
using Actuators = Listed<A, &A::name, &A::joints, &A::gain, &A::bias, &A::bias_l, &A::bias_v,
                         &A::effort, &A::lower, &A::upper>;
using S = SpringSpec;
using Springs = Listed<S, &S::name, &S::a, &S::b, &S::stiffness, &S::length, &S::damping>;
using Shapes = Listed<ShapeSpec, &ShapeSpec::link, &ShapeSpec::name, &ShapeSpec::shape,
                      &ShapeSpec::X_LG, &ShapeSpec::material, &ShapeSpec::contact>;

using Visuals =
    Listed<Visual, &Visual::link, &Visual::shape, &Visual::X_LG, &Visual::rgba, &Visual::name>;

using Faces = Listed<Hull::Face, &Hull::Face::normal, &Hull::Face::offset, &Hull::Face::corners>;
using Edges =
    Listed<Hull::Edge, &Hull::Edge::from, &Hull::Edge::to, &Hull::Edge::left, &Hull::Edge::right>;

}  // namespace

py::tuple to_tuple(const Hull& hull) {
  return py::make_tuple(hull.vertices, Faces::from(hull.faces), Edges::from(hull.edges),
                        hull.first_neighbour, hull.neighbour, hull.center);
}

Hull to_hull(const py::tuple& t) {
  Hull hull{t[0].cast<std::vector<Vec3>>(),
            Faces::to(t[1]),
            Edges::to(t[2]),
            t[3].cast<std::vector<int>>(),
            t[4].cast<std::vector<int>>(),
            t[5].cast<Vec3>()};
  try {  // its indices, above all
    check_visual({"", Convex{std::make_shared<const Hull>(hull)}});
  } catch (const ModelError&) {
    throw ModelError("a pickle of a Convex is ruined: its parts do not fit together");
  }
  return hull;
}

void use_one_protocol(const py::module_& m) {
  const py::object make = py::module_::import("copyreg").attr("__newobj__");
  for (const auto& [name, member] : m.attr("__dict__").cast<py::dict>()) {
    if (Py_TYPE(member.ptr()) != Py_TYPE(m.attr("Pose").ptr())) continue;
    const bool has_state = member.attr("__dict__").contains("__getstate__");
    const auto reduce = [make, has_state](const py::object& self) -> py::tuple {
      const py::object kind = py::type::of(self);
      if (has_state) return py::make_tuple(make, py::make_tuple(kind), self.attr("__getstate__")());
      throw py::type_error("cannot pickle '" + py::str(kind.attr("__name__")).cast<std::string>() +
                           "' object");
    };
    member.attr("__reduce__") =
        py::cpp_function(reduce, py::name("__reduce__"), py::is_method(member));
  }
}

namespace {

/// @throws TypeError where the model has functions
void check_no_functions(const ModelDescription& d) {
  const auto refuse = [&](const std::string& what) {
    throw py::type_error("cannot pickle model '" + d.name + "': its " + what +
                         " is a function; build it where it is needed, or pickle a model without");
  };
  if (!d.forces.empty()) refuse("force '" + d.forces.front().name + "'");
  if (!d.potentials.empty()) refuse("potential '" + d.potentials.front().name + "'");
}

}  // namespace

py::tuple to_tuple(const ModelDescription& d) {
  check_no_functions(d);
  const FilterSpec& f = d.filter;
  const MaterialSpec& m = d.materials;
  return py::make_tuple(
      d.name, d.root, d.source, d.gravity, d.solver, Links::from(d.links), Joints::from(d.joints),
      Shapes::from(d.shapes), py::make_tuple(f.links, f.bodies, f.groups, f.group_of, f.adjacent),
      py::make_tuple(m.of_link, m.contact, m.standard), d.warnings, Actuators::from(d.actuators),
      Visuals::from(d.visuals), Springs::from(d.springs));
}

py::tuple moving_parts(const ModelDescription& d) {
  return py::make_tuple(Links::from(d.links), Joints::from(d.joints), Actuators::from(d.actuators),
                        Springs::from(d.springs), names_of(d.forces), names_of(d.potentials));
}

ModelDescription to_description(const py::tuple& t) {
  using F = FilterSpec;
  using M = MaterialSpec;
  ModelDescription d;
  d.name = t[0].cast<std::string>();
  d.root = t[1].cast<std::string>();
  d.source = t[2].cast<std::string>();
  d.gravity = t[3].cast<Vec3>();
  d.solver = t[4].cast<TreeSolver>();
  d.links = Links::to(t[5]);
  d.joints = Joints::to(t[6]);
  d.shapes = Shapes::to(t[7]);
  d.filter = from_tuple<F, &F::links, &F::bodies, &F::groups, &F::group_of, &F::adjacent>(t[8]);
  d.materials = from_tuple<M, &M::of_link, &M::contact, &M::standard>(t[9]);
  d.warnings = t[10].cast<std::vector<std::string>>();
  d.actuators = Actuators::to(t[11]);
  d.visuals = Visuals::to(t[12]);
  d.springs = Springs::to(t[13]);
  return ModelBuilder::checked(d);
}

}  // namespace saltus::bindings
