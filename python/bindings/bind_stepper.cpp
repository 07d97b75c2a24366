// Variational floor: the stepper and its report.
#include <mutex>

#include "bindings.hpp"
#include "saltus/variational/overlap.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus::bindings {
namespace {

constexpr auto impact_doc = R"(All impulses at one instant, with pairs by name.

Attributes
----------
t : float
    [s]
pairs : list of str
    Names of the pairs, in the order of the impulses; a pair may occur more than once.
lambdas : numpy.ndarray, shape (impulses,)
    [N s] the impulses, `p += lambda * phi_q`.
contacts : int
    Pairs that touched.
law : ImpactLaw
    The law that was used.
fallback : bool
    Another law was asked for and nodal_energy used, an impulse being too weak for it.
certificate : str
    Whether the outcome is unique, "unique, A2, at most 3 impulses"; "" where that was not asked for
    (`certify`), and of a single contact.
)";

constexpr auto report_doc = R"(What happened in a step.

Attributes
----------
iterations : int
    Newton iterations over all arcs tried.
arcs : int
    Arcs that the step is made of; 1 without impacts.
sustained : int
    Contacts of its arcs that were held closed by a force.
residual : float
    [largest momentum] of the worst arc.
impacts : list of Impact
settlings : list of (float, str)
    Time [s] and name of each pair that bounced ever lower and has come to rest.
)";

constexpr auto stepper_doc =
    R"(The variational impact stepper: one step of size h with all impacts inside it.

Deterministic: the same sequence of states in gives the same bits out. A stepper that several
threads use serves them one after the other; make one a thread.

Parameters
----------
model : Model
h : float
    [s] step.
law : ImpactLaw or callable
    As in `StepOptions`.
collisions, order, certify, max_iterations, max_impacts, max_impulses, rest, simultaneous
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
minimizes |dq|_M subject to phi + phi_q dq >= 0.

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

/// An Impact with its pairs by name and its own impulses.
struct NamedImpact {
  double t;
  std::vector<std::string> pairs;
  VecX lambdas;
  int contacts;
  ImpactLaw law;
  bool fallback;
  std::string certificate;
};

NamedImpact with_names(const Model& model, const StepReport& report, const Impact& impact) {
  NamedImpact out{impact.t,        {}, VecX(impact.count), impact.contacts, impact.law,
                  impact.fallback, ""};
  for (int i = 0; i < impact.count; ++i) {
    const Impulse& impulse = report.impulses[impact.first + i];
    out.pairs.push_back(model.pair_name(impulse.pair));
    out.lambdas[i] = impulse.lambda;
  }
  return out;
}

/// Stepper's own report is overwritten by its next step; Python keeps copies.
struct NamedReport {
  int iterations, arcs, sustained;
  double residual;
  std::vector<NamedImpact> impacts;
  std::vector<std::pair<double, std::string>> settlings;
};

/// Advancing releases the interpreter's lock, so a second thread could come in: the mutex.
struct SharedStepper {
  Stepper stepper;
  std::mutex mutex;

  SharedStepper(const Model& model, const StepOptions& options) : stepper(model, options) {}

  State advance(const State& state) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex);
    return stepper.advance(state);
  }
  NamedReport report() {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex);
    const StepReport& r = stepper.report();
    NamedReport out{r.iterations, r.arcs, r.sustained, r.residual, {}, {}};
    for (const Impact& impact : r.impacts) {
      out.impacts.push_back(with_names(stepper.model(), r, impact));
    }
    for (std::size_t i = 0; i < r.certificates.size(); ++i) {
      out.impacts[i].certificate = r.certificates[i];
    }
    for (const Settling& each : r.settlings) {
      out.settlings.emplace_back(each.t, stepper.model().pair_name(each.pair));
    }
    return out;
  }
};

void bind_impact(py::module_& m) {
  using I = NamedImpact;
  py::class_<I>(m, "Impact", impact_doc)
      .def(py::init([](double t, std::vector<std::string> pairs, const VecX& lambdas, int contacts,
                       ImpactLaw law, bool fallback, const std::string& certificate) {
             return I{t, std::move(pairs), lambdas, contacts, law, fallback, certificate};
           }),
           py::arg("t"), py::arg("pairs"), py::arg("lambdas"), py::kw_only(), py::arg("contacts"),
           py::arg("law"), py::arg("fallback"), py::arg("certificate") = "")
      .def_readonly("t", &I::t)
      .def_readonly("pairs", &I::pairs)
      .def_readonly("lambdas", &I::lambdas)
      .def_readonly("contacts", &I::contacts)
      .def_readonly("law", &I::law)
      .def_readonly("fallback", &I::fallback)
      .def_readonly("certificate", &I::certificate)
      .def("__repr__", [](const I& self) {
        return "Impact(t=" + py::repr(py::float_(self.t)).cast<std::string>() +
               ", pairs=" + py::repr(py::cast(self.pairs)).cast<std::string>() +
               ", lambdas=" + py::str(py::cast(self.lambdas).attr("tolist")()).cast<std::string>() +
               ")";
      });
}

void bind_report(py::module_& m) {
  using R = NamedReport;
  py::class_<R>(m, "StepReport", report_doc)
      .def_readonly("iterations", &R::iterations)
      .def_readonly("arcs", &R::arcs)
      .def_readonly("sustained", &R::sustained)
      .def_readonly("residual", &R::residual)
      .def_readonly("impacts", &R::impacts)
      .def_readonly("settlings", &R::settlings)
      .def("__repr__", [](const R& self) {
        return "StepReport(iterations=" + std::to_string(self.iterations) +
               ", arcs=" + std::to_string(self.arcs) +
               ", impacts=" + py::repr(py::cast(self.impacts)).cast<std::string>() + ")";
      });
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
  bind_impact(m);
  bind_report(m);
  using S = SharedStepper;
  const StepOptions o;
  py::class_<S>(m, "Stepper", stepper_doc)
      .def(py::init([](const Unchecked<Model>& model, double h, const LawChoice& law,
                       bool collisions, const Unchecked<ImpactOrder>& order, bool certify,
                       int max_iterations, int max_impacts, int max_impulses, double rest,
                       double simultaneous) {
             return std::make_unique<S>(
                 to_model(model),
                 make_step_options(h, law, collisions, order, certify, max_iterations, max_impacts,
                                   max_impulses, rest, simultaneous));
           }),
           py::arg("model"), py::arg("h") = o.h, py::arg_v("law", o.law, "ImpactLaw.nodal_energy"),
           py::kw_only(), py::arg("collisions") = o.collisions,
           py::arg_v("order", o.order, "ImpactOrder.fastest"), py::arg("certify") = o.certify,
           py::arg("max_iterations") = o.max_iterations, py::arg("max_impacts") = o.max_impacts,
           py::arg("max_impulses") = o.max_impulses, py::arg("rest") = o.rest,
           py::arg("simultaneous") = o.simultaneous)
      .def("advance", &S::advance, advance_doc, py::arg("state"))
      .def_property_readonly("report", &S::report, "StepReport of the step before.")
      .def_property_readonly("model", [](const S& s) { return s.stepper.model(); })
      .def_property_readonly("options", [](const S& s) { return s.stepper.options(); })
      .def("__repr__", [](const S& s) {
        return "Stepper(" + py::repr(py::cast(s.stepper.model())).cast<std::string>() +
               ", h=" + py::repr(py::float_(s.stepper.options().h)).cast<std::string>() + ")";
      });
}

}  // namespace saltus::bindings
