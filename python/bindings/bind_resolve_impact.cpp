// Variational floor: impulses at one instant, of any mass matrix and normals.
#include "bindings.hpp"
#include "saltus/variational/cascade.hpp"
#include "saltus/variational/friction.hpp"
#include "structured.hpp"
#include "words.hpp"

namespace saltus::bindings {
namespace {

constexpr auto outcome_doc =
    R"(Velocity after an impact, and the impulses that led there, in order.)";

constexpr auto friction_outcome_doc =
    R"(Velocity after an impact with friction, and the impulses that led there, in order.)";

constexpr auto resolve_impact_doc =
    R"(Impulses at one instant: while some contact approaches, reflect on one that does.

In contact space, with G = N M^-1 N^T and u = N v: `lambda_i = -(1 + e_i) u_i / G_ii`,
`u += G[:, i] lambda_i`. Seghete and Murphey, "Multiple Instantaneous Collisions in a Variational
Framework", (4), (5) and section III-D. Ends after finitely many impulses if all e = 1 and the cone
{v: N v >= 0} has an interior.

The order `ImpactOrder.symmetric` reflects on all that approach together, and `restitution=0` for
all contacts is, in any order, the projection on {v: N v >= 0}. `classify_impact` tells whether the
order matters, `impact_outcomes` by how much.

With `T` and `friction` contacts have Coulomb friction: one after another collides, in a compression
until it does not close any more and an expansion with e times the impulse of the compression
(Poisson's restitution), and in each friction is what dissipates most, `|beta| <= mu lambda`. Energy
never grows. Contacts that all have e = 0 are resolved together, and with `ImpactOrder.symmetric` all
that approach.

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
order : ImpactOrder or str
max_impulses : int
T : array_like, shape (2 m, n), optional
    Two rows a contact: `T v` is the velocity of the points that touch along two orthogonal unit
    tangents; one row is 0 where motion is planar. Belongs to `friction`.
friction : float or array_like, shape (m,), optional
    Coulomb's mu >= 0, of all contacts or of each. Belongs to `T`.

Returns
-------
ImpactOutcome
    `v`, and `impulses` with the fields "pair" (row of N) and "lambda".
FrictionOutcome
    With friction; its impulses have the field "tangential", shape (2,), too.

Raises
------
ModelError
    On shapes that do not fit, values that are not finite, M not positive definite, e not in [0, 1],
    mu < 0; on one of `T` and `friction` without the other.
JammedError
    When the impulses do not end.

Examples
--------
>>> import saltus
>>> out = saltus.resolve_impact(  # a puck slides down on a floor: x, z
...     M=[[1, 0], [0, 1]], N=[[0, 1]], v=[2, -1], T=[[1, 0], [0, 0]], friction=0.25
... )
>>> out.v.tolist()
[1.5, 1.0]
)";

using Outcome = std::variant<ImpactOutcome, FrictionOutcome>;

// Strings and pandas-like objects make pybind11's overload error; these are arrays in any case.
Outcome resolve(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N, const VecX& v,
                const PerContact& restitution, const Choice<ImpactOrder>& order, int max_impulses,
                const std::optional<MatX>& T, const std::optional<PerContact>& friction) {
  const VecX e = to_vector(restitution, N.rows(), "restitution");
  const CascadeOptions options{to_enum(order, "order"), max_impulses};
  if (T.has_value() != friction.has_value()) {
    throw ModelError(T ? "T is given without friction, one mu or one for each contact"
                       : "friction is given without T, two rows a contact: T v is the velocity "
                         "along two tangents");
  }
  const VecX mu = friction ? to_vector(*friction, N.rows(), "friction") : VecX();
  const py::gil_scoped_release release;
  if (T) return resolve_impact(M, N, *T, v, e, mu, options);
  return resolve_impact(M, N, v, e, options);
}

template <class O>
std::string show(const char* name, const O& outcome) {
  return std::string(name) +
         "(v=" + py::str(py::cast(outcome.v).attr("tolist")()).template cast<std::string>() + ", " +
         counted(static_cast<long>(outcome.impulses.size()), "impulse") + ")";
}

void bind_friction_outcome(py::module_& m) {
  using O = FrictionOutcome;
  py::class_<O>(m, "FrictionOutcome", friction_outcome_doc)
      .def_readonly("v", &O::v, "velocity after, shape (n,)")
      .def_property_readonly(
          "impulses",
          [](const py::object& self) {
            using I = FrictionImpulse;
            Fields fields;
            fields.add("pair", "i4", offsetof(I, contact));
            fields.add("lambda", "f8", offsetof(I, p));
            fields.add("tangential", "2f8", offsetof(I, p) + sizeof(double));
            return structured_view(self.cast<const O&>().impulses, fields.type(sizeof(I)), self);
          },
          "structured array: \"pair\" (row of N), \"lambda\" [N s], \"tangential\" [N s] along the "
          "contact's two rows of T")
      .def("__repr__", [](const O& o) { return show("FrictionOutcome", o); });
}

}  // namespace

void bind_resolve_impact(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Impulse, pair, lambda);
  py::class_<ImpactOutcome>(m, "ImpactOutcome", outcome_doc)
      .def_readonly("v", &ImpactOutcome::v, "velocity after, shape (n,)")
      .def_property_readonly(
          "impulses",
          [](const py::object& self) {
            return view(self.cast<const ImpactOutcome&>().impulses, self);
          },
          "structured array: \"pair\" (row of N), \"lambda\" [N s]")
      .def("__repr__",
           [](const ImpactOutcome& o) { return without_tails(show("ImpactOutcome", o)); });
  bind_friction_outcome(m);
  const CascadeOptions o;
  m.def("resolve_impact", &resolve, resolve_impact_doc, py::arg("M"), py::arg("N"), py::arg("v"),
        py::kw_only(), py::arg("restitution") = 1.0,
        py::arg_v("order", o.order, "ImpactOrder.fastest"),
        py::arg("max_impulses") = o.max_impulses, py::arg("T") = py::none(),
        py::arg("friction") = py::none());
}

}  // namespace saltus::bindings
