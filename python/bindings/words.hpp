// What objects say of themselves: texts of one line are made here, tables and trees by
// saltus.records.
#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "bindings.hpp"

namespace saltus::bindings {

/// What a function of saltus.records.<module> makes of an object.
inline py::str in_words(const char* module, const char* function, const py::object& self) {
  const std::string name = std::string("saltus.records.") + module;
  return py::module_::import(name.c_str()).attr(function)(self);
}

/// A text whose long lists of numbers lack all but their first ones.
inline py::str without_tails(const std::string& text) {
  return in_words("tables", "without_tails", py::str(text));
}

/// A number by printf's format.
inline std::string printed(const char* format, double x) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, x);
  return text.data();
}

/// A text as Python writes it.
inline std::string in_quotes(const std::string& text) {
  return py::repr(py::str(text)).cast<std::string>();
}

}  // namespace saltus::bindings
