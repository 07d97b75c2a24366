// Variational floor: what can be said of impacts of any mass matrix and normals.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "saltus/variational/certificate.hpp"
#include "saltus/variational/outcomes.hpp"

namespace saltus::bindings {
namespace {

constexpr auto kind_doc = R"(What can be said of an impact for all velocities at once.

unique: the velocity after does not depend on the order of the impulses. order_dependent: for some
velocities it does, and any single answer is a convention. jammed: no velocity opens all gaps;
impulses need not end.
)";

constexpr auto certificate_doc = R"(Whether the outcome of an impact is unique, and why.

Attributes
----------
kind : ImpactKind
type : str
    If unique, the groups of contacts that affect each other, as finite reflection groups: "A3 x
    A1"; "plastic" if all restitutions are 0. Else empty.
impulses : int or None
    Upper bound of their number; None if no bound is known.
angles : ndarray, shape (m, m)
    [rad] Wedge angles, `cos angles[i, j] = -G[i, j] / sqrt(G[i, i] G[j, j])`; pi on the diagonal.
interior : float
    How fast all gaps can open at once: the largest d with `N w >= d sqrt(diag G)`, `w . M w = 1`;
    0 if none is positive.
same : list of int
    The first contact with each one's normal, mostly the contact itself: equal normals count once.
)";

constexpr auto classify_doc =
    R"(Whether the outcome of an impact on several contacts is unique, by their angles.

With `G = N M^-1 N^T` contacts are mirrors at the angles theta, `cos theta = -G_ij / sqrt(G_ii
G_jj)`. Elastic impacts on two contacts are unique if and only if theta = pi/m. Those on more are if
every theta is pi/m and the mirrors generate a finite group (J. Humphreys, Reflection Groups and
Coxeter Groups, 2.4); then the number of impulses does not depend on the order either.

Parameters
----------
M : array_like, shape (n, n)
    Mass matrix, positive definite.
N : array_like, shape (m, n)
    Rows are gradients of the gaps.
restitution : float or array_like, shape (m,)
    e in [0, 1], of all contacts or of each. With e < 1 only contacts that do not feel each other
    have a unique outcome; with all e = 0 any.
tolerance : float
    An angle is pi/m if m theta / pi is 1 to this.

Returns
-------
ImpactCertificate

Raises
------
ModelError
    On arguments as for `resolve_impact`, and on a tolerance outside (0, 1e-3].

Examples
--------
>>> import saltus
>>> saltus.classify_impact(M=[[1, 0, 0], [0, 1, 0], [0, 0, 1]], N=[[-1, 1, 0], [0, -1, 1]])
<ImpactCertificate: unique, A2, at most 3 impulses>
)";

constexpr auto outcomes_class_doc = R"(All outcomes of an impact, over every order of the impulses.

Attributes
----------
outcomes : list of ImpactOutcome
    With one order of impulses for each. The first is that of `ImpactOrder.index`.
spread : float
    [sqrt(J)] The largest distance of two outcomes in the kinetic metric, `sqrt(d . M d)`.
relative_spread : float
    Of the velocity's own size in this metric; at most 2.
states : int
    Number of velocities on the way.
)";

constexpr auto outcomes_doc = R"(All outcomes of an impact: a depth-first search over every order.

Each velocity is visited once: equal balls in a line take N! velocities, not all orders.

Parameters
----------
M : array_like, shape (n, n)
    Mass matrix, positive definite.
N : array_like, shape (m, n)
    Rows are gradients of the gaps.
v : array_like, shape (n,)
    Velocity before.
restitution : float or array_like, shape (m,)
    e in [0, 1], of all contacts or of each.
max_outcomes : int
max_states : int
    Velocities on the way.
tolerance : float
    Outcomes that differ by less than this part of the velocity are one, and slower approaches wait
    until no other contact approaches.

Returns
-------
ImpactOutcomes

Raises
------
ModelError
    On arguments as for `resolve_impact`, and where a bound does not suffice.
JammedError
    Where impulses lead back to a velocity that they came from, or have no end.

Examples
--------
>>> import saltus
>>> N = [[-0.8, 0.6, 0.8, -0.6, 0, 0], [-0.8, -0.6, 0, 0, 0.8, 0.6]]  # a disc hits two
>>> saltus.impact_outcomes([[i == j for j in range(6)] for i in range(6)], N, [1, 0, 0, 0, 0, 0])
<ImpactOutcomes: 2 outcomes, spread 42 % of v, 5 velocities met>
)";

ImpactCertificate classify(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                           const PerContact& restitution, double tolerance) {
  const VecX e = to_vector(restitution, N.rows(), "restitution");
  const py::gil_scoped_release release;
  return classify_impact(M, N, e, {tolerance});
}

ImpactOutcomes search(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                      const VecX& v, const PerContact& restitution, int max_outcomes,
                      long max_states, double tolerance) {
  const VecX e = to_vector(restitution, N.rows(), "restitution");
  const py::gil_scoped_release release;
  return impact_outcomes(M, N, v, e, {max_outcomes, max_states, tolerance});
}

std::string describe(const ImpactOutcomes& o) {
  std::string text = "<ImpactOutcomes: " + counted(static_cast<long>(o.outcomes.size()), "outcome");
  if (o.outcomes.size() > 1) {
    const py::str percent = py::str("{:.2g} % of v").format(100 * o.relative_spread);
    text += ", spread " + percent.cast<std::string>();
  }
  return text + ", " + counted(o.states, "velocity") + " met>";
}

void bind_certificate(py::module_& m) {
  py::native_enum<ImpactKind>(m, "ImpactKind", "enum.Enum", kind_doc)
      .value("unique", ImpactKind::unique)
      .value("order_dependent", ImpactKind::order_dependent)
      .value("jammed", ImpactKind::jammed)
      .finalize();
  using C = ImpactCertificate;
  py::class_<C>(m, "ImpactCertificate", certificate_doc)
      .def_readonly("kind", &C::kind)
      .def_readonly("type", &C::type, "the groups of contacts, if unique")
      .def_readonly("impulses", &C::impulses, "the greatest number, if known")
      .def_readonly("angles", &C::angles, "[rad] wedge angles, shape (m, m)")
      .def_readonly("interior", &C::interior, "how fast all gaps can open at once")
      .def_readonly("same", &C::same, "the first contact with each one's normal")
      .def("__repr__",
           [](const C& c) { return "<ImpactCertificate: " + saltus::describe(c) + ">"; })
      .def("__str__", [](const C& c) { return saltus::describe(c); });
  const CertificateOptions o;
  m.def("classify_impact", &classify, classify_doc, py::arg("M"), py::arg("N"), py::kw_only(),
        py::arg("restitution") = 1.0, py::arg("tolerance") = o.tolerance);
}

void bind_outcomes(py::module_& m) {
  using O = ImpactOutcomes;
  py::class_<O>(m, "ImpactOutcomes", outcomes_class_doc)
      .def_readonly("outcomes", &O::outcomes, "with one order of impulses for each")
      .def_readonly("spread", &O::spread, "[sqrt(J)] largest distance of two")
      .def_readonly("relative_spread", &O::relative_spread, "of the velocity's own size")
      .def_readonly("states", &O::states, "velocities met on the way")
      .def("__repr__", [](const O& all) { return describe(all); });
  const OutcomesOptions o;
  m.def("impact_outcomes", &search, outcomes_doc, py::arg("M"), py::arg("N"), py::arg("v"),
        py::kw_only(), py::arg("restitution") = 1.0, py::arg("max_outcomes") = o.max_outcomes,
        py::arg("max_states") = o.max_states, py::arg("tolerance") = o.tolerance);
}

}  // namespace

void bind_contact_space(py::module_& m) {
  bind_resolve_impact(m);
  bind_certificate(m);
  bind_outcomes(m);
}

}  // namespace saltus::bindings
