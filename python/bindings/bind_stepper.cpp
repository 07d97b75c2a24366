// Variational floor: the stepper.
#include "saltus/variational/overlap.hpp"
#include "shared_stepper.hpp"

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
record : bool
    Whether steps record what `jvp`, `vjp` and `derivative` are made of.

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
  bind_derivative_types(m);
  using S = SharedStepper;
  const StepOptions o;
  py::class_<S> stepper(m, "Stepper", stepper_doc);
  stepper
      .def(py::init([](const Unchecked<Model>& model, double h, const LawChoice& law,
                       bool collisions, const Choice<ImpactOrder>& order, bool certify,
                       int max_iterations, int max_impacts, int max_halvings, int max_impulses,
                       double rest, double simultaneous, bool strict, bool record) {
             return std::make_unique<S>(
                 to_model(model),
                 make_step_options(h, law, collisions, order, certify, max_iterations, max_impacts,
                                   max_halvings, max_impulses, rest, simultaneous, strict),
                 record);
           }),
           py::arg("model"), py::arg("h") = o.h, py::arg_v("law", o.law, "ImpactLaw.nodal_energy"),
           py::kw_only(), py::arg("collisions") = o.collisions,
           py::arg_v("order", o.order, "ImpactOrder.fastest"), py::arg("certify") = o.certify,
           py::arg("max_iterations") = o.max_iterations, py::arg("max_impacts") = o.max_impacts,
           py::arg("max_halvings") = o.max_halvings, py::arg("max_impulses") = o.max_impulses,
           py::arg("rest") = o.rest, py::arg("simultaneous") = o.simultaneous,
           py::arg("strict") = o.strict, py::arg("record") = false)
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
  bind_step_derivatives(stepper);
}

}  // namespace saltus::bindings
