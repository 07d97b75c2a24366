#include "control.hpp"

#include <algorithm>
#include <cmath>

#include "named_report.hpp"

namespace saltus::bindings {
namespace {

std::vector<std::string> actuator_names(const Model& model) {
  return names_of(model->forces.actuators);
}

double to_number(const py::handle& x, const std::string& what) {
  const bool is_number = !py::isinstance<py::bool_>(x) && !py::isinstance<py::str>(x);
  try {
    if (is_number) return py::float_(py::reinterpret_borrow<py::object>(x));
  } catch (py::error_already_set&) {
    PyErr_Clear();
  }
  throw ModelError(what + " = " + py::repr(x).cast<std::string>() + " is no number");
}

VecX from_mapping(const py::object& x, const Model& model) {
  const std::vector<std::string> names = actuator_names(model);
  VecX u = VecX::Zero(static_cast<Eigen::Index>(names.size()));
  for (const py::handle item : x.attr("items")()) {
    const auto [key, value] = item.cast<std::pair<py::object, py::object>>();
    const auto name = py::str(key).cast<std::string>();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw ModelError("no actuator \"" + name + "\"; there are " + list_names(names), "actuator",
                       name);
    }
    u[found - names.begin()] = to_number(value, "control[\"" + name + "\"]");
  }
  return u;
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

Numbers to_numbers(const py::object& x) {
  const py::array any = py::array::ensure(x);
  const char kind = any ? any.dtype().kind() : 'O';
  if (kind == 'f' || kind == 'i' || kind == 'u') return Numbers(any);
  throw ModelError("control is " + py::repr(x).cast<std::string>() +
                   "; it is a mapping of actuators' names to numbers, an array, or a function");
}

/// @throws ModelError where the last dimension is not n_u, by the actuators there are
void check_columns(const Numbers& x, const Model& model) {
  const auto names = actuator_names(model);
  const auto n = static_cast<py::ssize_t>(names.size());
  const bool fits = x.ndim() > 0 && x.ndim() <= 2 && x.shape(x.ndim() - 1) == n &&
                    (x.ndim() == 1 || x.shape(0) > 0);
  if (fits) return;
  throw ModelError(
      "control has shape " + py::repr(x.attr("shape")).cast<std::string>() +
      "; it has one number for each of the " + std::to_string(n) +
      " actuators (a row a step, one at least, where it has two dimensions): " + list_names(names));
}

void check_finite(const VecX& u, const Model& model) {
  const auto names = actuator_names(model);
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    if (std::isfinite(u[k])) continue;
    throw ModelError("control[\"" + names[static_cast<std::size_t>(k)] +
                     "\"] = " + py::repr(py::float_(u[k])).cast<std::string>() + " is not finite");
  }
}

AppliedWrench applied(const std::string& name, const Wrench& wrench, const Model& model) {
  const Link& link = model->links[static_cast<std::size_t>(model.link(name))];
  if (link.joint < 0) {
    throw ModelError("forces[\"" + name + "\"]: the link is fixed to the world", "link", name);
  }
  const Mat3& R = link.X_JL.R;
  const Vec3 point = link.X_JL * wrench.point;
  if (!wrench.in_body) return {link.joint, point, wrench.force, wrench.torque, false};
  return {link.joint, point, R * wrench.force, R * wrench.torque, true, R};
}

void add_wrenches(const Wrenches& forces, const Model& model, ForceInput& input) {
  if (forces.value.is_none()) return;
  if (!py::hasattr(forces.value, "items")) {
    throw py::type_error("forces is " + py::repr(forces.value).cast<std::string>() +
                         "; it is a mapping of links' names to Wrenches");
  }
  for (const py::handle item : forces.value.attr("items")()) {
    const auto [key, value] = item.cast<std::pair<py::object, py::object>>();
    const auto link = py::str(key).cast<std::string>();
    if (!py::isinstance<Wrench>(value)) {
      throw py::type_error("forces[\"" + link + "\"] is " + py::repr(value).cast<std::string>() +
                           "; it is a saltus.Wrench, as Wrench(force=(1, 0, 0))");
    }
    input.wrenches.push_back(applied(link, value.cast<Wrench>(), model));
  }
}

/// Asks Python for the controls of the next steps.
class PythonPolicy {
 public:
  PythonPolicy(const py::object& function, Model model)
      : function_(function), model_(std::move(model)) {}

  void operator()(const Moment& now, ForceInput& input) {
    const py::gil_scoped_acquire acquire;
    const py::object moment =
        py::module_::import("saltus.runs.moment")
            .attr("Moment")(now.state, read_only(py::cast(now.v)), model_, input.control,
                            with_names(model_, now.report), now.step, before());
    before_ = Before{now.state, now.v, now.step};
    const py::object answer = function_(moment);
    if (answer.is_none()) return;
    input.control = to_control(answer, model_);
  }

 private:
  py::handle function_;  // copied without the interpreter's lock; the caller keeps it alive
  struct Before {
    State state;
    VecX v;
    long step;
  };
  py::object before() const {
    if (!before_) return py::none();
    return py::make_tuple(before_->state, read_only(py::cast(before_->v)), before_->step);
  }

  Model model_;
  std::optional<Before> before_;  ///< when it was asked before
};

}  // namespace

VecX to_control(const py::object& x, const Model& model) {
  VecX u;
  if (x.is_none()) return u;
  if (py::hasattr(x, "items")) {
    u = from_mapping(x, model);
  } else {
    const Numbers numbers = to_numbers(x);
    check_columns(numbers, model);
    if (numbers.ndim() != 1) throw ModelError("control has rows; one step takes one row");
    u = Eigen::Map<const VecX>(numbers.data(), numbers.size());
  }
  check_finite(u, model);
  return u;
}

ForceInput to_input(const py::object& control, const Wrenches& forces, const Velocities& qfrc,
                    const Model& model) {
  ForceInput input;
  input.control = to_control(control, model);
  if (!qfrc.value.is_none()) input.qfrc = to_vector(qfrc, model, "qfrc");
  add_wrenches(forces, model, input);
  return input;
}

Policy to_policy(const py::object& control, const Wrenches& forces, const Velocities& qfrc,
                 const Model& model) {
  Policy policy;
  py::object first = py::none();
  if (PyCallable_Check(control.ptr()) != 0) {
    policy = PythonPolicy(control, model);
  } else if (!control.is_none() && !py::hasattr(control, "items")) {
    const Numbers numbers = to_numbers(control);
    check_columns(numbers, model);
    if (numbers.ndim() == 2) {
      const MatX rows = Eigen::Map<const MatX>(numbers.data(), numbers.shape(0), numbers.shape(1));
      for (Eigen::Index k = 0; k < rows.rows(); ++k) check_finite(rows.row(k), model);
      policy = control_rows(rows);
    } else {
      first = control;
    }
  } else {
    first = control;
  }
  const ForceInput start = to_input(first, forces, qfrc, model);
  if (!policy && !start.acts() && start.control.size() == 0) return {};
  return [policy, start](const Moment& now, ForceInput& input) mutable {
    if (now.step == 0) input = start;
    if (policy) policy(now, input);
  };
}

}  // namespace saltus::bindings
