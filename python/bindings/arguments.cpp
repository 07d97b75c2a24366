// From what a user writes for coordinates, links and shapes to arrays and indices.
#include <cmath>
#include <sstream>

#include "bindings.hpp"

namespace saltus::bindings {
namespace {

std::string show(const py::handle& x) { return py::repr(x).cast<std::string>(); }

double to_number(const py::handle& x, const std::string& what) {
  try {
    return py::float_(py::reinterpret_borrow<py::object>(x));
  } catch (py::error_already_set&) {
    throw ModelError(what + " = " + show(x) + " is no number");
  }
}

VecX from_mapping(const py::object& x, const Model& model, const std::string& what) {
  VecX out = VecX::Zero(model.n_q());
  for (const py::handle item : x.attr("items")()) {
    const auto [key, value] = item.cast<std::pair<py::object, py::object>>();
    if (!py::isinstance<py::str>(key)) {
      throw ModelError(what + " has the key " + show(key) + "; keys are names of coordinates: " +
                       list_names(names_of(model->coordinates)));
    }
    const auto name = key.cast<std::string>();
    const std::string entry = what + "[\"" + name + "\"]";
    const int i = model.coordinate(name);
    out[i] = to_number(value, entry);
    if (!std::isfinite(out[i])) {
      throw ModelError(entry + " = " + show(py::float_(out[i])) + " is not finite", "coordinate",
                       name);
    }
  }
  return out;
}

VecX from_array(const py::object& x, const std::string& what, int n) {
  using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
  Array array;
  try {
    array = Array(x);
  } catch (py::error_already_set& error) {
    throw ModelError(what +
                     " is no array of numbers: " + py::str(error.value()).cast<std::string>());
  }
  if (array.ndim() != 1) {
    throw ModelError(what + " has shape " + show(array.attr("shape")) + "; it must have shape (" +
                     std::to_string(n) + ",)");
  }
  return Eigen::Map<const VecX>(array.data(), array.size());
}

}  // namespace

VecX to_vector(const Coordinates& x, const Model& model, const char* what) {
  if (x.value.is_none()) return VecX::Zero(model.n_q());
  const bool is_mapping = py::hasattr(x.value, "items");
  const VecX out =
      is_mapping ? from_mapping(x.value, model, what) : from_array(x.value, what, model.n_q());
  check_vector(out, model.n_q(), what);
  return out;
}

void refuse_choice(const py::handle& x, const py::handle& kind, const char* what) {
  const std::string name = kind.attr("__name__").cast<std::string>();
  std::string members;
  for (const py::handle member : kind) {
    members += (members.empty() ? "saltus." : ", saltus.") + name + "." +
               member.attr("name").cast<std::string>();
  }
  throw py::type_error(std::string(what) + " = " + show(x) + " is no " + name + "; there are " +
                       members);
}

int to_index(const NameOrIndex& item, const std::vector<std::string>& names, const char* what) {
  const int n = static_cast<int>(names.size());
  if (py::isinstance<py::str>(item)) {
    const auto name = item.cast<std::string>();
    for (int i = 0; i < n; ++i) {
      if (names[i] == name) return i;
    }
  } else if (PyIndex_Check(item.ptr())) {
    const auto i = py::cast<py::ssize_t>(item);
    if (i >= -n && i < n) return static_cast<int>(i < 0 ? i + n : i);
  }
  throw ModelError(
      "no " + std::string(what) + " " + show(item) + "; there are " + list_names(names), what,
      py::str(item));
}

}  // namespace saltus::bindings
