// Rollout floor: many steps in a row, with the interpreter's lock released.
#include "bindings.hpp"
#include "control.hpp"
#include "named_gradient.hpp"
#include "progress.hpp"
#include "saltus/rollout/adjoint.hpp"
#include "saltus/rollout/simulate.hpp"
#include "structured.hpp"

namespace saltus::bindings {
namespace {

constexpr auto trajectory_doc =
    R"(The arrays of a run, as read-only views; `saltus.Trajectory` wraps this.)";

constexpr auto simulate_doc = R"(Runs round(duration / h) steps from `start`; row 0 is `start`.

Parameters
----------
run : Trajectory
    Is written: all rows, those before the step where it raises an error or Ctrl-C
    (KeyboardInterrupt) stops it, none where numbers make no run. Not `complete` where rows lack.
start : State
duration : float
    [s] a whole number of steps.
options : StepOptions
record_every : int
    Steps between recorded rows.
record_contacts : bool
    Whether to fill `contacts`.
control, forces, qfrc
    As `saltus.simulate` takes them.
control_every : int
    Steps between the times that a function is asked.
progress : callable, optional
    Called about ten times a second with the part done in [0, 1]; what it returns is not used.

Raises
------
ModelError
    On a duration or h that is not positive, a duration that is no whole number of steps, a start
    that does not fit the model or overlaps, more than 16 GB.
StepError, JammedError
    As `Stepper.advance`.
)";

constexpr auto energies_class_doc = R"(Energies of one state.)";

constexpr auto energies_doc = R"(Energies of one state.

Parameters
----------
model : Model
state : State
h : float
    [s] step of the shadow energy H - h^2 kappa / 24, which a fixed step conserves to O(h^4).

Returns
-------
Energies
)";

void run(Trajectory& out, const State& start, double duration, const StepOptions& step,
         int record_every, bool record_contacts, const py::object& control, int control_every,
         const Wrenches& forces, const Velocities& qfrc, const std::optional<Progress>& progress) {
  SimulateOptions options;
  options.step = step;
  options.record_every = record_every;
  options.record_contacts = record_contacts;
  options.progress = asking_python(progress);
  const Model model = out.model;
  options.policy = to_policy(control, forces, qfrc, model);
  options.control_every = control_every;
  const py::gil_scoped_release release;
  simulate(model, start, duration, options, out);
}

constexpr auto adjoint_doc = R"(The gradient of a cost of a run, as `Trajectory.gradient` gives it.

Parameters
----------
model : Model
options : StepOptions
t : numpy.ndarray, shape (rows,)
    [s] of the start, of each so many steps, and of the end.
q, p, control : numpy.ndarray, shape (rows, n_q), (rows, n_v), (rows, n_u)
q_hat, p_hat : numpy.ndarray, shape (rows, n_v)
    The cost by each row's state.
forces : mapping of links' names to Wrench, optional
qfrc : mapping of names to values, or array_like, shape (n_v,), optional
    What was applied in all steps.
every, steps : int
    Steps from row to row, and of the run; 0: as many as rows make.
by_step : numpy.ndarray, shape (steps, n_u), optional
    The controls of each step, where rows do not tell them.

Returns
-------
tuple
    By the start's q and p (n_v,), by control (rows - 1, n_u), or (steps, n_u), and qfrc
    (rows - 1, n_v), by forces and torques (rows - 1, 3 wrenches), by h, and a ModelGradient.

Raises
------
ModelError
    Where shapes do not fit, and where a step has no derivative: which, and why.
StepError, JammedError
    As `Stepper.advance`.
)";

using Gradient = std::tuple<VecX, VecX, MatX, MatX, MatX, MatX, double, NamedModelGradient>;

Gradient adjoint_of(const Model& model, const StepOptions& options, const VecX& t, const MatX& q,
                    const MatX& p, const MatX& control, const MatX& q_hat, const MatX& p_hat,
                    const Wrenches& forces, const Velocities& qfrc, Eigen::Index every,
                    Eigen::Index steps, const std::optional<MatX>& by_step) {
  const ForceInput input = to_input(py::none(), forces, qfrc, model);
  const RunRows rows{
      t, q, p, control, input.qfrc, input.wrenches, every, steps, by_step.value_or(MatX())};
  const auto goes_on = [] {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  const py::gil_scoped_release release;
  RunGradient g = adjoint(model, options, rows, q_hat, p_hat, goes_on);
  return {std::move(g.q),
          std::move(g.p),
          std::move(g.control),
          std::move(g.qfrc),
          std::move(g.forces),
          std::move(g.torques),
          g.h,
          with_names(model, std::move(g.model))};
}

template <auto field>
py::object rows(const py::object& self) {
  return view(self.cast<const Trajectory&>().*field, self);
}

/// The fields of a ContactImpulse that is `base` bytes into the item.
void add_impulse(std::size_t base, Fields& fields) {
  using C = ContactImpulse;
  fields.add("pair", "i4", base + offsetof(C, pair));
  fields.add("lambda", "f8", base + offsetof(C, lambda));
  fields.add("tangential", "3f8", base + offsetof(C, p_W));
  fields.add("point", "3f8", base + offsetof(C, point_W));
  fields.add("normal", "3f8", base + offsetof(C, n_W));
}

py::object impulses(const py::object& self) {
  Fields fields;
  add_impulse(0, fields);
  return structured_view(self.cast<const Trajectory&>().impulses,
                         fields.type(sizeof(ContactImpulse)), self);
}

py::object contacts(const py::object& self) {
  const auto& run = self.cast<const Trajectory&>();
  if (!run.contacts) return py::none();
  using R = RecordedContact;
  Fields fields;
  fields.add("row", "i8", offsetof(R, row));
  fields.add("t", "f8", offsetof(R, t));
  fields.add("impact", "i4", offsetof(R, impact));
  add_impulse(offsetof(R, impulse), fields);
  return structured_view(*run.contacts, fields.type(sizeof(R)), self);
}

void bind_trajectory(py::module_& m) {
  using T = Trajectory;
  py::class_<T>(m, "Trajectory", trajectory_doc)
      .def(py::init([](const Model& model) { return T{.model = model}; }),
           "Of no rows; `simulate` writes to it.", py::arg("model"))
      .def_static(
          "from_states",
          [](const Model& model, const VecX& t, const MatX& q, const MatX& rows, bool momenta,
             double h) {
            const py::gil_scoped_release release;
            return from_states(model, t, q, rows, momenta ? RowsOf::momenta : RowsOf::velocities,
                               h);
          },
          "A run of given rows: `rows` are velocities or `momenta`.", py::arg("model"),
          py::arg("t"), py::arg("q"), py::arg("rows"), py::arg("momenta"), py::arg("h"))
      .def_readonly("model", &T::model)
      .def_readonly("options", &T::options)
      .def_readonly("t", &T::t, "[s] shape (rows,)")
      .def_readonly("q", &T::q, "[rad | m] shape (rows, n)")
      .def_readonly("v", &T::v, "[rad/s | m/s] shape (rows, n)")
      .def_readonly("p", &T::p, "shape (rows, n)")
      .def_readonly("kinetic", &T::kinetic, "[J] shape (rows,)")
      .def_readonly("potential", &T::potential, "[J] shape (rows,)")
      .def_readonly("shadow", &T::shadow, "[J] shape (rows,)")
      .def_readonly("control", &T::control, "shape (rows, n_u)")
      .def_readonly("work", &T::work,
                    "[J] shape (rows, n_u + 3): of actuators, damping, friction, applied forces")
      .def_property_readonly("total", &T::total, "[J] shape (rows,)")
      .def_property_readonly("impacts", &rows<&T::impacts>,
                             "structured array: t, first, count, contacts, law, fallback")
      .def_property_readonly("impulses", &impulses,
                             "structured array: pair, lambda, tangential, point, normal")
      .def_property_readonly("contacts", &contacts,
                             "structured array: row, t, impact (-1: held), and as impulses; None "
                             "where they were not recorded")
      .def_property_readonly("settlings", &rows<&T::settlings>, "structured array: t, pair")
      .def_property_readonly("fallbacks", &rows<&T::fallbacks>,
                             "structured array: t, tau, rung, energy, pair")
      .def_readonly("certificates", &T::certificates, "a text an impact, none unless asked for")
      .def_readonly("iterations", &T::iterations)
      .def_readonly("residual", &T::residual)
      .def_readonly("complete", &T::complete)
      .def_property_readonly("energy_error", &T::energy_error);
}

}  // namespace

void bind_rollout(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Settling, t, pair);
  PYBIND11_NUMPY_DTYPE(Fallback, t, tau, rung, energy, pair);
  PYBIND11_NUMPY_DTYPE(Impact, t, first, count, contacts, law, fallback);
  bind_trajectory(m);
  py::class_<Energies>(m, "Energies", energies_class_doc)
      .def_readonly("kinetic", &Energies::kinetic, "[J]")
      .def_readonly("potential", &Energies::potential, "[J]")
      .def_readonly("shadow", &Energies::shadow, "[J] H - h^2 kappa / 24")
      .def("__repr__", [](const Energies& e) {
        const auto show = [](double x) { return py::repr(py::float_(x)).cast<std::string>(); };
        return "Energies(kinetic=" + show(e.kinetic) + ", potential=" + show(e.potential) +
               ", shadow=" + show(e.shadow) + ")";
      });
  m.def("energies", &energies, energies_doc, py::arg("model"), py::arg("state"), py::arg("h"));
  m.def("adjoint", &adjoint_of, adjoint_doc, py::arg("model"), py::arg("options"), py::arg("t"),
        py::arg("q"), py::arg("p"), py::arg("control"), py::arg("q_hat"), py::arg("p_hat"),
        py::arg("forces") = py::none(), py::arg("qfrc") = py::none(), py::kw_only(),
        py::arg("every") = 1, py::arg("steps") = 0, py::arg("by_step") = py::none());
  m.def("simulate", &run, simulate_doc, py::arg("run"), py::arg("start"), py::arg("duration"),
        py::kw_only(), py::arg_v("options", StepOptions{}, "StepOptions()"),
        py::arg("record_every") = 1, py::arg("record_contacts") = false,
        py::arg("control") = py::none(), py::arg("control_every") = 1,
        py::arg("forces") = py::none(), py::arg("qfrc") = py::none(),
        py::arg("progress") = py::none());
}

}  // namespace saltus::bindings
