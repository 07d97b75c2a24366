// URDF floor.
#include "bindings.hpp"
#include "saltus/urdf/load_urdf.hpp"

namespace saltus::bindings {

/// Anything that os.fspath takes.
struct PathLike {
  py::object value;
};

}  // namespace saltus::bindings

namespace pybind11::detail {

template <>
struct type_caster<saltus::bindings::PathLike> {
  PYBIND11_TYPE_CASTER(saltus::bindings::PathLike, const_name("str | os.PathLike[str]"));
  bool load(handle source, bool /*convert*/) {
    value.value = reinterpret_borrow<object>(source);
    return static_cast<bool>(source);
  }
};

}  // namespace pybind11::detail

namespace saltus::bindings {
namespace {

constexpr auto read_urdf_doc = R"(Reads URDF into a ModelBuilder, to add to it before `build`.

Parameters
----------
path_or_text : str or os.PathLike
    A file, or URDF text where it begins with "<".
gravity : array_like, shape (3,)
    [m/s^2]
package_dirs : sequence of str or os.PathLike
    Where `package://name/rest` is looked up: folders that hold `name`, or `name` itself.
root_joint : JointType
    How the root link hangs on the world: fixed, or by a joint named "root" below a link "world".
solver : TreeSolver
    How steps solve for velocities, see `ModelBuilder.set_solver`.

Returns
-------
ModelBuilder
    Its `warnings` name what was understood but is not used.

Raises
------
ModelError
    With file and line, `element` and `name` of the culprit.
)";

std::string to_path(const PathLike& path) {
  return py::module_::import("os").attr("fspath")(path.value).cast<std::string>();
}

ModelBuilder read_urdf(const PathLike& path_or_text, const Vec3& gravity,
                       const py::typing::Iterable<PathLike>& package_dirs,
                       const Unchecked<JointType>& root_joint,
                       const Unchecked<TreeSolver>& solver) {
  if (py::isinstance<py::str>(package_dirs)) {  // would be a sequence of letters
    throw py::type_error("package_dirs is a sequence of folders, not one text");
  }
  UrdfOptions options{gravity, {}, to_enum(root_joint, "root_joint"), to_enum(solver, "solver")};
  for (const py::handle path : package_dirs) {
    options.package_dirs.push_back(to_path({py::reinterpret_borrow<py::object>(path)}));
  }
  const std::string text = to_path(path_or_text);
  const py::gil_scoped_release release;
  return load_urdf(text, options);
}

}  // namespace

void bind_urdf(py::module_& m) {
  m.def("read_urdf", &read_urdf, read_urdf_doc, py::arg("path_or_text"), py::kw_only(),
        py::arg_v("gravity", UrdfOptions{}.gravity, "(0, 0, -9.81)"),
        py::arg_v("package_dirs", py::tuple(), "()"),
        py::arg_v("root_joint", UrdfOptions{}.root_joint, "JointType.fixed"),
        py::arg_v("solver", UrdfOptions{}.solver, "TreeSolver.automatic"));
}

}  // namespace saltus::bindings
