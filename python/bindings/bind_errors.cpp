// The three exceptions, with their attributes, as Python classes.
#include <pybind11/gil_safe_call_once.h>

#include <limits>

#include "bindings.hpp"

namespace saltus::bindings {
namespace {

constexpr auto model_error_doc =
    R"(Bad input: a file, a name, the shape of an array, a number that no model can have.

Attributes
----------
element : str
    Kind of the culprit where it has a name ("link", "joint", "coordinate"), else "".
name : str
    Its name, else "".
trajectory : Trajectory or None
    The rows before it, where it ended a run of `simulate`.
)";

constexpr auto step_error_doc =
    R"(A step that could not be made; the state it started from is unchanged.

Attributes
----------
t : float
    [s] where the step, or the arc of it that failed, began.
residual : float
    [largest momentum] scaled residual when the solver gave up.
iterations : int
    Newton iterations, arcs or impulses spent.
trajectory : Trajectory or None
    The rows before it, where it ended a run of `simulate`.
)";

constexpr auto jammed_error_doc =
    R"(A cascade of impulses that does not end: bodies jammed between others.)";

// Exception classes live as long as the interpreter; pybind11's storage makes that safe at exit.
using Storage = py::gil_safe_call_once_and_store<py::object>;

PYBIND11_CONSTINIT Storage model_error, step_error, jammed_error;

const py::object& make_class(Storage& storage, py::module_& m, const char* name, const char* doc,
                             const py::object& base) {
  return storage
      .call_once_and_store_result([&] {
        const std::string full = m.attr("__name__").cast<std::string>() + "." + name;
        const auto made = py::reinterpret_steal<py::object>(
            PyErr_NewExceptionWithDoc(full.c_str(), doc, base.ptr(), nullptr));
        if (!made) throw py::error_already_set();
        m.attr(name) = made;
        return made;
      })
      .get_stored();
}

void raise(const ModelError& error) {
  const py::object& type = model_error.get_stored();
  const py::object value = type(error.what());
  value.attr("element") = error.element;
  value.attr("name") = error.name;
  PyErr_SetObject(type.ptr(), value.ptr());
}

void raise(const StepError& error, const py::object& type) {
  const py::object value = type(error.what());
  value.attr("t") = error.t;
  value.attr("residual") = error.residual;
  value.attr("iterations") = error.iterations;
  PyErr_SetObject(type.ptr(), value.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const ModelError& error) {
    raise(error);
  } catch (const JammedError& error) {
    raise(error, jammed_error.get_stored());
  } catch (const StepError& error) {
    raise(error, step_error.get_stored());
  }
}

}  // namespace

void bind_errors(py::module_& m) {
  const py::object value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  const py::object runtime_error = py::reinterpret_borrow<py::object>(PyExc_RuntimeError);
  // Attributes of the classes are what an instance has that Python code raises itself.
  const py::object& model = make_class(model_error, m, "ModelError", model_error_doc, value_error);
  model.attr("element") = "";
  model.attr("name") = "";
  model.attr("trajectory") = py::none();
  const py::object& step = make_class(step_error, m, "StepError", step_error_doc, runtime_error);
  step.attr("t") = std::numeric_limits<double>::quiet_NaN();
  step.attr("residual") = std::numeric_limits<double>::quiet_NaN();
  step.attr("iterations") = 0;
  step.attr("trajectory") = py::none();
  make_class(jammed_error, m, "JammedError", jammed_error_doc, step);
  py::register_local_exception_translator(&translate);
}

}  // namespace saltus::bindings
