// Model floor: what links look like.
#include "saltus/model/visual.hpp"

#include "bindings.hpp"
#include "pickle.hpp"

namespace saltus::bindings {
namespace {

constexpr auto mesh_doc = R"(A surface of triangles, for pictures: it touches nothing.

Its arrays are read-only.

Parameters
----------
vertices : array_like, shape (n, 3)
    [m]
faces : array_like, shape (m, 3)
    Indices of vertices, counterclockwise seen from outside.

Raises
------
ModelError
    Where a vertex is not finite, or a face names one that is not there.
)";

constexpr auto visual_doc =
    R"(What a link looks like, or a part of it. It has no part in the motion.

`model.pose(q, visual.link) * visual.X_LG` is where it is; `model.visuals` lists those of a model.
)";

using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

TriangleMesh make_mesh(const Vertices& vertices, const Faces& faces) {
  auto triangles = std::make_shared<Triangles>();
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) triangles->vertices.push_back(vertices.row(i));
  for (Eigen::Index i = 0; i < faces.rows(); ++i) {
    triangles->faces.push_back({faces(i, 0), faces(i, 1), faces(i, 2)});
  }
  TriangleMesh mesh{std::move(triangles)};
  check_visual({"mesh", mesh});
  return mesh;
}

/// Rows of three, which the mesh keeps alive: no copy.
template <class Number, class Row>
py::array rows(const std::vector<Row>& items, const py::handle& owner) {
  const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(items.size()), 3};
  const Number* data = items.empty() ? nullptr : items.front().data();
  return read_only(py::array_t<Number>(shape, data, owner));
}

py::array vertices_of(const py::object& mesh) {
  return rows<double>(mesh.cast<const TriangleMesh&>().triangles->vertices, mesh);
}

py::array faces_of(const py::object& mesh) {
  return rows<int>(mesh.cast<const TriangleMesh&>().triangles->faces, mesh);
}

void bind_mesh(py::module_& m) {
  py::class_<TriangleMesh>(m, "TriangleMesh", mesh_doc)
      .def(py::init(&make_mesh), py::arg("vertices"), py::arg("faces"))
      .def_property_readonly("vertices", &vertices_of, "[m] shape (n, 3)")
      .def_property_readonly("faces", &faces_of, "indices of vertices, shape (m, 3)")
      .def("__repr__",
           [](const TriangleMesh& mesh) {
             return "TriangleMesh(" + std::to_string(mesh.triangles->vertices.size()) +
                    " vertices, " + std::to_string(mesh.triangles->faces.size()) + " faces)";
           })
      .def(py::pickle(
          [](const py::object& mesh) { return py::make_tuple(vertices_of(mesh), faces_of(mesh)); },
          [](const py::tuple& t) { return make_mesh(t[0].cast<Vertices>(), t[1].cast<Faces>()); }));
}

}  // namespace

void bind_visuals(py::module_& m) {
  bind_mesh(m);
  py::class_<Visual>(m, "Visual", visual_doc)
      .def_readonly("link", &Visual::link, "name of its link")
      .def_readonly("name", &Visual::name, "as the file has it, \"\" where it has none")
      .def_property_readonly("kind", &visual_kind, "\"box\", \"sphere\", ..., \"mesh\"")
      .def_readonly("shape", &Visual::shape, "a TriangleMesh, or one of the classes of `Shape`")
      .def_readonly("X_LG", &Visual::X_LG, "Pose of its frame in the link's")
      .def_readonly("rgba", &Visual::rgba, "red, green, blue, opacity, each in [0, 1]")
      .def("__repr__", [](const Visual& v) {
        return "Visual('" + v.link + "', " + py::repr(py::cast(v.shape)).cast<std::string>() + ")";
      });
}

}  // namespace saltus::bindings
