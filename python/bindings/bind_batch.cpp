// Rollout floor: many runs over threads, with the interpreter's lock released.
#include <pybind11/native_enum.h>

#include <algorithm>

#include "bindings.hpp"
#include "control.hpp"
#include "progress.hpp"
#include "saltus/rollout/batch.hpp"

namespace saltus::bindings {
namespace {

constexpr auto on_failure_doc = R"(What becomes of the other runs of a batch where one fails.

go_on
    They go on; `failures` of the batch holds the message.
stop
    The batch stops and raises the run's error, with "run <index>: " before it.
)";

constexpr auto batch_doc =
    R"(The arrays of a batch, as read-only views; `saltus.BatchTrajectory` wraps this.)";

constexpr auto states_doc = R"(Starts at t = 0, one of each row of q and v.

Parameters
----------
model : Model
q, v : numpy.ndarray, shape (runs, n)
    Coordinates [rad | m] and velocities.

Returns
-------
list of State

Raises
------
ModelError
    On other shapes; on a value that is not finite, by row and coordinate.
)";

constexpr auto simulate_batch_doc = R"(Runs round(duration / h) steps from every start.

Parameters
----------
batch : BatchTrajectory
    Is written: all runs, also where one raises an error; none where numbers make no run. Runs that
    Ctrl-C (KeyboardInterrupt) stopped are not `complete`.
starts : list of State
duration : float
    [s] a whole number of steps.
options : StepOptions
record_every : int
    Steps between recorded rows.
record_contacts : bool
    Whether to fill `contacts` of each run.
control : list of numpy.ndarray, shape (steps, n_u)
    Of each run, or none; the last row holds on.
forces, qfrc
    Of all runs, as `saltus.simulate` takes them.
threads : int
    0: as many as the machine runs at once. The bits do not depend on it.
on_failure : OnFailure or str
progress : callable, optional
    Called about ten times a second with the part done in [0, 1]; what it returns is not used.

Raises
------
ModelError
    Before anything runs, on numbers that make no run.
StepError, JammedError, ModelError
    With OnFailure.stop, the error of the first run, by index, that fails.
)";

void run(BatchTrajectory& out, const std::vector<State>& starts, double duration,
         const StepOptions& step, int record_every, bool record_contacts,
         const std::vector<MatX>& control, const Wrenches& forces, const Velocities& qfrc,
         int threads, const Choice<OnFailure>& on_failure,
         const std::optional<Progress>& progress) {
  BatchOptions options;
  options.run.step = step;
  options.run.record_every = record_every;
  options.run.record_contacts = record_contacts;
  options.run.progress = asking_python(progress);
  options.threads = threads;
  options.on_failure = to_enum(on_failure, "on_failure");
  const Model model = out.model;
  options.run.policy = to_policy(py::none(), forces, qfrc, model);
  for (const MatX& rows : control) {
    options.policies.push_back(to_policy(py::cast(rows), forces, qfrc, model));
  }
  const py::gil_scoped_release release;
  simulate_batch(model, starts, duration, options, out);
}

std::vector<State> make_states(const Model& model, const Eigen::Ref<const MatX>& q,
                               const Eigen::Ref<const MatX>& v) {
  const py::gil_scoped_release release;
  return states(model, q, v);
}

/// (runs * rows, n) as (runs, rows, n), without a copy.
template <auto field>
py::object by_run(const py::object& self) {
  const auto& batch = self.cast<const BatchTrajectory&>();
  const std::vector<py::ssize_t> shape{batch.runs(), batch.t.size(), (batch.*field).cols()};
  return read_only(py::array(py::dtype::of<double>(), shape, (batch.*field).data(), self));
}

/// One number of every run.
template <class Number, class Get>
auto each(Get get) {
  return [get](const BatchTrajectory& batch) {
    py::array_t<Number> out(batch.runs());
    for (int i = 0; i < batch.runs(); ++i) out.mutable_at(i) = get(batch.outcome[i]);
    return read_only(out);
  };
}

std::vector<int> stepped_runs(const BatchTrajectory& batch) {
  std::vector<int> out;
  for (int i = 0; i < batch.runs(); ++i) {
    const auto& rows = batch.outcome[static_cast<std::size_t>(i)].fallbacks;
    const auto is_lossy = [](const Fallback& each) { return each.rung != Rung::halved; };
    if (std::any_of(rows.begin(), rows.end(), is_lossy)) out.push_back(i);
  }
  return out;
}

void bind_batch_trajectory(py::module_& m) {
  using B = BatchTrajectory;
  py::class_<B>(m, "BatchTrajectory", batch_doc)
      .def(py::init([](const Model& model) { return B{.model = model}; }),
           "Of no runs; `simulate_batch` writes to it.", py::arg("model"))
      .def_readonly("model", &B::model)
      .def_readonly("options", &B::options)
      .def_readonly("t", &B::t, "[s] shape (rows,)")
      .def_property_readonly("q", &by_run<&B::q>, "[rad | m] shape (runs, rows, n)")
      .def_property_readonly("v", &by_run<&B::v>, "[rad/s | m/s] shape (runs, rows, n)")
      .def_property_readonly("p", &by_run<&B::p>, "shape (runs, rows, n)")
      .def_property_readonly("control", &by_run<&B::control>, "shape (runs, rows, n_u)")
      .def_property_readonly("work", &by_run<&B::work>, "[J] shape (runs, rows, n_u + 3)")
      .def_readonly("kinetic", &B::kinetic, "[J] shape (runs, rows)")
      .def_readonly("potential", &B::potential, "[J] shape (runs, rows)")
      .def_readonly("shadow", &B::shadow, "[J] shape (runs, rows)")
      .def_property_readonly("impacts", each<py::ssize_t>([](const RunOutcome& o) {
                               return static_cast<py::ssize_t>(o.impacts.size());
                             }),
                             "number of impacts, shape (runs,)")
      .def_property_readonly("rows", each<py::ssize_t>([](const RunOutcome& o) {
                               return static_cast<py::ssize_t>(o.rows);
                             }),
                             "number of rows that were reached, shape (runs,)")
      .def_property_readonly("complete", each<bool>([](const RunOutcome& o) { return o.complete; }),
                             "shape (runs,)")
      .def_property_readonly("energy_error", &B::energy_error, "shape (runs,)")
      .def_property_readonly("failures", &B::failures, "message of each run that failed")
      .def_property_readonly("stepped", &stepped_runs, "runs with arcs by time stepping")
      .def("run", &B::run, "One run as a Trajectory of its own.", py::arg("index"));
}

}  // namespace

void bind_batch(py::module_& m) {
  py::native_enum<OnFailure>(m, "OnFailure", "enum.Enum", on_failure_doc)
      .value("go_on", OnFailure::go_on)
      .value("stop", OnFailure::stop)
      .finalize();
  bind_batch_trajectory(m);
  m.def("states", &make_states, states_doc, py::arg("model"), py::arg("q"), py::arg("v"));
  m.def("simulate_batch", &run, simulate_batch_doc, py::arg("batch"), py::arg("starts"),
        py::arg("duration"), py::kw_only(), py::arg_v("options", StepOptions{}, "StepOptions()"),
        py::arg("record_every") = 1, py::arg("record_contacts") = false,
        py::arg_v("control", std::vector<MatX>{}, "[]"), py::arg("forces") = py::none(),
        py::arg("qfrc") = py::none(), py::arg("threads") = 0,
        py::arg_v("on_failure", OnFailure::go_on, "OnFailure.go_on"),
        py::arg("progress") = py::none());
}

}  // namespace saltus::bindings
