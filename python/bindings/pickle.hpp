// Values as tuples of their fields, for pickles: to other processes, not for keeps.
#pragma once

#include <type_traits>

#include "bindings.hpp"
#include "saltus/model/description.hpp"

namespace saltus::bindings {

template <auto... fields, class T>
py::tuple to_tuple(const T& x) {
  return py::make_tuple(x.*fields...);
}

template <class T, auto... fields>
T from_tuple(const py::tuple& tuple) {
  T x{};
  std::size_t i = 0;
  ((x.*fields = tuple[i++].template cast<std::decay_t<decltype(x.*fields)>>()), ...);
  return x;
}

/// For py::class_<T>::def.
template <class T, auto... fields>
auto pickle_fields() {
  return py::pickle([](const T& x) -> py::tuple { return to_tuple<fields...>(x); },
                    &from_tuple<T, fields...>);
}

/// Field by field: a hull of its vertices alone could list its faces in another order.
py::tuple to_tuple(const Hull& hull);
Hull to_hull(const py::tuple& tuple);

/// Has all classes of the module pickled in one way: in that of protocols 0 and 1 objects are made
/// by their base class, at which pybind11 ends the interpreter.
void use_one_protocol(const py::module_& m);

/// All fields by name, as plain.hpp has them; visuals' and shapes' points as arrays.
py::dict to_plain(const ModelDescription& description);

/// @throws ModelError on what is not as to_plain makes it, with its place, and on what
/// ModelBuilder's checks refuse.
ModelDescription to_description(const py::dict& plain, int version);

}  // namespace saltus::bindings
