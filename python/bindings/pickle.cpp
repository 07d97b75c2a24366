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

}  // namespace saltus::bindings
