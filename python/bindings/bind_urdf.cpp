// URDF floor.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "saltus/urdf/load_urdf.hpp"

namespace saltus::bindings {
namespace {

/// Anything that os.fspath takes.
struct PathLike {
  static constexpr auto type_name = py::detail::const_name("str | os.PathLike[str]");
  py::object value;
};

constexpr auto mesh_use_doc =
    R"(What becomes of collision meshes: convex solids around them, or nothing.)";

constexpr auto inertia_use_doc = R"(Where the inertias of a file's links come from.

checked: from the file; moments that no body can have are refused, unless a change of 2 % of the
greatest makes them possible, which is a warning. as_given: from the file, whatever they are.
from_shapes: so, too, and links without a mass get that of their collision shapes, or where there are
none of their visuals, filled with water (1000 kg/m^3); a mesh is filled to its convex hull.
)";

constexpr auto read_urdf_doc = R"(Reads URDF into a ModelBuilder, to add to it before `build`.

Parameters
----------
path_or_text : str or os.PathLike
    A file, or URDF text where it begins with "<".
gravity : array_like, shape (3,)
    [m/s^2]
package_dirs : sequence of str or os.PathLike
    Where `package://name/rest` is looked up: folders that hold `name`, or `name` itself.
root_joint : JointType or str
    How the root link hangs on the world: fixed, or by a joint named "root" below a link "world".
solver : TreeSolver or str
    How steps solve for velocities, see `ModelBuilder.set_solver`.
meshes : MeshUse or str
    What becomes of collision meshes, where the file does not say it.
srdf : str or os.PathLike, optional
    SRDF, a file or text: which links never collide, and states by name.
contact : ContactProperties, optional
    The default contact, in place of the file's own.
floor : bool
    Adds the half-space z <= 0, as `ModelBuilder.add_floor` does, unless the file has it.
effects : JointEffects or str
    What of the joints acts: limits, damping, dry friction, motors.
visuals : bool
    Reads what links look like, `Model.visuals`.
inertia : InertiaUse or str
    Where the inertias of links come from.
strict : bool
    Refuses what is wrong and else read with a warning.

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
                       const Choice<JointType>& root_joint, const Choice<TreeSolver>& solver,
                       const Choice<MeshUse>& meshes, const std::optional<PathLike>& srdf,
                       const std::optional<ContactProperties>& contact, bool floor,
                       const Choice<JointEffects>& effects, bool visuals,
                       const Choice<InertiaUse>& inertia, bool strict) {
  if (py::isinstance<py::str>(package_dirs)) {  // would be a sequence of letters
    throw py::type_error("package_dirs is a sequence of folders, not one text");
  }
  UrdfOptions options{gravity,
                      {},
                      to_enum(root_joint, "root_joint"),
                      to_enum(solver, "solver"),
                      to_enum(meshes, "meshes"),
                      {},
                      to_enum(effects, "effects"),
                      contact,
                      floor,
                      visuals,
                      to_enum(inertia, "inertia"),
                      strict};
  if (srdf && !srdf->value.is_none()) options.srdf = to_path(*srdf);
  for (const py::handle path : package_dirs) {
    options.package_dirs.push_back(to_path({py::reinterpret_borrow<py::object>(path)}));
  }
  const std::string text = to_path(path_or_text);
  const py::gil_scoped_release release;
  return saltus::read_urdf(text, options);
}

}  // namespace

void bind_urdf(py::module_& m) {
  py::native_enum<MeshUse>(m, "MeshUse", "enum.Enum", mesh_use_doc)
      .value("hull", MeshUse::hull)
      .value("none", MeshUse::none)
      .finalize();
  py::native_enum<InertiaUse>(m, "InertiaUse", "enum.Enum", inertia_use_doc)
      .value("checked", InertiaUse::checked)
      .value("as_given", InertiaUse::as_given)
      .value("from_shapes", InertiaUse::from_shapes)
      .finalize();
  m.def("read_urdf", &read_urdf, read_urdf_doc, py::arg("path_or_text"), py::kw_only(),
        py::arg_v("gravity", UrdfOptions{}.gravity, "(0, 0, -9.81)"),
        py::arg_v("package_dirs", py::tuple(), "()"),
        py::arg_v("root_joint", UrdfOptions{}.root_joint, "JointType.fixed"),
        py::arg_v("solver", UrdfOptions{}.solver, "TreeSolver.automatic"),
        py::arg_v("meshes", UrdfOptions{}.meshes, "MeshUse.hull"),
        py::arg_v("srdf", py::none(), "None"), py::arg_v("contact", py::none(), "None"),
        py::arg("floor").noconvert() = UrdfOptions{}.floor,
        py::arg_v("effects", UrdfOptions{}.effects, "JointEffects.all"),
        py::arg("visuals").noconvert() = UrdfOptions{}.visuals,
        py::arg_v("inertia", UrdfOptions{}.inertia, "InertiaUse.checked"),
        py::arg("strict").noconvert() = UrdfOptions{}.strict);
}

}  // namespace saltus::bindings
