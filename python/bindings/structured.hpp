// Structured arrays over vectors of C++ structs, without a copy.
#pragma once

#include <vector>

#include "bindings.hpp"

namespace saltus::bindings {

/// Fields of a structured array: names, types and where they are in an item.
struct Fields {
  py::list names, formats, offsets;
  void add(const char* name, const char* format, std::size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  }
  py::dtype type(std::size_t size) const {
    return {names, formats, offsets, static_cast<py::ssize_t>(size)};
  }
};

/// A read-only array over `items`, which `self` keeps alive.
template <class Item>
py::object structured_view(const std::vector<Item>& items, const py::dtype& type,
                           const py::object& self) {
  return read_only(
      py::array(type, {static_cast<py::ssize_t>(items.size())}, {}, items.data(), self));
}

}  // namespace saltus::bindings
