// Rollout floor: many steps in a row, with the interpreter's lock released.
#include "bindings.hpp"
#include "progress.hpp"
#include "saltus/rollout/simulate.hpp"

namespace saltus::bindings {
namespace {

constexpr auto trajectory_doc =
    R"(The arrays of a run, as read-only views; `saltus.Trajectory` wraps this.)";

constexpr auto simulate_doc = R"(Runs round(duration / h) steps from `start`; row 0 is `start`.

Parameters
----------
model : Model
start : State
duration : float
    [s] a whole number of steps.
options : StepOptions
record_every : int
    Steps between recorded rows.
progress : callable, optional
    Called about ten times a second with the part done in [0, 1]; what it returns is not used.

Returns
-------
Trajectory
    Not `complete` where Ctrl-C (KeyboardInterrupt) stopped it.

Raises
------
ModelError
    On a duration or h that is not positive, a duration that is no whole number of steps, a start
    that does not fit the model or overlaps.
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

Trajectory run(const Model& model, const State& start, double duration, const StepOptions& step,
               int record_every, const std::optional<Progress>& progress) {
  SimulateOptions options;
  options.h = step.h;
  options.law = step.law;
  options.collisions = step.collisions;
  options.record_every = record_every;
  options.step = step;
  options.progress = asking_python(progress);
  const py::gil_scoped_release release;
  return simulate(model, start, duration, options);
}

template <auto field>
py::object rows(const py::object& self) {
  return view(self.cast<const Trajectory&>().*field, self);
}

/// Friction of all impulses, 0 where they had none.
MatX tangentials(const Trajectory& run) {
  MatX out = MatX::Zero(static_cast<Eigen::Index>(run.impulses.size()), 3);
  for (const TangentialImpulse& each : run.friction) out.row(each.impulse) = each.p_W;
  return out;
}

void bind_trajectory(py::module_& m) {
  using T = Trajectory;
  py::class_<T>(m, "Trajectory", trajectory_doc)
      .def_readonly("model", &T::model)
      .def_readonly("options", &T::options)
      .def_readonly("t", &T::t, "[s] shape (rows,)")
      .def_readonly("q", &T::q, "[rad | m] shape (rows, n)")
      .def_readonly("v", &T::v, "[rad/s | m/s] shape (rows, n)")
      .def_readonly("p", &T::p, "shape (rows, n)")
      .def_readonly("kinetic", &T::kinetic, "[J] shape (rows,)")
      .def_readonly("potential", &T::potential, "[J] shape (rows,)")
      .def_readonly("shadow", &T::shadow, "[J] shape (rows,)")
      .def_property_readonly("total", &T::total, "[J] shape (rows,)")
      .def_property_readonly("impacts", &rows<&T::impacts>,
                             "structured array: t, first, count, contacts, law, fallback")
      .def_property_readonly("impulses", &rows<&T::impulses>, "structured array: pair, lambda")
      .def_property_readonly("tangentials", &tangentials, "[N s] shape (impulses, 3)")
      .def_property_readonly("settlings", &rows<&T::settlings>, "structured array: t, pair")
      .def_readonly("certificates", &T::certificates, "a text an impact, none unless asked for")
      .def_readonly("iterations", &T::iterations)
      .def_readonly("residual", &T::residual)
      .def_readonly("complete", &T::complete)
      .def_property_readonly("energy_error", &T::energy_error);
}

}  // namespace

void bind_rollout(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Settling, t, pair);
  PYBIND11_NUMPY_DTYPE(Impact, t, first, count, contacts, law, fallback);
  bind_trajectory(m);
  py::class_<Energies>(m, "Energies", energies_class_doc)
      .def_readonly("kinetic", &Energies::kinetic, "[J]")
      .def_readonly("potential", &Energies::potential, "[J]")
      .def_readonly("shadow", &Energies::shadow, "[J] H - h^2 kappa / 24");
  m.def("energies", &energies, energies_doc, py::arg("model"), py::arg("state"), py::arg("h"));
  m.def("simulate", &run, simulate_doc, py::arg("model"), py::arg("start"), py::arg("duration"),
        py::kw_only(), py::arg_v("options", StepOptions{}, "StepOptions()"),
        py::arg("record_every") = 1, py::arg("progress") = py::none());
}

}  // namespace saltus::bindings
