#include "functions.hpp"

#include <sstream>

namespace saltus::bindings {
namespace {

/// A function that threads without the interpreter's lock may copy and drop.
using Shared = std::shared_ptr<const py::object>;

Shared share(const py::object& function, const std::string& what) {
  if (PyCallable_Check(function.ptr()) == 0) {
    throw py::type_error(what + " is " + py::repr(function).cast<std::string>() +
                         "; it is a function");
  }
  return {new py::object(function), [](const py::object* held) {
            const py::gil_scoped_acquire acquire;
            delete held;
          }};
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// What a function returned, as an array of numbers.
Numbers to_numbers(const py::handle& x, const std::string& kind, const std::string& name,
                   const std::string& what) {
  const py::array any = py::array::ensure(py::reinterpret_borrow<py::object>(x));
  PyErr_Clear();
  const char type = any ? any.dtype().kind() : 'O';
  if (type == 'f' || type == 'i' || type == 'u') return Numbers(any);
  throw ModelError(kind + " \"" + name + "\" returned " + py::repr(x).cast<std::string>() + " as " +
                       what + ", which are no numbers",
                   kind, name);
}

[[noreturn]] void refuse_shape(const Numbers& x, const std::string& kind, const std::string& name,
                               const std::string& what, const std::string& wanted) {
  throw ModelError(kind + " \"" + name + "\" returned " + what + " of shape " +
                       py::repr(x.attr("shape")).cast<std::string>() + "; it has " + wanted,
                   kind, name);
}

VecX to_vector(const py::handle& x, const std::string& kind, const std::string& name,
               const std::string& what) {
  const Numbers numbers = to_numbers(x, kind, name, what);
  if (numbers.ndim() > 1) refuse_shape(numbers, kind, name, what, "one dimension");
  return Eigen::Map<const VecX>(numbers.data(), numbers.size());
}

/// Of one row, the row alone will do.
MatX to_matrix(const py::handle& x, Eigen::Index rows, const std::string& kind,
               const std::string& name, const std::string& what) {
  const Numbers numbers = to_numbers(x, kind, name, what);
  if (numbers.ndim() < 2 && rows == 1) {
    return Eigen::Map<const MatX>(numbers.data(), 1, numbers.size());
  }
  if (numbers.ndim() != 2) refuse_shape(numbers, kind, name, what, "two dimensions");
  return Eigen::Map<const MatX>(numbers.data(), numbers.shape(0), numbers.shape(1));
}

py::array copied(const VecX& x) { return read_only(py::cast(x)); }

}  // namespace

ForceFunction to_force_function(const std::string& name, const py::object& function) {
  const Shared shared = share(function, "function of force \"" + name + "\"");
  return [shared, name](const ForceMoment& now, ForceAnswer& answer) {
    const py::gil_scoped_acquire acquire;
    const py::object returned = (*shared)(PythonMoment{now.t, copied(now.q), copied(now.v)});
    if (!py::isinstance<py::tuple>(returned)) {
      answer.Q = to_vector(returned, "force", name, "Q");
      return;
    }
    const auto all = returned.cast<py::tuple>();
    if (all.size() != 3) {
      throw ModelError("force \"" + name + "\" returned a tuple of " + std::to_string(all.size()) +
                           "; it returns Q, an array or a list, or the tuple (Q, Q_q, Q_v)",
                       "force", name);
    }
    answer.Q = to_vector(all[0], "force", name, "Q");
    const Eigen::Index m = answer.Q.size();
    if (!all[1].is_none()) answer.Q_q = to_matrix(all[1], m, "force", name, "Q_q");
    if (!all[2].is_none()) answer.Q_v = to_matrix(all[2], m, "force", name, "Q_v");
  };
}

std::function<PrescribedMotion(double)> to_motion(const std::string& joint,
                                                  const py::object& function) {
  const Shared shared = share(function, "prescribed motion of joint \"" + joint + "\"");
  return [shared, joint](double t) {
    const py::gil_scoped_acquire acquire;
    const VecX x = to_vector((*shared)(t), "prescribed motion", joint, "its value and rate");
    if (x.size() == 2 && x.allFinite()) return PrescribedMotion{x[0], x[1]};
    if (x.size() == 3 && x.allFinite()) return PrescribedMotion{x[0], x[1], x[2]};
    std::ostringstream given;
    given << x.transpose();
    throw ModelError("the prescribed motion of joint \"" + joint + "\" returned (" + given.str() +
                         ") at t = " + std::to_string(t) +
                         " s; it returns finite numbers, the displacement, its rate and, for "
                         "accelerations, the rate of that",
                     "joint", joint);
  };
}

PotentialFunction to_potential(const std::string& name, const py::object& value,
                               const py::object& gradient, const py::object& hessian) {
  const std::string of = " of potential \"" + name + "\"";
  const Shared V = share(value, "value" + of), V_q = share(gradient, "gradient" + of),
               V_qq = share(hessian, "hessian" + of);
  PotentialFunction out;
  out.name = name;
  out.value = [V, name](const VecX& q) {
    const py::gil_scoped_acquire acquire;
    const VecX x = to_vector((*V)(copied(q)), "potential", name, "its value");
    if (x.size() == 1) return x[0];
    throw ModelError("potential \"" + name + "\" returned " + std::to_string(x.size()) +
                         " numbers as its value; it is one",
                     "potential", name);
  };
  out.gradient = [V_q, name](const VecX& q, VecX& to) {
    const py::gil_scoped_acquire acquire;
    to = to_vector((*V_q)(copied(q)), "potential", name, "its gradient");
  };
  out.hessian = [V_qq, name](const VecX& q, MatX& to) {
    const py::gil_scoped_acquire acquire;
    to = to_matrix((*V_qq)(copied(q)), to.rows(), "potential", name, "its Hessian");
  };
  return out;
}

}  // namespace saltus::bindings
