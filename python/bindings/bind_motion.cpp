// Model floor: frames of links and shapes at many configurations.
#include "bindings.hpp"
#include "saltus/model/motion.hpp"

namespace saltus::bindings {
namespace {

constexpr auto poses_doc = R"(Poses of a link at many configurations.

Parameters
----------
q : array_like, shape (rows, n)
    [rad | m]
link : str or int
    Its name or index.

Returns
-------
numpy.ndarray, shape (rows, 4, 4)
    Homogeneous matrices.
)";

constexpr auto velocities_doc = R"(Velocities of a link at many configurations.

Parameters
----------
q : array_like, shape (rows, n)
    [rad | m]
v : array_like, shape (rows, n)
    [rad/s | m/s]
link : str or int
    Its name or index.

Returns
-------
numpy.ndarray, shape (rows, 6)
    Angular velocity [rad/s] and velocity of the link's origin [m/s], in world axes.
)";

constexpr auto shape_poses_doc = R"(As `poses`, for the frame of a shape: its name or index.)";
constexpr auto shape_velocities_doc =
    R"(As `velocities`, for the frame of a shape: its name or index.)";

AttachedFrame frame_of_link(const Model& model, const NameOrLink& link) {
  const auto item = py::reinterpret_borrow<NameOrIndex>(link);
  return link_frame(model, to_index(item, names_of(model->links), "link"));
}

AttachedFrame frame_of_shape(const Model& model, const NameOrIndex& shape) {
  return shape_frame(model, to_index(shape, names_of(model->shapes), "shape"));
}

template <auto frame, class Item>
py::array_t<double> many_poses(const Model& model, const MatX& q, const Item& item) {
  const auto rows = static_cast<py::ssize_t>(q.rows());
  const py::object flat = py::cast(poses(model, frame(model, item), q));
  return flat.attr("reshape")(rows, 4, 4);
}

template <auto frame, class Item>
MatX many_velocities(const Model& model, const MatX& q, const MatX& v, const Item& item) {
  return velocities(model, frame(model, item), q, v);
}

}  // namespace

void bind_motion(py::module_& m) {
  const py::object model = m.attr("Model");
  py::class_<Model> c(model);
  c.def("poses", &many_poses<frame_of_link, NameOrLink>, poses_doc, py::arg("q"), py::arg("link"))
      .def("velocities", &many_velocities<frame_of_link, NameOrLink>, velocities_doc, py::arg("q"),
           py::arg("v"), py::arg("link"))
      .def("shape_poses", &many_poses<frame_of_shape, NameOrIndex>, shape_poses_doc, py::arg("q"),
           py::arg("shape"))
      .def("shape_velocities", &many_velocities<frame_of_shape, NameOrIndex>, shape_velocities_doc,
           py::arg("q"), py::arg("v"), py::arg("shape"));
}

}  // namespace saltus::bindings
