// Variational floor: impact laws, options, and impulses at one instant.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "saltus/variational/cascade.hpp"

namespace saltus::bindings {
namespace {

constexpr auto impact_law_doc = R"(Which energy an impact conserves.

nodal_energy: H(q, p+) = H(q, p-) at the impact, lambda = -2u/G in closed form; always solvable.
discrete_energy: that of the arcs on both sides; Seghete and Murphey, "Multiple Instantaneous
Collisions in a Variational Framework", (11c); the step is exactly symplectic.
)";

constexpr auto impact_order_doc = R"(Which of the approaching contacts is next.

fastest: the most negative u / sqrt(G), ties go to the lowest index; index: the lowest index.
)";

constexpr auto step_options_doc = R"(How to step.

Parameters
----------
h : float
    [s] step.
law : ImpactLaw
collisions : bool
    False: bodies pass through each other.
max_iterations : int
    Newton iterations an arc; 2 to 4 are usual.
max_impacts : int
    Impacts a step; more is a body bouncing faster than h can follow.
max_impulses : int
    Impulses an impact.
rest : float
    Gap rates below this part of sqrt(2 E G) are rest, not approach.
simultaneous : float
    A contact that would close within this part of h joins an impact.
)";

constexpr auto outcome_doc =
    R"(Velocity after an impact, and the impulses that led there, in order.)";

constexpr auto resolve_impact_doc =
    R"(Impulses at one instant: while some contact approaches, reflect on one that does.

In contact space, with G = N M^-1 N^T and u = N v: `lambda_i = -(1 + e) u_i / G_ii`,
`u += G[:, i] lambda_i`. Seghete and Murphey, "Multiple Instantaneous Collisions in a Variational
Framework", (4), (5) and section III-D. Ends after finitely many impulses if e = 1 and the cone
{v: N v >= 0} has an interior.

Parameters
----------
M : array_like, shape (n, n)
    Mass matrix, positive definite.
N : array_like, shape (m, n)
    Rows are gradients of the gaps.
v : array_like, shape (n,)
    Velocity before.
restitution : float
    e in [0, 1].
order : ImpactOrder
max_impulses : int

Returns
-------
ImpactOutcome
    `v`, and `impulses` with the fields "pair" (row of N) and "lambda".

Raises
------
ModelError
    On shapes that do not fit, values that are not finite, M not positive definite, e not in [0, 1].
JammedError
    When the impulses do not end.
)";

// Strings and pandas-like objects make pybind11's overload error; these are arrays in any case.
ImpactOutcome resolve(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                      const VecX& v, double restitution, ImpactOrder order, int max_impulses) {
  const py::gil_scoped_release release;
  return resolve_impact(M, N, v, {restitution, order, max_impulses});
}

void bind_enums(py::module_& m) {
  // IntEnum, so that a column of an array of impacts can be compared with it.
  py::native_enum<ImpactLaw>(m, "ImpactLaw", "enum.IntEnum", impact_law_doc)
      .value("nodal_energy", ImpactLaw::nodal_energy)
      .value("discrete_energy", ImpactLaw::discrete_energy)
      .export_values()
      .finalize();
  py::native_enum<ImpactOrder>(m, "ImpactOrder", "enum.Enum", impact_order_doc)
      .value("fastest", ImpactOrder::fastest)
      .value("index", ImpactOrder::index)
      .finalize();
}

void bind_step_options(py::module_& m) {
  using O = StepOptions;
  const O o;
  py::class_<O>(m, "StepOptions", step_options_doc)
      .def(py::init([](double h, const Unchecked<ImpactLaw>& law, bool collisions,
                       int max_iterations, int max_impacts, int max_impulses, double rest,
                       double simultaneous) {
             return O{h,           to_enum(law, "law"), collisions, max_iterations,
                      max_impacts, max_impulses,        rest,       simultaneous};
           }),
           py::arg("h") = o.h, py::arg_v("law", o.law, "ImpactLaw.nodal_energy"),
           py::arg("collisions") = o.collisions, py::kw_only(),
           py::arg("max_iterations") = o.max_iterations, py::arg("max_impacts") = o.max_impacts,
           py::arg("max_impulses") = o.max_impulses, py::arg("rest") = o.rest,
           py::arg("simultaneous") = o.simultaneous)
      .def_readonly("h", &O::h, "[s]")
      .def_readonly("law", &O::law)
      .def_readonly("collisions", &O::collisions)
      .def_readonly("max_iterations", &O::max_iterations)
      .def_readonly("max_impacts", &O::max_impacts)
      .def_readonly("max_impulses", &O::max_impulses)
      .def_readonly("rest", &O::rest)
      .def_readonly("simultaneous", &O::simultaneous)
      .def("__repr__", [](const O& self) {
        const py::object h = py::float_(self.h), law = py::cast(self.law);
        return "StepOptions(h=" + py::repr(h).cast<std::string>() +
               ", law=" + law.attr("name").cast<std::string>() + ", ...)";
      });
}

}  // namespace

void bind_variational(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Impulse, pair, lambda);
  bind_enums(m);
  bind_step_options(m);
  py::class_<ImpactOutcome>(m, "ImpactOutcome", outcome_doc)
      .def_readonly("v", &ImpactOutcome::v, "velocity after, shape (n,)")
      .def_property_readonly(
          "impulses",
          [](const py::object& self) {
            return view(self.cast<const ImpactOutcome&>().impulses, self);
          },
          "structured array: \"pair\" (row of N), \"lambda\" [N s]")
      .def("__repr__", [](const ImpactOutcome& o) {
        return "ImpactOutcome(v=" + py::str(py::cast(o.v).attr("tolist")()).cast<std::string>() +
               ", " + std::to_string(o.impulses.size()) + " impulses)";
      });
  const CascadeOptions o;
  m.def("resolve_impact", &resolve, resolve_impact_doc, py::arg("M"), py::arg("N"), py::arg("v"),
        py::kw_only(), py::arg("restitution") = o.restitution,
        py::arg_v("order", o.order, "ImpactOrder.fastest"),
        py::arg("max_impulses") = o.max_impulses);
}

}  // namespace saltus::bindings
