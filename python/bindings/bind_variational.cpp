// Variational floor: impact laws, orders and options.
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

fastest: the most negative u / sqrt(G), ties go to the lowest index. index: the lowest index.
symmetric: all of them together, reflected in the face of their cone that is nearest; keeps mirror
symmetry (D. Kaufman et al., "Reflections on Simultaneous Impact", SIGGRAPH 2012).
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
      .value("symmetric", ImpactOrder::symmetric)
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
  bind_enums(m);
  bind_step_options(m);
}

}  // namespace saltus::bindings
