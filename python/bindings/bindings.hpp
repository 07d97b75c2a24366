// What the files of the bindings share. A binding reshapes data and nothing else.
//
// One bind_<floor>.cpp a floor; core.cpp calls them from the ground up, because a type must be
// known to pybind11 before a signature that names it (else help() and the stubs show its C++ name).
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <vector>

#include "saltus/model/model.hpp"
#include "saltus/model/model_builder.hpp"
#include "saltus/variational/options.hpp"
#include "saltus/variational/report.hpp"

namespace saltus::bindings {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_spatial(py::module_& m);
void bind_lagrangian(py::module_& m);
void bind_collision(py::module_& m);
void bind_model(py::module_& m);
void bind_configurations(py::class_<Model>& c);  ///< called by bind_model
void bind_links(py::module_& m);                 ///< called by bind_model
void bind_dynamics(py::module_& m);
void bind_visuals(py::module_& m);  ///< called by bind_model
void bind_model_builder(py::module_& m);
void bind_joint_effects(py::module_& m);                         ///< called by bind_model
void bind_model_forces(py::class_<Model>& c);                    ///< likewise
void bind_loop_types(py::module_& m);                            ///< likewise
void bind_model_loops(py::class_<Model>& c, py::module_& m);     ///< likewise
void bind_add_loops(py::class_<ModelBuilder>& c);                ///< called by bind_model_builder
void bind_actuators(py::class_<ModelBuilder>& c);                ///< called by bind_model_builder
void bind_joint_forces(py::class_<ModelBuilder>& c);             ///< likewise
void bind_springs(py::class_<ModelBuilder>& c);                  ///< likewise
void bind_points(py::module_& m);                                ///< likewise
void bind_check_derivatives(py::module_& m);                     ///< likewise
void bind_changes(py::class_<ModelBuilder>& c, py::module_& m);  ///< called by bind_model_builder
void bind_named_states(py::class_<ModelBuilder>& c);             ///< likewise
void bind_add_sensor(py::class_<ModelBuilder>& c);               ///< likewise
void bind_sensors(py::module_& m);                               ///< called by bind_model
void bind_model_sensors(py::class_<Model>& c);                   ///< likewise
void bind_descriptions(py::class_<Model>& c, py::module_& m);    ///< likewise
void bind_motion(py::module_& m);
void bind_urdf(py::module_& m);
void bind_variational(py::module_& m);
void bind_contact_space(py::module_& m);
void bind_resolve_impact(py::module_& m);    ///< called by bind_contact_space
void bind_report(py::module_& m);            ///< called by bind_stepper
void bind_derivative_types(py::module_& m);  ///< likewise
void bind_stepper(py::module_& m);
void bind_rollout(py::module_& m);
void bind_batch(py::module_& m);

/// Wrong arguments of all functions and methods are explained in words (saltus.arguments).
void explain_errors(const py::module_& m);

/// What a user gives for q: names and values (others as in Model::neutral), where a joint's name
/// stands for all of its numbers; the name of a state; an array (n_q); or None.
struct Coordinates {
  static constexpr auto type_name = py::detail::const_name(
      "collections.abc.Mapping[str, object] | numpy.typing.ArrayLike | None");
  py::object value;
};

/// Likewise for v: others are 0, and arrays (n_v).
struct Velocities {
  static constexpr auto type_name = py::detail::const_name(
      "collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None");
  py::object value;
};

/// The array that is meant; `what` names it in messages.
/// @throws ModelError on a name that the model has not, and on what are no numbers or too many.
VecX to_vector(const Coordinates& x, const Model& model, const char* what = "q");
VecX to_vector(const Velocities& x, const Model& model, const char* what = "v");

/// The numbers of a value: one, a sequence, a Pose (x y z, x y z w), a Rotation.
/// @throws ModelError on what are none; `entry` names the value.
std::vector<double> numbers_in(const py::handle& x, const std::string& entry);

/// What a user gives for e or mu: one number for all contacts, or one for each.
struct PerContact {
  static constexpr auto type_name =
      py::detail::const_name("typing.SupportsFloat | numpy.typing.ArrayLike");
  py::object value;
};

/// One number for each contact; `what` names them in messages.
/// @throws ModelError on what are no numbers
VecX to_vector(const PerContact& x, Eigen::Index contacts, const char* what);

/// Which law impacts obey: one of ImpactLaw or its name, or a function ImpactProblem -> p+.
struct LawChoice {
  static constexpr auto type_name = py::detail::const_name(
      "ImpactLaw | str | collections.abc.Callable[[ImpactProblem], numpy.typing.ArrayLike]");
  py::object value;
};

/// Sets law and custom. @throws TypeError on what is neither.
void set_law(const LawChoice& law, StepOptions& options);

/// An argument that must be a T and may be anything: whoever takes it says what is wrong with it,
/// where pybind11 would print the signatures that there are.
template <class T>
struct Unchecked {
  static constexpr auto type_name = py::detail::make_caster<T>::name;
  py::object value;
};

/// What a user gives for an enumeration: a member, or the name of one.
template <class Enum>
struct Choice {
  static constexpr auto type_name =
      py::detail::make_caster<Enum>::name + py::detail::const_name(" | str");
  py::object value;
};

/// Where something is attached: a frame on a link, or a link for its own frame.
using AtOrLink = std::variant<At, std::string>;
At to_at(const AtOrLink& where);

/// Rows of loops by name, for reports.
std::map<std::string, VecX> by_loop(const Model& model, const VecX& rows);

/// The member of `kind` that `x` is or names; `what` names the argument in messages.
/// @throws ModelError on a name that no member has, TypeError on what is neither.
py::object to_member(const py::handle& x, const py::handle& kind, const char* what);

template <class Enum>
Enum to_enum(const Choice<Enum>& x, const char* what) {
  return to_member(x.value, py::type::of(py::cast(Enum{})), what).template cast<Enum>();
}

/// The options of a step, as both StepOptions and Stepper take them.
StepOptions make_step_options(double h, const LawChoice& law, bool collisions,
                              const Choice<ImpactOrder>& order, bool certify, int max_iterations,
                              int max_impacts, int max_halvings, int max_impulses, double rest,
                              double simultaneous, bool strict);

/// How links and shapes are named.
using NameOrIndex = py::typing::Union<py::str, py::int_>;

/// How links are named: also by the Link itself.
using NameOrLink = py::typing::Union<py::str, py::int_, Link>;

/// Index of a link or shape that is given by name or by index.
int to_index(const NameOrIndex& item, const std::vector<std::string>& names, const char* what);

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

inline py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// A read-only array over `items`, which `owner` keeps alive: no copy.
template <class Item>
py::array view(const std::vector<Item>& items, const py::handle& owner) {
  return read_only(py::array(static_cast<py::ssize_t>(items.size()), items.data(), owner));
}

}  // namespace saltus::bindings

namespace pybind11::detail {

/// Arguments with a type_name take any object: who uses one says what is wrong with it in better
/// words than an overload error.
template <class T>
  requires requires { T::type_name; }
struct type_caster<T> {
  PYBIND11_TYPE_CASTER(T, T::type_name);
  bool load(handle source, bool /*convert*/) {
    value.value = reinterpret_borrow<object>(source);
    return static_cast<bool>(source);
  }
};

}  // namespace pybind11::detail
