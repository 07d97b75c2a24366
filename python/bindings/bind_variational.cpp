// Variational floor: impact laws, orders and options.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "pickle.hpp"
#include "saltus/variational/cascade.hpp"

namespace saltus::bindings {
namespace {

constexpr auto impact_order_doc = R"(Which of the approaching contacts is next.

fastest: the most negative u / sqrt(G), ties go to the lowest index. index: the lowest index.
symmetric: all of them together, a reflection in the nearest face of their cone; keeps mirror
symmetry (D. Kaufman et al., "Reflections on Simultaneous Impact", SIGGRAPH 2012).
)";

constexpr auto step_options_doc = R"(Options of a step.

Parameters
----------
h : float
    [s] time step.
law : ImpactLaw, str or callable
    A callable takes an `ImpactProblem` and returns the momenta after, shape (n_v,).
collisions : bool
    False: bodies pass through each other.
order : ImpactOrder or str
    Which of several approaching contacts takes the next impulse.
certify : bool
    Reports for each impact on several contacts whether its outcome is unique (`classify_impact`).
max_iterations : int
    Newton iterations per arc; 2 to 4 are usual.
max_impacts : int
    Impacts per step; with more a body bounces faster than h can follow. Also the bound of arcs
    without an impact, but at most 100 of these.
max_halvings : int
    How often a failed step is repeated with arcs of half the duration: by default down to h / 64;
    0: never. `StepReport.fallbacks` reports it.
max_impulses : int
    Impulses per impact.
rest : float
    A contact with a gap rate below this fraction of sqrt(2 E G) is at rest, not approaching.
simultaneous : float
    A contact that would close within this part of h joins an impact.
strict : bool
    True: a step that neither whole nor halved arcs make is a `StepError`. Else its contacts are
    resolved by time stepping, which loses order and energy; `StepReport.fallbacks` tells.
)";

constexpr auto impact_problem_doc =
    R"(An impact, as a custom law sees it: all closed contacts.

Attributes
----------
t : float
    [s]
q : numpy.ndarray, shape (n_q,)
p, v : numpy.ndarray, shape (n_v,)
    Before the impact; v = M^-1 p.
M : numpy.ndarray, shape (n_v, n_v)
    Mass matrix at q.
N : numpy.ndarray, shape (m, n_v)
    Rows are gradients of the gaps.
u : numpy.ndarray, shape (m,)
    [m/s] gap rates N v, negative for an approaching contact.
restitution, friction : numpy.ndarray, shape (m,)
    Of each pair's materials.
pairs : list of int
    Indices of the pairs, as in `Model.pair_name`.
)";

void bind_impact_problem(py::module_& m) {
  using P = ImpactProblem;
  py::class_<P>(m, "ImpactProblem", impact_problem_doc)
      .def_readonly("t", &P::t)
      .def_readonly("q", &P::q)
      .def_readonly("p", &P::p)
      .def_readonly("v", &P::v)
      .def_readonly("M", &P::M)
      .def_readonly("N", &P::N)
      .def_readonly("u", &P::u)
      .def_readonly("restitution", &P::restitution)
      .def_readonly("friction", &P::friction)
      .def_readonly("pairs", &P::pairs)
      .def("__repr__", [](const P& problem) {
        return "<saltus.ImpactProblem: t = " + py::repr(py::float_(problem.t)).cast<std::string>() +
               " s, " + counted(problem.u.size(), "contact") + ">";
      });
}

std::string impact_law_doc() {
  std::string doc = "Which energy an impact conserves.\n\n";
  for (const LawEntry& each : impact_laws()) {
    doc += std::string(each.name) + "\n    " + each.meaning + "\n";
  }
  return doc +
         "\n(11c) is Seghete and Murphey, \"Multiple Instantaneous Collisions in a Variational "
         "Framework\".\n";
}

void bind_enums(py::module_& m) {
  // IntEnum, so that a column of an array of impacts can be compared with it.
  const std::string doc = impact_law_doc();
  py::native_enum<ImpactLaw> laws(m, "ImpactLaw", "enum.IntEnum", doc.c_str());
  for (const LawEntry& each : impact_laws()) laws.value(each.name, each.law);
  laws.finalize();
  py::native_enum<ImpactOrder>(m, "ImpactOrder", "enum.Enum", impact_order_doc)
      .value("fastest", ImpactOrder::fastest)
      .value("index", ImpactOrder::index)
      .value("symmetric", ImpactOrder::symmetric)
      .finalize();
}

/// All but a law that is a function.
template <auto... fields>
auto pickle_options() {
  return py::pickle(
      [](const StepOptions& o) {
        if (o.custom) throw py::type_error("StepOptions whose law is a function have no pickle");
        return to_tuple<fields...>(o);
      },
      &from_tuple<StepOptions, fields...>);
}

void bind_step_options(py::module_& m) {
  using O = StepOptions;
  const O o;
  py::class_<O>(m, "StepOptions", step_options_doc)
      .def(py::init(&make_step_options), py::arg("h") = o.h,
           py::arg_v("law", o.law, "ImpactLaw.nodal_energy"), py::arg("collisions") = o.collisions,
           py::kw_only(), py::arg_v("order", o.order, "ImpactOrder.fastest"),
           py::arg("certify") = o.certify, py::arg("max_iterations") = o.max_iterations,
           py::arg("max_impacts") = o.max_impacts, py::arg("max_halvings") = o.max_halvings,
           py::arg("max_impulses") = o.max_impulses, py::arg("rest") = o.rest,
           py::arg("simultaneous") = o.simultaneous, py::arg("strict") = o.strict)
      .def_readonly("h", &O::h, "[s]")
      .def_readonly("law", &O::law, "`ImpactLaw.custom` for a function")
      .def_readonly("order", &O::order)
      .def_readonly("certify", &O::certify)
      .def_readonly("collisions", &O::collisions)
      .def_readonly("max_iterations", &O::max_iterations)
      .def_readonly("max_impacts", &O::max_impacts)
      .def_readonly("max_halvings", &O::max_halvings)
      .def_readonly("max_impulses", &O::max_impulses)
      .def_readonly("rest", &O::rest)
      .def_readonly("simultaneous", &O::simultaneous)
      .def_readonly("strict", &O::strict)
      .def("__repr__",
           [](const O& self) {
             const py::object h = py::float_(self.h), law = py::cast(self.law);
             return "StepOptions(h=" + py::repr(h).cast<std::string>() +
                    ", law=" + law.attr("name").cast<std::string>() + ", ...)";
           })
      .def(pickle_options<&O::h, &O::law, &O::collisions, &O::order, &O::certify,
                          &O::max_iterations, &O::max_impacts, &O::max_halvings, &O::max_impulses,
                          &O::rest, &O::simultaneous, &O::strict>());
}

}  // namespace

void bind_variational(py::module_& m) {
  bind_enums(m);
  bind_impact_problem(m);
  bind_step_options(m);
}

}  // namespace saltus::bindings
