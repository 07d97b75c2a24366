// Spatial floor: poses.
#include <cmath>
#include <sstream>

#include "bindings.hpp"
#include "saltus/error.hpp"
#include "saltus/spatial/rotation.hpp"

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

constexpr auto from_quaternion_doc = R"(A pose from a quaternion x y z w.

Parameters
----------
quaternion : array_like, shape (4,)
    x y z w, of any length but 0.
p : array_like, shape (3,)
    [m] B's origin in A.

Raises
------
ModelError
    On a quaternion that is not finite or has no length.
)";

constexpr auto from_rpy_doc =
    R"(A pose from fixed-axis roll, pitch and yaw [rad] and a position [m], as in URDF.)";

constexpr auto rpy_of_doc = R"(Roll, pitch, yaw [rad] of the rotation, shape (3,).

Pitch is in [-pi/2, pi/2]. Where it is at one of the ends only yaw - roll or yaw + roll is told, and
roll is 0.
)";

Pose from_quaternion(const Eigen::Vector4d& x, const Vec3& p) {
  const double length = x.stableNorm();
  if (!(length > 0 && std::isfinite(length))) {
    std::ostringstream text;
    text << "quaternion (" << x.transpose() << "); it is finite and not 0 (x y z w)";
    throw ModelError(text.str());
  }
  return {Quaternion(x[3] / length, x[0] / length, x[1] / length, x[2] / length).toRotationMatrix(),
          p};
}

/// With w >= 0.
Eigen::Vector4d quaternion_of(const Pose& X) {
  const Quaternion q = Quaternion(X.R).normalized();
  return q.w() < 0 ? Eigen::Vector4d(-q.coeffs()) : Eigen::Vector4d(q.coeffs());
}

Vec3 rpy_of(const Pose& X) {
  const Mat3& R = X.R;
  const double cosine = std::hypot(R(0, 0), R(1, 0)), pitch = std::atan2(-R(2, 0), cosine);
  // 1e-12: beside the pole roll and yaw are rounding, their sum is not
  if (cosine < 1e-12) return {0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

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
      .def_static("from_quaternion", &from_quaternion, from_quaternion_doc, py::arg("quaternion"),
                  py::arg_v("p", Vec3(Vec3::Zero()), "(0, 0, 0)"))
      .def_static(
          "from_rpy",
          [](double roll, double pitch, double yaw, const Vec3& p) {
            return Pose{rotation_from_rpy(roll, pitch, yaw), p};
          },
          from_rpy_doc, py::arg("roll"), py::arg("pitch"), py::arg("yaw"),
          py::arg_v("p", Vec3(Vec3::Zero()), "(0, 0, 0)"))
      .def_property_readonly("quaternion", &quaternion_of,
                             "the rotation as unit quaternion x y z w with w >= 0, shape (4,)")
      .def_property_readonly("rpy", &rpy_of, rpy_of_doc)
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
