// Collision floor: shapes, and the gap between two of them.
#include "bindings.hpp"
#include "pickle.hpp"
#include "saltus/collision/contact.hpp"
#include "saltus/collision/hull.hpp"

namespace saltus::bindings {
namespace {

constexpr auto gap_class_doc = R"(The gap between two shapes a and b.

`p_WA - p_WB == phi * n_W` and `|n_W| == 1`; `n_W` points from b to a; `phi < 0` is penetration.
)";

constexpr auto convex_doc = R"(The convex hull of points, facets that are coplanar joined.

Parameters
----------
points : array_like, shape (n, 3)
    [m] 4 or more, not in a plane; those inside are dropped.

Raises
------
ModelError
    Where they are too few, not finite, or thinner than 1e-6 of their length.
)";

constexpr auto gap_doc = R"(Signed distance, normal, witness points and curvature of two shapes.

Parameters
----------
a, b : Sphere, Capsule, Box, Cylinder, HalfSpace, Ellipsoid or Convex
X_WA, X_WB : Pose
    Where they are.

Returns
-------
Gap

Raises
------
ModelError
    Where these two kinds of shape have no gap function, see `gap_table`, or a pose is not finite.
)";

constexpr auto gap_table_doc = R"(The pairs of shapes that have a gap function, by name.

Returns
-------
list of (str, str)
    Generated from the dispatch; the order within a pair does not matter.
)";

constexpr auto placed_shape_doc = R"(A shape of a model and the joint frame that carries it.)";

constexpr auto pair_doc = R"(A gap that is watched, of two shapes of a model or of parts of them.)";

std::string show(double x) { return py::repr(py::float_(x)).cast<std::string>(); }

std::string show(const Shape& shape) {
  struct Show {
    std::string operator()(const Sphere& s) const { return "Sphere(" + show(s.radius) + ")"; }
    std::string operator()(const Capsule& c) const {
      return "Capsule(" + show(c.radius) + ", " + show(c.half_length) + ")";
    }
    std::string operator()(const Box& b) const {
      return "Box((" + show(b.half[0]) + ", " + show(b.half[1]) + ", " + show(b.half[2]) + "))";
    }
    std::string operator()(const Cylinder& c) const {
      return "Cylinder(" + show(c.radius) + ", " + show(c.half_length) + ")";
    }
    std::string operator()(const HalfSpace&) const { return "HalfSpace()"; }
    std::string operator()(const Ellipsoid& e) const {
      return "Ellipsoid((" + show(e.radii[0]) + ", " + show(e.radii[1]) + ", " + show(e.radii[2]) +
             "))";
    }
    std::string operator()(const Convex& c) const {
      return "Convex(" + std::to_string(c.hull->vertices.size()) + " vertices, " +
             std::to_string(c.hull->faces.size()) + " faces)";
    }
    static std::string show(double x) { return bindings::show(x); }
  };
  return std::visit(Show{}, shape);
}

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

Convex make_convex(const Points& points) {
  const py::gil_scoped_release release;
  std::vector<Vec3> rows;
  for (Eigen::Index i = 0; i < points.rows(); ++i) rows.push_back(points.row(i));
  return {std::make_shared<const Hull>(convex_hull(rows))};
}

Points vertices_of(const Convex& convex) {
  const std::vector<Vec3>& vertices = convex.hull->vertices;
  Points rows(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = vertices[i];
  }
  return rows;
}

std::vector<std::vector<int>> faces_of(const Convex& convex) {
  std::vector<std::vector<int>> faces;
  for (const Hull::Face& face : convex.hull->faces) faces.push_back(face.corners);
  return faces;
}

std::vector<std::pair<int, int>> edges_of(const Convex& convex) {
  std::vector<std::pair<int, int>> edges;
  for (const Hull::Edge& edge : convex.hull->edges) edges.emplace_back(edge.from, edge.to);
  return edges;
}

void bind_convex(py::module_& m) {
  py::class_<Convex>(m, "Convex", convex_doc)
      .def(py::init(&make_convex), py::arg("points"))
      .def_property_readonly("vertices", &vertices_of,
                             "[m] the points that are corners of the hull, shape (n, 3)")
      .def_property_readonly("faces", &faces_of,
                             "vertices of each face, counterclockwise seen from outside")
      .def_property_readonly("edges", &edges_of, "vertices at the two ends of each edge")
      .def("__repr__", [](const Convex& c) { return show(c); })
      .def(py::pickle(
          [](const Convex& c) { return to_tuple(*c.hull); },
          [](const py::tuple& t) { return Convex{std::make_shared<const Hull>(to_hull(t))}; }));
}

void bind_shapes(py::module_& m) {
  py::class_<Sphere>(m, "Sphere", "A ball about its frame's origin.")
      .def(py::init([](double radius) { return Sphere{radius}; }), py::arg("radius"))
      .def_readonly("radius", &Sphere::radius, "[m]")
      .def("__repr__", [](const Sphere& s) { return show(s); })
      .def(pickle_fields<Sphere, &Sphere::radius>());
  py::class_<Capsule>(m, "Capsule",
                      "All points within `radius` of the segment |z| <= `half_length`.")
      .def(py::init([](double radius, double half_length) { return Capsule{radius, half_length}; }),
           py::arg("radius"), py::arg("half_length"))
      .def_readonly("radius", &Capsule::radius, "[m]")
      .def_readonly("half_length", &Capsule::half_length, "[m] of the segment, without the caps")
      .def("__repr__", [](const Capsule& c) { return show(c); })
      .def(pickle_fields<Capsule, &Capsule::radius, &Capsule::half_length>());
  py::class_<Box>(m, "Box", "|x| <= half[0], |y| <= half[1], |z| <= half[2].")
      .def(py::init([](const Vec3& half) { return Box{half}; }), py::arg("half"))
      .def_readonly("half", &Box::half, "[m] half-extents, shape (3,)")
      .def("__repr__", [](const Box& b) { return show(b); })
      .def(pickle_fields<Box, &Box::half>());
  py::class_<Cylinder>(m, "Cylinder", "Axis z, |z| <= `half_length`.")
      .def(
          py::init([](double radius, double half_length) { return Cylinder{radius, half_length}; }),
          py::arg("radius"), py::arg("half_length"))
      .def_readonly("radius", &Cylinder::radius, "[m]")
      .def_readonly("half_length", &Cylinder::half_length, "[m]")
      .def("__repr__", [](const Cylinder& c) { return show(c); })
      .def(pickle_fields<Cylinder, &Cylinder::radius, &Cylinder::half_length>());
  py::class_<HalfSpace>(m, "HalfSpace",
                        "The solid z <= 0 of its frame; only the root link may carry one.")
      .def(py::init<>())
      .def("__repr__", [](const HalfSpace& h) { return show(h); })
      .def(pickle_fields<HalfSpace>());
  py::class_<Ellipsoid>(m, "Ellipsoid", "(x/radii[0])^2 + (y/radii[1])^2 + (z/radii[2])^2 <= 1.")
      .def(py::init([](const Vec3& radii) { return Ellipsoid{radii}; }), py::arg("radii"))
      .def_readonly("radii", &Ellipsoid::radii, "[m] shape (3,)")
      .def("__repr__", [](const Ellipsoid& e) { return show(e); })
      .def(pickle_fields<Ellipsoid, &Ellipsoid::radii>());
  bind_convex(m);
}

Gap checked_gap(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  if (!has_gap(a, b)) {
    throw ModelError("no gap function between a " + shape_name(a) + " and a " + shape_name(b) +
                     "; gap_table() lists those there are");
  }
  for (const Pose* X : {&X_WA, &X_WB}) {
    if (X->R.allFinite() && X->p.allFinite()) continue;
    throw ModelError(std::string("pose ") + (X == &X_WA ? "X_WA" : "X_WB") + " is not finite");
  }
  return gap(a, X_WA, b, X_WB);
}

void bind_gap(py::module_& m) {
  py::class_<Gap>(m, "Gap", gap_class_doc)
      .def_readonly("phi", &Gap::phi, "[m] signed distance")
      .def_readonly("n_W", &Gap::n_W, "unit normal from b to a, shape (3,)")
      .def_readonly("p_WA", &Gap::p_WA, "[m] witness on a's surface, shape (3,)")
      .def_readonly("p_WB", &Gap::p_WB, "[m] witness on b's surface, shape (3,)")
      .def_property_readonly(
          "F_W", &F_W, "[1/m] second partials of phi for translations of a against b, shape (3, 3)")
      .def("__repr__", [](const Gap& g) { return "Gap(phi=" + show(g.phi) + ")"; });
  m.def("gap", &checked_gap, gap_doc, py::arg("a"), py::arg("X_WA"), py::arg("b"), py::arg("X_WB"));
  m.def("has_gap", &has_gap, "True where `gap` knows the two kinds of shape, in either order.",
        py::arg("a"), py::arg("b"));
  m.def("gap_table", &gap_table, gap_table_doc);
  m.def("shape_name", &shape_name,
        "\"sphere\", \"capsule\", \"box\", \"cylinder\", \"half_space\", \"ellipsoid\" or "
        "\"convex\".",
        py::arg("shape"));
}

}  // namespace

void bind_collision(py::module_& m) {
  bind_shapes(m);
  bind_gap(m);
  py::class_<PlacedShape>(m, "PlacedShape", placed_shape_doc)
      .def_readonly("name", &PlacedShape::name,
                    "the link's name, \"#k\" added where a link has several")
      .def_readonly("shape", &PlacedShape::shape,
                    "Sphere, Capsule, Box, Cylinder, HalfSpace, Ellipsoid or Convex")
      .def_readonly("link", &PlacedShape::link, "index of its link in the model's `links`")
      .def("__repr__", [](const PlacedShape& s) {
        return "PlacedShape('" + s.name + "', " + show(s.shape) + ")";
      });
  py::class_<Pair>(m, "Pair", pair_doc)
      .def_readonly("a", &Pair::a, "index in the model's `shapes`")
      .def_readonly("b", &Pair::b, "index in the model's `shapes`")
      .def_readonly("part", &Pair::part, "which of the gaps of these two shapes")
      .def_readonly("touch", &Pair::touch, "[m] below this |phi| the shapes touch")
      .def("__repr__", [](const Pair& p) {
        const std::string part = p.part == 0 ? "" : ", part=" + std::to_string(p.part);
        return "Pair(" + std::to_string(p.a) + ", " + std::to_string(p.b) + part + ")";
      });
}

}  // namespace saltus::bindings
