// What runs ask about ten times a second: Ctrl-C, and the caller's progress function.
#pragma once

#include <functional>
#include <optional>

#include "bindings.hpp"

namespace saltus::bindings {

using Progress = py::typing::Callable<py::object(double)>;

/// Handles signals and calls `progress`; false on Ctrl-C.
inline bool go_on(py::handle progress, double part) {
  const py::gil_scoped_acquire acquire;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(part);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_KeyboardInterrupt)) throw;
    return false;
  }
  return true;
}

/// For SimulateOptions::progress. Holds a handle, because C++ copies it without the interpreter's
/// lock; the caller's argument keeps the function alive.
inline std::function<bool(double)> asking_python(const std::optional<Progress>& progress) {
  const py::handle told = progress ? py::handle(*progress) : py::handle(Py_None);
  return [told](double part) { return go_on(told, part); };
}

}  // namespace saltus::bindings
