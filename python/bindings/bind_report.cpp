// Variational floor: what happened in a step.
#include <limits>

#include "named_report.hpp"
#include "words.hpp"

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
tangentials : numpy.ndarray, shape (impulses, 3)
    [N s] friction impulses on the pair's first shape, in the world frame; 0 without friction.
points : numpy.ndarray, shape (impulses, 3)
    [m] where each impulse acts, in the world frame: halfway between the nearest points of the two
    shapes. NaN in runs from older files without points.
normals : numpy.ndarray, shape (impulses, 3)
    Unit normal of each contact, in the world frame, from the pair's second shape to the first, on
    which `lambda * normal + tangential` acts. NaN as `points`.
contacts : int
    Closed contacts.
law : ImpactLaw
    The law that was used.
fallback : bool
    nodal_energy replaced the chosen law, because an impulse was too weak for it.
certificate : str
    Whether the outcome is unique, "unique, A2, at most 3 impulses"; "" where that was not asked for
    (`certify`), and of a single contact. With friction whether another order of these impulses was
    possible: "order_dependent", else "unique", or "unique, plastic" where all restitutions are 0.
)";

constexpr auto report_doc = R"(The report of a step.

Attributes
----------
iterations : int
    Newton iterations over all arcs tried.
arcs : int
    Arcs of the step; 1 without impacts.
sustained : int
    Contacts held closed by a force, summed over the arcs.
residual : float
    [largest momentum] of the worst arc.
friction_residual : float
    [largest impulse or rate] residual of Coulomb's law, the worst of the arcs and of the closing
    half kicks. Up to 1e-9 is rounding; more than 1e-6 is a `StepError`. 0 without friction.
impacts : list of Impact
settlings : list of (float, str)
    Time [s] and name of each pair that bounced ever lower and has come to rest.
fallbacks : list of (float, float, str, float, str)
    Empty as a rule. What could not be made as it should: its start [s], the duration of its arcs
    [s], how, what that changed of the energy [J], and the pair that took the largest impulse.
    "halved": the step, by arcs of half of it, a quarter, ...; as exact as with a smaller h.
    "unlocated": one arc, by time stepping: contacts do not rebound in it. "stopped": one arc that
    bodies in contact stand still in.
contacts : list of ContactImpulse
    Impulses that held contacts closed over the step, each pair once, without those of impacts.
work : dict of str to float
    [J] done on the model in the step: by each actuator, by "damping" of joints and dampers, by dry
    "friction", and by "applied" forces, those that are functions included.
loops : dict of str to numpy.ndarray
    [N s | N m s] what each loop pushed in the step, by its rows (`Model.loop_gaps`), without
    impacts; divided by the step `h` it is the mean force on its end a.
)";

constexpr auto contact_doc =
    R"(The impulse that held a contact closed over a step: a sum, without impulses of impacts.

`impulse * normal + tangential` acts on the pair's first shape at `point`, the opposite on the
second. Divided by the time step `h` these are mean forces. The summed impulses act at the place of
the contact at the start of each arc of the step, and at its end; `point` and `normal` are their
mean, weighted by the impulses. For a body that slides on a plane the sum also has the moment of
its parts.

Attributes
----------
pair : str
    Name of the pair.
impulse : float
    [N s] normal impulse, >= 0.
tangential : numpy.ndarray, shape (3,)
    [N s] friction impulse, across the normal, in the world frame; 0 without friction.
point : numpy.ndarray, shape (3,)
    [m] in the world frame, halfway between the nearest points of the two shapes.
normal : numpy.ndarray, shape (3,)
    Unit normal in the world frame, from the pair's second shape to the first.
)";

NamedImpact with_names(const Model& model, const StepReport& report, const Impact& impact) {
  const Eigen::Index n = impact.count;
  NamedImpact out{impact.t,        {},         VecX(n),         MatX(n, 3), MatX(n, 3), MatX(n, 3),
                  impact.contacts, impact.law, impact.fallback, ""};
  for (int i = 0; i < impact.count; ++i) {
    const ContactImpulse& impulse = report.impulses[impact.first + i];
    out.pairs.push_back(model.pair_name(impulse.pair));
    out.lambdas[i] = impulse.lambda;
    out.tangentials.row(i) = impulse.p_W;
    out.points.row(i) = impulse.point_W;
    out.normals.row(i) = impulse.n_W;
  }
  return out;
}

/// What is given of three numbers for each impulse, else `unknown`.
MatX to_rows(const std::optional<MatX>& given, Eigen::Index impulses, double unknown,
             const std::string& what) {
  if (!given) return MatX::Constant(impulses, 3, unknown);
  if (given->rows() == impulses && given->cols() == 3) return *given;
  throw ModelError(what + " is (" + std::to_string(given->rows()) + ", " +
                   std::to_string(given->cols()) + "); there " + (impulses == 1 ? "is " : "are ") +
                   counted(impulses, "impulse") + ", three numbers each");
}

/// Longer cascades are counted.
std::string show_impact(const py::object& impact) {
  constexpr std::size_t most_impulses = 8;
  const auto& self = impact.cast<const NamedImpact&>();
  if (self.pairs.size() > most_impulses) {
    return "<saltus.Impact: t = " + printed("%g", self.t) + " s, " +
           in_words("impacts", "count_line", impact).cast<std::string>() + ">";
  }
  return "Impact(t=" + py::repr(py::float_(self.t)).cast<std::string>() +
         ", pairs=" + py::repr(py::cast(self.pairs)).cast<std::string>() +
         ", lambdas=" + py::str(py::cast(self.lambdas).attr("tolist")()).cast<std::string>() + ")";
}

void bind_impact(py::module_& m) {
  using I = NamedImpact;
  py::class_<I>(m, "Impact", impact_doc)
      .def(py::init([](double t, std::vector<std::string> pairs, const VecX& lambdas, int contacts,
                       const Choice<ImpactLaw>& law, bool fallback, const std::string& certificate,
                       const std::optional<MatX>& tangentials, const std::optional<MatX>& points,
                       const std::optional<MatX>& normals) {
             const Eigen::Index n = lambdas.size();
             const double nan = std::numeric_limits<double>::quiet_NaN();
             return I{t,
                      std::move(pairs),
                      lambdas,
                      to_rows(tangentials, n, 0, "tangentials"),
                      to_rows(points, n, nan, "points"),
                      to_rows(normals, n, nan, "normals"),
                      contacts,
                      to_enum(law, "law"),
                      fallback,
                      certificate};
           }),
           py::arg("t"), py::arg("pairs"), py::arg("lambdas"), py::kw_only(), py::arg("contacts"),
           py::arg("law"), py::arg("fallback"), py::arg("certificate") = "",
           py::arg("tangentials") = std::nullopt, py::arg("points") = std::nullopt,
           py::arg("normals") = std::nullopt)
      .def_readonly("t", &I::t)
      .def_readonly("pairs", &I::pairs)
      .def_readonly("lambdas", &I::lambdas)
      .def_readonly("tangentials", &I::tangentials)
      .def_readonly("points", &I::points)
      .def_readonly("normals", &I::normals)
      .def_readonly("contacts", &I::contacts)
      .def_readonly("law", &I::law)
      .def_readonly("fallback", &I::fallback)
      .def_readonly("certificate", &I::certificate)
      .def("__repr__", &show_impact)
      .def("__str__", [](const py::object& self) { return in_words("impacts", "printed", self); })
      .def("_repr_html_",
           [](const py::object& self) { return in_words("impacts", "as_html", self); });
}

void bind_contact(py::module_& m) {
  using C = NamedContact;
  py::class_<C>(m, "ContactImpulse", contact_doc)
      .def_readonly("pair", &C::pair)
      .def_readonly("impulse", &C::impulse)
      .def_readonly("tangential", &C::tangential)
      .def_readonly("point", &C::point)
      .def_readonly("normal", &C::normal)
      .def("__repr__", [](const C& self) {
        const auto listed = [](const Vec3& x) {
          return py::str(py::cast(x).attr("tolist")()).cast<std::string>();
        };
        return "ContactImpulse(pair=" + py::repr(py::cast(self.pair)).cast<std::string>() +
               ", impulse=" + py::repr(py::float_(self.impulse)).cast<std::string>() +
               ", tangential=" + listed(self.tangential) + ", point=" + listed(self.point) +
               ", normal=" + listed(self.normal) + ")";
      });
}

void bind_step_report(py::module_& m) {
  using R = NamedReport;
  py::class_<R>(m, "StepReport", report_doc)
      .def_readonly("iterations", &R::iterations)
      .def_readonly("arcs", &R::arcs)
      .def_readonly("sustained", &R::sustained)
      .def_readonly("residual", &R::residual)
      .def_readonly("friction_residual", &R::friction_residual)
      .def_readonly("impacts", &R::impacts)
      .def_readonly("settlings", &R::settlings)
      .def_readonly("contacts", &R::contacts)
      .def_readonly("fallbacks", &R::fallbacks)
      .def_readonly("work", &R::work)
      .def_readonly("loops", &R::loops)
      .def("__repr__", [](const R& self) {
        return "StepReport(iterations=" + std::to_string(self.iterations) +
               ", arcs=" + std::to_string(self.arcs) +
               ", impacts=" + py::repr(py::cast(self.impacts)).cast<std::string>() + ")";
      });
}

}  // namespace

NamedReport with_names(const Model& model, const StepReport& r) {
  NamedReport out{r.iterations, r.arcs, r.sustained, r.residual, r.friction_residual,    {},
                  {},           {},     {},          {},         by_loop(model, r.loops)};
  std::vector<std::string> sources = names_of(model->forces.actuators);
  sources.insert(sources.end(), other_sources.begin(), other_sources.end());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    out.work[sources[k]] = i < r.work.size() ? r.work[i] : 0;
  }
  for (const Impact& impact : r.impacts) {
    out.impacts.push_back(with_names(model, r, impact));
  }
  for (std::size_t i = 0; i < r.certificates.size(); ++i) {
    out.impacts[i].certificate = r.certificates[i];
  }
  for (const Settling& each : r.settlings) {
    out.settlings.emplace_back(each.t, model.pair_name(each.pair));
  }
  for (const Fallback& each : r.fallbacks) {
    out.fallbacks.emplace_back(each.t, each.tau, rung_name(each.rung), each.energy,
                               each.pair < 0 ? "" : model.pair_name(each.pair));
  }
  for (const ContactImpulse& each : r.contacts) {
    out.contacts.push_back(
        {model.pair_name(each.pair), each.lambda, each.p_W, each.point_W, each.n_W});
  }
  return out;
}

void bind_report(py::module_& m) {
  bind_impact(m);
  bind_contact(m);
  bind_step_report(m);
}

}  // namespace saltus::bindings
