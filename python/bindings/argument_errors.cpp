// Where a call's arguments fit no signature, words of ours in place of pybind11's list of
// signatures.
//
// Every bound function is a Python function whose method is pybind11's dispatcher. Another method
// stands before it, which asks saltus.arguments for the words where the dispatcher fails; a call
// that succeeds takes one jump more, some 3 ns. True and False are numbers to pybind11; calls with
// one of them are looked at before.
#include <unordered_map>

#include "bindings.hpp"

namespace saltus::bindings {
namespace {

using Method = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);

Method dispatcher = nullptr;
PyTypeObject* numpy_bool = nullptr;
PyTypeObject* metaclass = nullptr;  ///< of all classes of pybind11
/// What a method is called with as its self -> the function, kept alive.
std::unordered_map<PyObject*, PyObject*> function_of_self;

PyMethodDef* method_of(const py::handle& function) {
  return reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
}

Method to_method(PyCFunction pointer) {
  return reinterpret_cast<Method>(reinterpret_cast<void (*)()>(pointer));
}

/// In words what is wrong, None where saltus.arguments does not know either. `ask` is its function
/// and `about` that one's first argument.
py::object ask_for_words(const char* ask, const py::object& about, PyObject* const* arguments,
                         Py_ssize_t count, const py::handle& names) {
  py::list positional;
  for (Py_ssize_t i = 0; i < count; ++i) positional.append(py::handle(arguments[i]));
  py::dict keywords;
  if (names) {
    for (const py::handle name : names) keywords[name] = py::handle(arguments[count++]);
  }
  return py::module_::import("saltus.arguments").attr(ask)(about, positional, keywords);
}

bool any_truth_value(PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
  if (names != nullptr) count += PyTuple_GET_SIZE(names);
  for (Py_ssize_t i = 0; i < count; ++i) {
    if (PyBool_Check(arguments[i]) || Py_TYPE(arguments[i]) == numpy_bool) return true;
  }
  return false;
}

/// Sets a TypeError and returns true where True or False is given for a number.
bool refuse_truth_values(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                         PyObject* names) {
  if (!any_truth_value(arguments, count, names)) return false;
  const auto function = function_of_self.find(self);
  if (function == function_of_self.end()) return false;
  try {
    const py::object doc = py::handle(function->second).attr("__doc__");
    const py::object words = ask_for_words("find_truth_value", doc, arguments, count, names);
    if (words.is_none()) return false;
    PyErr_SetObject(PyExc_TypeError, words.ptr());
    return true;
  } catch (py::error_already_set& error) {
    error.discard_as_unraisable("saltus.arguments");
  }
  return false;
}

/// Sets a TypeError and returns true where an argument was never made: `Model.__new__(Model)` alone
/// gives an object without a value, which pybind11 would make up.
bool refuse_empty(PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
  if (names != nullptr) count += PyTuple_GET_SIZE(names);
  for (Py_ssize_t i = 0; i < count; ++i) {
    if (Py_TYPE(Py_TYPE(arguments[i])) != metaclass) continue;
    const auto& instance = *reinterpret_cast<py::detail::instance*>(arguments[i]);
    if (!instance.simple_layout || instance.simple_value_holder[0] != nullptr) continue;
    PyErr_Format(PyExc_TypeError, "this %s was never made: its __init__ was not called",
                 Py_TYPE(arguments[i])->tp_name);
    return true;
  }
  return false;
}

template <bool makes>
PyObject* dispatch(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
  const Py_ssize_t made = makes && count > 0 ? 1 : 0;  // by __init__ and __setstate__: self
  if (refuse_empty(arguments + made, count - made, names)) return nullptr;
  if (refuse_truth_values(self, arguments, count, names)) return nullptr;
  PyObject* const result = dispatcher(self, arguments, count, names);
  if (result != nullptr || PyErr_ExceptionMatches(PyExc_TypeError) == 0) return result;
  py::error_already_set error;
  // An error with a trace is of a Python function that was called from inside.
  if (!error.trace()) {
    try {
      const py::object words =
          ask_for_words("explain", py::str(error.value()), arguments, count, names);
      if (!words.is_none()) {
        PyErr_SetObject(PyExc_TypeError, words.ptr());
        return nullptr;
      }
    } catch (py::error_already_set& another) {
      another.discard_as_unraisable("saltus.arguments");
    }
  }
  error.restore();
  return nullptr;
}

/// What a member calls: methods and static methods of a class wrap it.
py::object function_of(const py::handle& member) {
  if (PyInstanceMethod_Check(member.ptr())) {
    return py::reinterpret_borrow<py::object>(PyInstanceMethod_Function(member.ptr()));
  }
  if (Py_TYPE(member.ptr()) == &PyStaticMethod_Type) return member.attr("__func__");
  return py::reinterpret_borrow<py::object>(member);
}

void explain_errors_of(const py::handle& member) {
  if (PyObject_TypeCheck(member.ptr(), &PyProperty_Type) != 0) {
    for (const char* part : {"fget", "fset"}) {
      const py::object function = member.attr(part);
      if (!function.is_none()) explain_errors_of(function);
    }
    return;
  }
  const py::object function = function_of(member);
  if (!PyCFunction_CheckExact(function.ptr())) return;
  PyMethodDef* const method = method_of(function);
  if (to_method(method->ml_meth) != dispatcher) return;
  function_of_self[PyCFunction_GET_SELF(function.ptr())] = function.inc_ref().ptr();
  const std::string name = function.attr("__name__").cast<std::string>();
  const bool makes = name == "__init__" || name == "__setstate__";
  const Method method_of_ours = makes ? &dispatch<true> : &dispatch<false>;
  method->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(method_of_ours));
}

}  // namespace

void explain_errors(const py::module_& m) {
  const py::cpp_function any([] {});
  const PyMethodDef* const method = method_of(any);
  // pybind11's own way to be called, which another version may change: its words are used then.
  if (method->ml_flags != (METH_FASTCALL | METH_KEYWORDS)) return;
  dispatcher = to_method(method->ml_meth);
  metaclass = Py_TYPE(m.attr("Pose").ptr());
  numpy_bool = reinterpret_cast<PyTypeObject*>(
      py::object(py::dtype::of<bool>().attr("type")).release().ptr());
  for (const auto& [name, member] : m.attr("__dict__").cast<py::dict>()) {
    explain_errors_of(member);
    if (!PyType_Check(member.ptr())) continue;
    for (const py::handle item : member.attr("__dict__").attr("values")()) explain_errors_of(item);
  }
}

}  // namespace saltus::bindings
