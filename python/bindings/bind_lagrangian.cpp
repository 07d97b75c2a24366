// Lagrangian floor: body inertias, the Lagrangian and its partials.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "pickle.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/model/model_builder.hpp"

namespace saltus::bindings {
namespace {

constexpr auto inertia_doc = R"(Mass of a rigid body, in the frame of its link (or joint) J.

`a + b` is the two bodies welded together.

Parameters
----------
mass : float
    [kg]
c_J : array_like, shape (3,)
    [m] centre of mass.
I_J : array_like, shape (3, 3)
    [kg m^2] about the centre of mass, axes of J.
)";

constexpr auto partials_doc = R"(L = T - V at one (q, v), and all its first and second partials.

Read-only views, no copies. Rows of `L_vq` are velocities: `L_vq[i, j]` is the derivative by `v[i]`
and `q[j]`. Johnson and Murphey, "Discrete and continuous mechanics for tree representations of
mechanical systems", ICRA 2008, with composite quantities in place of sums over bodies.
)";

constexpr auto tree_solver_doc = R"(How steps solve for velocities on each tree of a model.

A matter of speed: answers differ by rounding. Leave it to `automatic`, unless timing both says
otherwise for a tree near the border, or to check answers by another way to them.

automatic
    lu for shallow trees, sweep for deep ones, such as chains of more than some 15 joints (20 where
    several are equal); `Model.solvers` tells what became of it.
lu
    Elimination from the leaves, without fill: O(sum of depth^2). Equal trees are solved side by
    side, in lanes of vector instructions.
sweep
    A recursion like that of articulated bodies, one tree after the other: O(n).
)";

constexpr auto solid_sphere_doc = R"(Inertia of a homogeneous ball about its centre.

Parameters
----------
mass : float
    [kg]
radius : float
    [m]

Returns
-------
BodyInertia

Raises
------
ModelError
    Where the mass or a size is not finite and positive.
)";

constexpr auto solid_box_doc = R"(Inertia of a homogeneous box about its centre.

Parameters
----------
mass : float
    [kg]
half : array_like, shape (3,)
    [m] half-extents, as of `Box`.

Returns
-------
BodyInertia

Raises
------
ModelError
    Where the mass or a size is not finite and positive.
)";

constexpr auto solid_cylinder_doc = R"(Inertia of a homogeneous cylinder along z about its centre.

Parameters
----------
mass : float
    [kg]
radius, half_length : float
    [m] as of `Cylinder`.

Returns
-------
BodyInertia

Raises
------
ModelError
    Where the mass or a size is not finite and positive.
)";

std::string show(const BodyInertia& body) {
  const py::object c = py::cast(body.c_J), I = py::cast(body.I_J);
  return "BodyInertia(mass=" + py::repr(py::float_(body.mass)).cast<std::string>() +
         ", c_J=" + py::str(c.attr("tolist")()).cast<std::string>() +
         ", I_J=" + py::str(I.attr("tolist")()).cast<std::string>() + ")";
}

void bind_inertia(py::module_& m) {
  py::class_<BodyInertia>(m, "BodyInertia", inertia_doc)
      .def(py::init([](double mass, const Vec3& c_J, const Mat3& I_J) {
             return BodyInertia{mass, c_J, I_J};
           }),
           py::arg("mass") = 0.0, py::arg_v("c_J", Vec3(Vec3::Zero()), "(0, 0, 0)"),
           py::arg_v("I_J", Mat3(Mat3::Zero()), "((0, 0, 0), (0, 0, 0), (0, 0, 0))"))
      .def_readonly("mass", &BodyInertia::mass, "[kg]")
      .def_readonly("c_J", &BodyInertia::c_J, "[m] centre of mass, shape (3,)")
      .def_readonly("I_J", &BodyInertia::I_J, "[kg m^2] about the centre of mass, shape (3, 3)")
      .def(
          "seen_from",
          [](const BodyInertia& body, const Pose& X_PB) { return transform(X_PB, body); },
          py::arg("X_PB"), "The same body in frame P, where this one is given in frame B.")
      .def("__add__", &weld, py::arg("other"), py::is_operator())
      .def("__repr__", &show)
      .def(pickle_fields<BodyInertia, &BodyInertia::mass, &BodyInertia::c_J, &BodyInertia::I_J>());
  m.def("solid_box", &solid_box, solid_box_doc, py::arg("mass"), py::arg("half"));
  m.def("solid_cylinder", &solid_cylinder, solid_cylinder_doc, py::arg("mass"), py::arg("radius"),
        py::arg("half_length"));
  m.def("solid_sphere", &solid_sphere, solid_sphere_doc, py::arg("mass"), py::arg("radius"));
}

}  // namespace

void bind_lagrangian(py::module_& m) {
  bind_inertia(m);
  py::native_enum<TreeSolver>(m, "TreeSolver", "enum.Enum", tree_solver_doc)
      .value("automatic", TreeSolver::automatic)
      .value("lu", TreeSolver::lu)
      .value("sweep", TreeSolver::sweep)
      .finalize();
  using L = LagrangianPartials;
  py::class_<L>(m, "LagrangianPartials", partials_doc)
      .def_readonly("value", &L::value, "[J] L = T - V")
      .def_readonly("L_q", &L::L_q, "[J/rad | N], shape (n,)")
      .def_readonly("L_v", &L::L_v, "[J s/rad | N s] the momenta p, shape (n,)")
      .def_readonly("L_qq", &L::L_qq, "shape (n, n)")
      .def_readonly("L_vq", &L::L_vq, "shape (n, n); row = velocity, column = coordinate")
      .def_readonly("L_vv", &L::L_vv, "the mass matrix, shape (n, n)")
      .def("__repr__", [](const L& self) {
        return "LagrangianPartials(value=" + py::repr(py::float_(self.value)).cast<std::string>() +
               ", n=" + std::to_string(self.L_q.size()) + ")";
      });
}

}  // namespace saltus::bindings
