// Variational floor: the stepper.
#include <atomic>
#include <mutex>
#include <thread>

#include "bindings.hpp"
#include "control.hpp"
#include "named_report.hpp"
#include "saltus/variational/overlap.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus::bindings {
namespace {

constexpr auto stepper_doc =
    R"(The variational impact stepper: one step of size h with all impacts inside it.

Deterministic: the same sequence of states in gives the same bits out. A stepper that several
threads use serves them one after the other; make one a thread.

Parameters
----------
model : Model
h : float
    [s] step.
law : ImpactLaw, str or callable
    As in `StepOptions`.
collisions, order, certify, max_iterations, max_impacts, max_halvings, max_impulses, rest,
simultaneous
    As in `StepOptions`.

Raises
------
ModelError
    Where an option is out of its range.
)";

constexpr auto advance_doc = R"(The state h later; `state` is not changed.

Parameters
----------
state : State
control : mapping of names to values, or array_like, shape (n_u,), optional
    Of the actuators over the step; those not named are 0.
forces : mapping of links' names to Wrench, optional
    Forces and torques on links over the step.
qfrc : mapping of names to values, or array_like, shape (n_v,), optional
    [N m | N] forces on the coordinates over the step.

Returns
-------
State

Raises
------
ModelError
    On a state that does not fit the model or overlaps; names pairs and depths.
StepError
    When an arc does not converge or the impacts of the step do not end.
JammedError
    When the impulses at one instant do not end.
)";

constexpr auto resolve_overlap_doc = R"(The nearest configuration without overlap.

Moves bodies out of each other as little as the kinetic metric allows, step by step: each
minimizes |dq|_M subject to phi + phi_q dq >= 0. Joints' limits are such gaps, and loops stay
closed.

Parameters
----------
model : Model
q : mapping of names to values, or array_like, shape (n,)
    [rad | m] coordinates; those not named are 0.

Returns
-------
numpy.ndarray, shape (n,)

Raises
------
ModelError
    Where `q` does not fit the model; where pairs still overlap in the end: names them and their
    depths.
)";

const Model& to_model(const Unchecked<Model>& model) {
  if (py::isinstance<Model>(model.value)) return model.value.cast<const Model&>();
  throw py::type_error("model is a " +
                       py::type::of(model.value).attr("__name__").cast<std::string>() +
                       "; saltus.load_urdf makes a Model of it");
}

/// Advancing releases the interpreter's lock, so a second thread could come in: the mutex. What a
/// step asks (a law, a force, a motion) comes in by the same thread: that would wait for itself.
struct SharedStepper {
  Stepper stepper;
  std::mutex mutex;
  std::atomic<std::thread::id> owner;

  /// The stepper for one call.
  struct Turn {
    explicit Turn(SharedStepper& of) : shared(of) {
      if (shared.owner == std::this_thread::get_id()) {
        throw ModelError(
            "the stepper is in a step, which asks this function: it can neither advance it nor "
            "read its report; another Stepper can");
      }
      shared.mutex.lock();
      shared.owner = std::this_thread::get_id();
    }
    ~Turn() {
      shared.owner = std::thread::id();
      shared.mutex.unlock();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    SharedStepper& shared;
  };

  SharedStepper(const Model& model, const StepOptions& options) : stepper(model, options) {}

  State advance(const State& state, const py::object& control, const Wrenches& forces,
                const Velocities& qfrc) {
    const ForceInput input = to_input(control, forces, qfrc, stepper.model());
    const py::gil_scoped_release release;
    const Turn turn(*this);
    return stepper.advance(state, input);
  }
  NamedReport report() {
    const py::gil_scoped_release release;
    const Turn turn(*this);
    return with_names(stepper.model(), stepper.report());
  }
};

}  // namespace

void bind_stepper(py::module_& m) {
  m.def(
      "resolve_overlap",
      [](const Unchecked<Model>& model, const Coordinates& q) {
        const Model& checked = to_model(model);
        const VecX start = to_vector(q, checked, "q");
        const py::gil_scoped_release release;
        return resolve_overlap(checked, start);
      },
      resolve_overlap_doc, py::arg("model"), py::arg("q"));
  bind_report(m);
  using S = SharedStepper;
  const StepOptions o;
  py::class_<S>(m, "Stepper", stepper_doc)
      .def(py::init([](const Unchecked<Model>& model, double h, const LawChoice& law,
                       bool collisions, const Choice<ImpactOrder>& order, bool certify,
                       int max_iterations, int max_impacts, int max_halvings, int max_impulses,
                       double rest, double simultaneous, bool strict) {
             return std::make_unique<S>(
                 to_model(model),
                 make_step_options(h, law, collisions, order, certify, max_iterations, max_impacts,
                                   max_halvings, max_impulses, rest, simultaneous, strict));
           }),
           py::arg("model"), py::arg("h") = o.h, py::arg_v("law", o.law, "ImpactLaw.nodal_energy"),
           py::kw_only(), py::arg("collisions") = o.collisions,
           py::arg_v("order", o.order, "ImpactOrder.fastest"), py::arg("certify") = o.certify,
           py::arg("max_iterations") = o.max_iterations, py::arg("max_impacts") = o.max_impacts,
           py::arg("max_halvings") = o.max_halvings, py::arg("max_impulses") = o.max_impulses,
           py::arg("rest") = o.rest, py::arg("simultaneous") = o.simultaneous,
           py::arg("strict") = o.strict)
      .def("advance", &S::advance, advance_doc, py::arg("state"), py::kw_only(),
           py::arg("control") = py::none(), py::arg("forces") = py::none(),
           py::arg("qfrc") = py::none())
      .def_property_readonly("report", &S::report, "StepReport of the step before.")
      .def_property_readonly("model", [](const S& s) { return s.stepper.model(); })
      .def_property_readonly("options", [](const S& s) { return s.stepper.options(); })
      .def("__repr__", [](const S& s) {
        return "Stepper(" + py::repr(py::cast(s.stepper.model())).cast<std::string>() +
               ", h=" + py::repr(py::float_(s.stepper.options().h)).cast<std::string>() + ")";
      });
}

}  // namespace saltus::bindings
