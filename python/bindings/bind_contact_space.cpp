// Variational floor: impulses at one instant, of any mass matrix and normals.
#include "bindings.hpp"
#include "saltus/variational/cascade.hpp"

namespace saltus::bindings {
namespace {

constexpr auto outcome_doc =
    R"(Velocity after an impact, and the impulses that led there, in order.)";

constexpr auto resolve_impact_doc =
    R"(Impulses at one instant: while some contact approaches, reflect on one that does.

In contact space, with G = N M^-1 N^T and u = N v: `lambda_i = -(1 + e_i) u_i / G_ii`,
`u += G[:, i] lambda_i`. Seghete and Murphey, "Multiple Instantaneous Collisions in a Variational
Framework", (4), (5) and section III-D. Ends after finitely many impulses if all e = 1 and the cone
{v: N v >= 0} has an interior.

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

VecX to_vector(const Restitution& restitution, Eigen::Index contacts) {
  const auto array = py::array_t<double, py::array::forcecast>::ensure(restitution.value);
  if (!array || array.ndim() > 1) {
    throw ModelError("restitution is one number or one for each contact, not " +
                     py::repr(restitution.value).cast<std::string>());
  }
  if (array.ndim() == 0) return VecX::Constant(contacts, *array.data());
  return array.cast<VecX>();
}

// Strings and pandas-like objects make pybind11's overload error; these are arrays in any case.
ImpactOutcome resolve(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                      const VecX& v, const Restitution& restitution,
                      const Unchecked<ImpactOrder>& order, int max_impulses) {
  const VecX e = to_vector(restitution, N.rows());
  const CascadeOptions options{to_enum(order, "order"), max_impulses};
  const py::gil_scoped_release release;
  return resolve_impact(M, N, v, e, options);
}

}  // namespace

void bind_contact_space(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Impulse, pair, lambda);
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
        py::kw_only(), py::arg("restitution") = 1.0,
        py::arg_v("order", o.order, "ImpactOrder.fastest"),
        py::arg("max_impulses") = o.max_impulses);
}

}  // namespace saltus::bindings
