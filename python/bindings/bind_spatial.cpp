// Spatial floor: poses.
#include "bindings.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus::bindings {
namespace {

constexpr auto pose_doc = R"(A rigid placement of a frame B in a frame A.

`X_AB * p_B` is the point `p_B` seen from A, `X_AB * X_BC` the placement of C in A.

Parameters
----------
p : array_like, shape (3,)
    [m] B's origin in A.
R : array_like, shape (3, 3)
    Rotation; its columns are B's axes in A.
)";

constexpr auto rpy_doc =
    R"(Rotation by fixed-axis roll, pitch and yaw, as in URDF: `Rz(yaw) Ry(pitch) Rx(roll)`.

Parameters
----------
roll, pitch, yaw : float
    [rad]

Returns
-------
numpy.ndarray, shape (3, 3)
)";

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Matrix4 to_matrix(const Pose& X) {
  Matrix4 T = Matrix4::Identity();
  T.topLeftCorner<3, 3>() = X.R;
  T.topRightCorner<3, 1>() = X.p;
  return T;
}

std::string show(const Pose& X) {
  const py::object array = py::cast(X.p);
  return "Pose(p=" + py::str(array.attr("tolist")()).cast<std::string>() +
         ", R=" + py::str(py::cast(X.R).attr("tolist")()).cast<std::string>() + ")";
}

}  // namespace

void bind_spatial(py::module_& m) {
  py::class_<Pose>(m, "Pose", pose_doc)
      .def(py::init([](const Vec3& p, const Mat3& R) { return Pose{R, p}; }),
           py::arg_v("p", Vec3(Vec3::Zero()), "(0, 0, 0)"),
           py::arg_v("R", Mat3(Mat3::Identity()), "((1, 0, 0), (0, 1, 0), (0, 0, 1))"))
      .def_readonly("p", &Pose::p, "[m] origin, shape (3,)")
      .def_readonly("R", &Pose::R, "rotation, shape (3, 3)")
      .def("inverse", &Pose::inverse, "The placement of A in B.")
      .def("matrix", &to_matrix, "The homogeneous matrix, shape (4, 4).")
      .def(
          "__mul__", [](const Pose& a, const Pose& b) { return a * b; }, py::arg("X_BC"),
          py::is_operator())
      .def(
          "__mul__", [](const Pose& a, const Vec3& p) { return Vec3(a * p); }, py::arg("p_B"),
          py::is_operator())
      .def("__repr__", &show)
      .def(py::pickle(
          [](const Pose& X) -> py::tuple { return py::make_tuple(X.p, X.R); },
          [](const py::tuple& t) { return Pose{t[1].cast<Mat3>(), t[0].cast<Vec3>()}; }));
  m.def("rotation_from_rpy", &rotation_from_rpy, rpy_doc, py::arg("roll"), py::arg("pitch"),
        py::arg("yaw"));
}

}  // namespace saltus::bindings
