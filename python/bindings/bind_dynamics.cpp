// Model floor: Jacobians, momenta and dynamics, of one configuration or of many.
#include "bindings.hpp"
#include "dynamics_docs.hpp"
#include "saltus/model/dynamics.hpp"
#include "words.hpp"

namespace saltus::bindings {
namespace {

/// What a user gives for a point, or for one a row: three numbers, or nothing.
struct Points {
  static constexpr auto type_name = py::detail::const_name("numpy.typing.ArrayLike | None");
  py::object value;
};

using Shape = std::vector<py::ssize_t>;

/// What a user gives for one configuration or for many.
struct Rows {
  MatX x;
  bool many;
};

/// Two dimensions or more; names, None and what is no array have none.
std::optional<MatX> rows_of(const py::object& x, const char* what, int n) {
  if (x.is_none() || py::hasattr(x, "items")) return {};
  const auto any = py::array::ensure(x);
  if (!any || any.ndim() < 2) return {};
  const auto kind = any.dtype().kind();
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(x);
  if (!array || any.ndim() > 2 || kind == 'b' || kind == 'U' || kind == 'S') {
    throw ModelError(std::string(what) + " has shape " +
                     py::repr(any.attr("shape")).cast<std::string>() + " of " +
                     py::repr(any.dtype()).cast<std::string>() + "; it is numbers of shape (" +
                     std::to_string(n) + ",) or (rows, " + std::to_string(n) + ")");
  }
  return array.cast<MatX>();
}

template <class Argument>  // Coordinates or Velocities
Rows to_rows(const Argument& x, const Model& model, int n, const char* what) {
  if (auto rows = rows_of(x.value, what, n)) return {*std::move(rows), true};
  return {to_vector(x, model, what).transpose(), false};
}
Rows q_of(const Coordinates& q, const Model& model) { return to_rows(q, model, model.n_q(), "q"); }
Rows v_of(const Velocities& v, const Model& model, const char* what = "v") {
  return to_rows(v, model, model.n_v(), what);
}

/// The rows as NumPy has them, each of this shape; without the first dimension where there is one
/// configuration.
py::array_t<double> reshaped(MatX&& rows, bool many, Shape shape) {
  if (many) shape.insert(shape.begin(), static_cast<py::ssize_t>(rows.rows()));
  return py::cast(std::move(rows)).attr("reshape")(shape);
}

/// Runs what needs no interpreter without its lock.
template <class F>
MatX unlocked(const F& f) {
  const py::gil_scoped_release release;
  return f();
}

int link_of(const Model& model, const NameOrLink& link) {
  if (py::isinstance<py::str>(link)) {  // the lists of names below are slow
    const auto name = py::cast<std::string>(link);
    for (const Link& each : model->links) {
      if (each.name == name) return each.index;
    }
  }
  return to_index(py::reinterpret_borrow<NameOrIndex>(link), names_of(model->links), "link");
}

std::optional<Vec3> point_of(const Points& given) {
  const py::object& point = given.value;
  if (point.is_none()) return {};
  const auto x = py::array_t<double, py::array::forcecast>::ensure(point);
  if (x && x.ndim() == 1 && x.size() == 3) {
    const Vec3 out(x.at(0), x.at(1), x.at(2));
    if (out.allFinite()) return out;
  }
  throw ModelError("point = " + py::repr(point).cast<std::string>() +
                   "; it has three finite numbers [m]");
}

Rows about_of(const Points& given) {
  const py::object& about = given.value;
  if (about.is_none()) return {MatX::Zero(1, 3), false};
  if (auto rows = rows_of(about, "about", 3)) return {*std::move(rows), true};
  const auto x = py::array_t<double, py::array::forcecast>::ensure(about);
  if (!x || x.ndim() != 1) {
    throw ModelError("about = " + py::repr(about).cast<std::string>() +
                     "; it is a point [m] in the world, of shape (3,) or (rows, 3)");
  }
  return {x.cast<VecX>().transpose(), false};
}

py::array_t<double> jacobian(const Model& model, const Coordinates& q, const NameOrLink& link,
                             const Points& point) {
  const Rows at = q_of(q, model);
  const auto p = point_of(point);
  const int index = link_of(model, link);
  return reshaped(unlocked([&] { return jacobians(model, at.x, index, p); }), at.many,
                  {p ? 3 : 6, model.n_v()});
}

/// A function of q alone, with `width` numbers a row.
template <auto f>
py::array_t<double> of_q(const Model& model, const Coordinates& q, py::ssize_t width) {
  const Rows at = q_of(q, model);
  return reshaped(unlocked([&] { return f(model, at.x); }), at.many, {width});
}

/// A function of q, v and another, which is like v.
template <auto f>
py::array_t<double> of_motion(const Model& model, const Coordinates& q, const Velocities& v,
                              const Velocities& other, const char* name, double t) {
  const Rows at = q_of(q, model), rate = v_of(v, model), third = v_of(other, model, name);
  return reshaped(unlocked([&] { return f(model, at.x, rate.x, third.x, t); }),
                  at.many || rate.many || third.many, {model.n_v()});
}

py::array_t<double> momentum(const Model& model, const Coordinates& q, const Velocities& v,
                             const Points& about) {
  const Rows at = q_of(q, model), rate = v_of(v, model), point = about_of(about);
  return reshaped(unlocked([&] { return momenta(model, at.x, rate.x, point.x); }),
                  at.many || rate.many || point.many, {6});
}

template <auto f>
py::array_t<double> poses_of(const Model& model, const Coordinates& q, std::size_t count) {
  const Rows at = q_of(q, model);
  return reshaped(unlocked([&] { return f(model, at.x); }), at.many,
                  {static_cast<py::ssize_t>(count), 4, 4});
}

void bind_rows(py::class_<Model>& c) {
  c.def("jacobian", &jacobian, docs::model_jacobian, py::arg("q"), py::arg("link"),
        py::arg("point") = py::none())
      .def(
          "accelerations",
          [](const Model& m, const Coordinates& q, const Velocities& v, const Velocities& forces,
             double t) { return of_motion<&saltus::accelerations>(m, q, v, forces, "forces", t); },
          docs::model_accelerations, py::arg("q"), py::arg("v") = py::none(),
          py::arg("forces") = py::none(), py::kw_only(), py::arg("t") = 0.0)
      .def(
          "inverse_dynamics",
          [](const Model& m, const Coordinates& q, const Velocities& v, const Velocities& a,
             double t) { return of_motion<&saltus::inverse_dynamics>(m, q, v, a, "a", t); },
          docs::model_inverse_dynamics, py::arg("q"), py::arg("v") = py::none(),
          py::arg("a") = py::none(), py::kw_only(), py::arg("t") = 0.0)
      .def(
          "gravity_forces",
          [](const Model& m, const Coordinates& q) {
            return of_q<&saltus::gravity_forces>(m, q, m.n_v());
          },
          docs::model_gravity_forces, py::arg("q"))
      .def(
          "centre_of_mass",
          [](const Model& m, const Coordinates& q) { return of_q<&centres_of_mass>(m, q, 3); },
          docs::model_centre_of_mass, py::arg("q"))
      .def("momentum", &momentum, docs::model_momentum, py::arg("q"), py::arg("v"), py::kw_only(),
           py::arg("about") = py::none())
      .def(
          "all_poses",
          [](const Model& m, const Coordinates& q) {
            return poses_of<&all_poses>(m, q, m->links.size());
          },
          docs::model_all_poses, py::arg("q"))
      .def(
          "all_shape_poses",
          [](const Model& m, const Coordinates& q) {
            return poses_of<&all_shape_poses>(m, q, m->shapes.size());
          },
          docs::model_all_shape_poses, py::arg("q"))
      .def(
          "at", [](const Model& m, const Coordinates& q) { return Frames(m, to_vector(q, m)); },
          docs::model_at, py::arg("q") = py::none());
}

MatX frames_jacobian(const Frames& f, const NameOrLink& link, const Points& point) {
  const auto p = point_of(point);
  const int index = link_of(f.model(), link);
  return p ? f.jacobian(index, *p) : f.jacobian(index);
}

Vec6 frames_momentum(Frames& f, const Velocities& v, const Points& about) {
  const auto p = point_of(about);
  Vec6 out = f.momentum(to_vector(v, f.model()));
  if (p) out.head<3>() -= p->cross(Vec3(linear(out)));
  return out;
}

void bind_frames_dynamics(py::class_<Frames>& c) {
  c.def(
       "gravity_forces",
       [](Frames& f) {
         VecX out;
         f.gravity_forces(out);
         return out;
       },
       "What gravity does to the coordinates [N m | N], shape (n_v,); see `Model`.")
      .def(
          "inverse_dynamics",
          [](Frames& f, const Velocities& v, const Velocities& a, double t) {
            VecX out;
            f.inverse_dynamics(to_vector(v, f.model()), to_vector(a, f.model(), "a"), out, t);
            return out;
          },
          docs::frames_inverse_dynamics, py::arg("v") = py::none(), py::arg("a") = py::none(),
          py::kw_only(), py::arg("t") = 0.0)
      .def(
          "accelerations",
          [](Frames& f, const Velocities& v, const Velocities& forces, double t) {
            VecX out;
            f.accelerations(to_vector(v, f.model()), to_vector(forces, f.model(), "forces"), out,
                            t);
            return out;
          },
          docs::frames_accelerations, py::arg("v") = py::none(), py::arg("forces") = py::none(),
          py::kw_only(), py::arg("t") = 0.0);
}

py::array_t<double> reshape_poses(MatX&& rows) { return reshaped(std::move(rows), true, {4, 4}); }

void bind_frames(py::module_& m) {
  py::class_<Frames> c(m, "Frames", docs::frames);
  c.def(
       "set",
       [](Frames& f, const Coordinates& q) -> Frames& {
         f.set(to_vector(q, f.model()));
         return f;
       },
       docs::frames_set, py::arg("q"))
      .def_property_readonly("model", &Frames::model)
      .def_property_readonly(
          "q", [](const Frames& f) { return f.q(); }, "[rad | m] shape (n_q,)")
      .def(
          "pose",
          [](const Frames& f, const NameOrLink& link) { return f.pose(link_of(f.model(), link)); },
          docs::frames_pose, py::arg("link"))
      .def(
          "shape_pose",
          [](const Frames& f, const NameOrIndex& shape) {
            return f.shape_pose(to_index(shape, names_of(f.model()->shapes), "shape"));
          },
          docs::frames_shape_pose, py::arg("shape"))
      .def(
          "all_poses", [](const Frames& f) { return reshape_poses(f.all_poses()); },
          "Homogeneous matrices of all links, shape (links, 4, 4).")
      .def(
          "all_shape_poses", [](const Frames& f) { return reshape_poses(f.all_shape_poses()); },
          "Homogeneous matrices of all shapes, shape (shapes, 4, 4).")
      .def("jacobian", &frames_jacobian, docs::frames_jacobian, py::arg("link"),
           py::arg("point") = py::none())
      .def("gaps", &Frames::gaps, "Gaps of all pairs, as `Model.gaps`.")
      .def("mass_matrix", &Frames::mass_matrix, "M(q), shape (n_v, n_v).")
      .def_property_readonly("mass", &Frames::mass, "[kg] of all that moves")
      .def("centre_of_mass", &Frames::centre_of_mass,
           "[m] of all that moves, in the world, shape (3,).")
      .def("momentum", &frames_momentum, docs::frames_momentum, py::arg("v"), py::kw_only(),
           py::arg("about") = py::none())
      .def("__repr__", [](const Frames& f) {
        return without_tails("Frames('" + f.model()->name + "', q=" +
                             py::str(py::cast(f.q()).attr("tolist")()).cast<std::string>() + ")");
      });
  bind_frames_dynamics(c);
}

}  // namespace

void bind_dynamics(py::module_& m) {
  bind_frames(m);
  py::class_<Model> c(py::object(m.attr("Model")));
  bind_rows(c);
}

}  // namespace saltus::bindings
