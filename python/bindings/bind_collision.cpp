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
a, b : Shape
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

std::string show(const Vec3& x) {
  return "(" + show(x[0]) + ", " + show(x[1]) + ", " + show(x[2]) + ")";
}

/// A size of a shape, and what it is.
template <class S, class T>
struct Field {
  T S::* at;
  const char* name;
  const char* doc;
};

/// A shape that is its sizes: made of them, shown by them, pickled as them.
template <class S, class... T>
void bind_shape(py::module_& m, const char* name, const char* doc, const Field<S, T>&... field) {
  py::class_<S> shape(m, name, doc);
  shape.def(py::init([](const T&... size) { return S{size...}; }), py::arg(field.name)...);
  (shape.def_readonly(field.name, field.at, field.doc), ...);
  shape.def("__repr__", [=]([[maybe_unused]] const S& s) {
    std::string sizes;
    ((sizes += (sizes.empty() ? "" : ", ") + show(s.*field.at)), ...);
    return std::string(name) + "(" + sizes + ")";
  });
  shape.def(py::pickle([=]([[maybe_unused]] const S& s) { return py::make_tuple(s.*field.at...); },
                       [=]([[maybe_unused]] const py::tuple& t) {
                         S s{};
                         [[maybe_unused]] std::size_t i = 0;
                         ((s.*field.at = t[i++].cast<T>()), ...);
                         return s;
                       }));
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
      .def("__repr__",
           [](const Convex& c) {
             return "Convex(" + std::to_string(c.hull->vertices.size()) + " vertices, " +
                    std::to_string(c.hull->faces.size()) + " faces)";
           })
      .def(py::pickle(
          [](const Convex& c) { return to_tuple(*c.hull); },
          [](const py::tuple& t) { return Convex{std::make_shared<const Hull>(to_hull(t))}; }));
}

void bind_shapes(py::module_& m) {
  bind_shape<Sphere, double>(m, "Sphere", "A ball about its frame's origin.",
                             {&Sphere::radius, "radius", "[m]"});
  bind_shape<Capsule, double, double>(
      m, "Capsule", "All points within `radius` of the segment |z| <= `half_length`.",
      {&Capsule::radius, "radius", "[m]"},
      {&Capsule::half_length, "half_length", "[m] of the segment, without the caps"});
  bind_shape<Box, Vec3>(m, "Box", "|x| <= half[0], |y| <= half[1], |z| <= half[2].",
                        {&Box::half, "half", "[m] half-extents, shape (3,)"});
  bind_shape<Cylinder, double, double>(m, "Cylinder", "Axis z, |z| <= `half_length`.",
                                       {&Cylinder::radius, "radius", "[m]"},
                                       {&Cylinder::half_length, "half_length", "[m]"});
  bind_shape<HalfSpace>(m, "HalfSpace",
                        "The solid z <= 0 of its frame; only the root link may carry one.");
  bind_shape<Ellipsoid, Vec3>(m, "Ellipsoid",
                              "(x/radii[0])^2 + (y/radii[1])^2 + (z/radii[2])^2 <= 1.",
                              {&Ellipsoid::radii, "radii", "[m] shape (3,)"});
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
  m.def("shape_name", &shape_name, "As in `gap_table`: \"sphere\", \"half_space\".",
        py::arg("shape"));
}

}  // namespace

void bind_collision(py::module_& m) {
  bind_shapes(m);
  bind_gap(m);
  py::class_<PlacedShape>(m, "PlacedShape", placed_shape_doc)
      .def_readonly("name", &PlacedShape::name,
                    "the link's name, \"#k\" added where a link has several")
      .def_readonly("shape", &PlacedShape::shape, "one of the classes of `Shape`")
      .def_readonly("link", &PlacedShape::link, "index of its link in the model's `links`")
      .def_readonly("X_LG", &PlacedShape::X_LG, "Pose of its frame in its link's")
      .def("__repr__", [](const PlacedShape& s) {
        return "PlacedShape('" + s.name + "', " + py::repr(py::cast(s.shape)).cast<std::string>() +
               ")";
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
