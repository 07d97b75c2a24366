// From what a user writes for coordinates, links and shapes to arrays and indices.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "bindings.hpp"
#include "saltus/model/named_state.hpp"
#include "saltus/spatial/rotation.hpp"

namespace saltus::bindings {
namespace {

std::string show(const py::handle& x) { return py::repr(x).cast<std::string>(); }

/// Texts and truth values are no numbers, though Python makes numbers of them.
double to_number(const py::handle& x, const std::string& what) {
  const bool is_text = py::isinstance<py::str>(x) || py::isinstance<py::bytes>(x);
  if (is_text || py::isinstance<py::bool_>(x))
    throw ModelError(what + " = " + show(x) + " is no number");
  try {
    return py::float_(py::reinterpret_borrow<py::object>(x));
  } catch (py::error_already_set&) {
    throw ModelError(what + " = " + show(x) + " is no number");
  }
}

/// Which numbers of q or v a user may name, and by what.
struct Numbers {
  std::string kind, plural;        ///< "coordinate" or "velocity"
  std::vector<std::string> names;  ///< of the numbers
  std::vector<int> JointInfo::* of_joint;
};

Numbers numbers_of_q(const Model& model) {
  return {"coordinate", "coordinates", names_of(model->coordinates), &JointInfo::coordinates};
}
Numbers numbers_of_v(const Model& model) {
  return {"velocity", "velocities", model->velocity_names, &JointInfo::velocities};
}

/// A sequence, but no text and no array without dimension.
bool is_list(const py::handle& x) {
  if (py::isinstance<py::str>(x) || py::isinstance<py::bytes>(x)) return false;
  if (py::isinstance<py::array>(x)) return py::reinterpret_borrow<py::array>(x).ndim() > 0;
  return py::isinstance<py::sequence>(x);
}

/// @throws where R is a mirror, a shear or worse
void check_rotation(const Pose& X, const std::string& entry) {
  // 1e-6: what is left of a rotation written with six digits
  const double defect = (X.R.transpose() * X.R - Mat3::Identity()).norm();
  if (defect < 1e-6 && X.R.determinant() > 0) return;
  throw ModelError(entry + " is a Pose whose R is no rotation: its determinant is " +
                   show(py::float_(X.R.determinant())) + ", R^T R is off by " +
                   show(py::float_(defect)));
}

/// Numbers in a sequence, of sequences or not: (position, quaternion) is seven.
void append_numbers(const py::handle& x, const std::string& entry, std::vector<double>& out) {
  if (py::isinstance<Pose>(x)) {
    const Pose& X = x.cast<const Pose&>();
    check_rotation(X, entry);
    const Quaternion q = Quaternion(X.R).normalized();
    out.insert(out.end(), X.p.begin(), X.p.end());
    out.insert(out.end(), q.coeffs().begin(), q.coeffs().end());
  } else if (py::hasattr(x, "as_quat")) {  // SciPy's Rotation: x y z w
    append_numbers(x.attr("as_quat")(), entry, out);
  } else if (is_list(x)) {
    for (const py::handle each : x) append_numbers(each, entry, out);
  } else {
    out.push_back(to_number(x, entry));
  }
}

/// How many numbers the parts of a sequence of sequences have; empty where it is one of numbers.
std::vector<std::size_t> part_sizes(const py::handle& value, const std::string& entry) {
  std::vector<std::size_t> sizes;
  if (!is_list(value) || py::hasattr(value, "as_quat")) return sizes;
  bool any = false;
  for (const py::handle each : value) {
    std::vector<double> numbers;
    append_numbers(each, entry, numbers);
    sizes.push_back(numbers.size());
    any = any || is_list(each) || py::hasattr(each, "as_quat");
  }
  if (!any) sizes.clear();
  return sizes;
}

/// The numbers of a joint that has several: `given` may lack the position of a free joint's q.
void set_joint(const py::handle& value, const std::string& entry, const JointInfo& joint,
               const std::vector<int>& indices, bool is_q, VecX& out, std::vector<char>& is_set) {
  std::vector<double> given;
  append_numbers(value, entry, given);
  std::size_t first = 0;
  const bool is_rotation = py::hasattr(value, "as_quat");
  if (is_q && is_rotation && joint.type == JointType::floating) first = 3;
  if (is_q && py::isinstance<Pose>(value) && joint.type == JointType::spherical) {
    throw ModelError(entry + " is a Pose; a ball joint takes a quaternion x y z w or a Rotation",
                     "joint", joint.name);
  }
  const std::vector<std::size_t> parts = part_sizes(value, entry);
  const bool is_split = joint.type == JointType::floating && !parts.empty() &&
                        parts != std::vector<std::size_t>{3, is_q ? 4u : 3u};
  if (given.size() + first != indices.size() || is_split) {
    std::string wanted = counted(static_cast<long>(indices.size()), "number");
    if (joint.type == JointType::floating) {
      wanted = is_q ? "a Pose, a Rotation, or position and quaternion (x y z, x y z w)"
                    : "velocity and angular velocity (x y z, x y z)";
    } else if (joint.type == JointType::spherical) {
      wanted = is_q ? "a quaternion x y z w or a Rotation" : "an angular velocity x y z";
    }
    std::string has = counted(static_cast<long>(given.size()), "number");
    for (std::size_t k = 0; k < parts.size(); ++k) {
      has += (k == 0 ? " in parts of " : ", ") + std::to_string(parts[k]);
    }
    throw ModelError(entry + " has " + has + "; joint \"" + joint.name + "\" takes " + wanted,
                     "joint", joint.name);
  }
  for (std::size_t k = 0; k < given.size(); ++k) {
    const int i = indices[first + k];
    out[i] = given[k];
    ++is_set[static_cast<std::size_t>(i)];
  }
}

[[noreturn]] void refuse_name(const std::string& name, const Numbers& numbers, const Model& model) {
  std::vector<std::string> known = numbers.names;
  for (const JointInfo& joint : model->joints) {
    if ((joint.*numbers.of_joint).size() > 1) known.push_back(joint.name);
  }
  throw ModelError("no " + numbers.kind + " \"" + name + "\"; there are " + list_names(known),
                   numbers.kind, name);
}

/// Half of a surrogate pair is a str to Python, and no text that can be written.
std::string to_text(const py::handle& x) {
  return x.attr("encode")("utf-8", "backslashreplace").cast<std::string>();
}

void set_entry(const std::string& name, const py::handle& value, const std::string& what,
               const Numbers& numbers, const Model& model, VecX& out, std::vector<char>& is_set) {
  const std::string entry = what + "[\"" + name + "\"]";
  const auto found = std::find(numbers.names.begin(), numbers.names.end(), name);
  if (found != numbers.names.end()) {
    const auto i = found - numbers.names.begin();
    out[i] = to_number(value, entry);
    ++is_set[static_cast<std::size_t>(i)];
    return;
  }
  for (const JointInfo& joint : model->joints) {
    const std::vector<int>& indices = joint.*numbers.of_joint;
    if (joint.name != name || indices.size() < 2) continue;
    return set_joint(value, entry, joint, indices, numbers.kind == "coordinate", out, is_set);
  }
  refuse_name(name, numbers, model);
}

VecX from_mapping(const py::object& x, const Model& model, const std::string& what,
                  const Numbers& numbers, VecX out) {
  std::vector<char> is_set(static_cast<std::size_t>(out.size()), 0);
  for (const py::handle item : x.attr("items")()) {
    const auto [key, value] = item.cast<std::pair<py::object, py::object>>();
    if (!py::isinstance<py::str>(key)) {
      throw ModelError(what + " has the key " + show(key) + "; keys are names of " +
                       numbers.plural + ": " + list_names(numbers.names));
    }
    set_entry(to_text(key), value, what, numbers, model, out, is_set);
  }
  for (std::size_t i = 0; i < is_set.size(); ++i) {
    const std::string& name = numbers.names[i];
    const double number = out[static_cast<Eigen::Index>(i)];
    if (is_set[i] > 1) {
      throw ModelError(what + " gives \"" + name + "\" twice, by its name and by its joint's",
                       numbers.kind, name);
    }
    if (std::isfinite(number)) continue;
    throw ModelError(what + "[\"" + name + "\"] = " + show(py::float_(number)) + " is not finite",
                     numbers.kind, name);
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
  const char kind = py::array(x).dtype().kind();
  if (kind == 'U' || kind == 'S' || kind == 'b') {
    throw ModelError(what + (kind == 'b' ? " holds truth values" : " holds texts") +
                     "; it is an array of numbers");
  }
  if (array.ndim() != 1) {
    throw ModelError(what + " has shape " + show(array.attr("shape")) + "; it must have shape (" +
                     std::to_string(n) + ",)");
  }
  return Eigen::Map<const VecX>(array.data(), array.size());
}

}  // namespace

std::vector<double> numbers_in(const py::handle& x, const std::string& entry) {
  std::vector<double> numbers;
  append_numbers(x, entry, numbers);
  return numbers;
}

VecX to_vector(const Coordinates& x, const Model& model, const char* what) {
  if (x.value.is_none()) return model.neutral();
  if (py::isinstance<py::str>(x.value)) return named_q(model, to_text(x.value));
  if (py::hasattr(x.value, "items")) {
    const VecX q = from_mapping(x.value, model, what, numbers_of_q(model), model.neutral());
    return model.checked_q(q, what);
  }
  return model.checked_q(from_array(x.value, what, model.n_q()), what);
}

VecX to_vector(const Velocities& x, const Model& model, const char* what) {
  const VecX zero = VecX::Zero(model.n_v());
  if (x.value.is_none()) return zero;
  if (py::isinstance<py::str>(x.value)) return named_v(model, to_text(x.value));
  const bool is_mapping = py::hasattr(x.value, "items");
  const VecX v = is_mapping ? from_mapping(x.value, model, what, numbers_of_v(model), zero)
                            : from_array(x.value, what, model.n_v());
  check_vector(v, model.n_v(), what, "velocities");
  return v;
}

VecX to_vector(const PerContact& x, Eigen::Index contacts, const char* what) {
  const auto any = py::array::ensure(x.value);
  const auto array = py::array_t<double, py::array::forcecast>::ensure(x.value);
  if (!array || array.ndim() > 1 || (any && any.dtype().kind() == 'b')) {
    throw ModelError(std::string(what) + " is one number or one for each contact, not " +
                     show(x.value));
  }
  if (array.ndim() == 0) return VecX::Constant(contacts, *array.data());
  return array.cast<VecX>();
}

py::object to_member(const py::handle& x, const py::handle& kind, const char* what) {
  if (py::isinstance(x, kind)) return py::reinterpret_borrow<py::object>(x);
  const auto name = kind.attr("__name__").cast<std::string>();
  const std::string wrong = std::string(what) + " = " + show(x) + " is no " + name + "; there are ";
  const py::dict members(kind.attr("__members__"));
  const auto names = py::list(members).cast<std::vector<std::string>>();
  if (!py::isinstance<py::str>(x)) {
    const std::string start = "saltus." + name + ".";
    const auto qualified = py::str(", " + start).attr("join")(names).cast<std::string>();
    throw py::type_error(wrong + start + qualified);
  }
  if (members.contains(x)) return members[x];
  std::string message = wrong + list_names(names);
  const py::object difflib = py::module_::import("difflib");
  for (const py::handle near : difflib.attr("get_close_matches")(x, names, 1)) {
    message += "; did you mean " + show(near) + "?";
  }
  throw ModelError(message, what, py::str(x));
}

int to_index(const NameOrIndex& item, const std::vector<std::string>& names, const char* what) {
  const int n = static_cast<int>(names.size());
  if (py::isinstance<py::str>(item)) {
    const std::string name = to_text(item);
    for (int i = 0; i < n; ++i) {
      if (names[i] == name) return i;
    }
  } else if (PyIndex_Check(item.ptr())) {
    const py::ssize_t i =
        PyNumber_AsSsize_t(item.ptr(), nullptr);        // the greatest, where it is more
    const bool is_index = PyErr_Occurred() == nullptr;  // an array of several has none
    PyErr_Clear();
    if (is_index && i >= -n && i < n) return static_cast<int>(i < 0 ? i + n : i);
  }
  throw ModelError(
      "no " + std::string(what) + " " + show(item) + "; there are " + list_names(names), what,
      to_text(py::str(item)));
}

}  // namespace saltus::bindings
