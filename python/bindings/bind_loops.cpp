// Model floor: loops and couplings.
#include <pybind11/native_enum.h>

#include <cmath>

#include "bindings.hpp"
#include "control.hpp"
#include "functions.hpp"
#include "loop_docs.hpp"
#include "pickle.hpp"
#include "saltus/model/close_loops.hpp"
#include "saltus/model/equilibrium.hpp"
#include "saltus/model/model_builder.hpp"

namespace saltus::bindings {
namespace {

constexpr auto self = py::return_value_policy::reference_internal;
using B = ModelBuilder;

std::vector<int> velocities_of(const Model& model, const std::vector<std::string>& keep) {
  std::vector<int> out;
  for (const std::string& name : keep) {
    bool is_joint = false;
    for (const JointInfo& joint : model->joints) {
      if (joint.name != name) continue;
      out.insert(out.end(), joint.velocities.begin(), joint.velocities.end());
      is_joint = true;
    }
    if (!is_joint) out.push_back(model.velocity_index(name));
  }
  return out;
}

State closed_state(const Model& model, const Coordinates& q, const Velocities& v,
                   const std::vector<std::string>& keep, double t) {
  const std::vector<int> kept = velocities_of(model, keep);
  const VecX closed = close_loops(model, to_vector(q, model), kept, t);
  return model.state(closed, consistent_velocity(model, closed, to_vector(v, model), kept, t), t);
}

std::map<std::string, VecX> gaps_of(const Model& model, const Coordinates& q, double t) {
  if (!std::isfinite(t)) throw ModelError("t is not finite");
  return by_loop(model, loop_gaps(model, to_vector(q, model), t));
}

}  // namespace

At to_at(const AtOrLink& where) {
  const At* at = std::get_if<At>(&where);
  return at != nullptr ? *at : At{std::get<std::string>(where)};
}

std::map<std::string, VecX> by_loop(const Model& model, const VecX& rows) {
  std::map<std::string, VecX> out;
  for (const Equality& each : model->equalities.all) {
    out[each.name] = rows.segment(each.first, rows_of(each.type));
  }
  return out;
}

void bind_loop_types(py::module_& m) {
  py::native_enum<LoopType>(m, "LoopType", "enum.Enum", docs::loop_type)
      .value("point", LoopType::point)
      .value("weld", LoopType::weld)
      .value("distance", LoopType::distance)
      .value("on_plane", LoopType::on_plane)
      .value("coupling", LoopType::coupling)
      .value("prescribed", LoopType::prescribed)
      .finalize();
  py::class_<At>(m, "At", docs::at)
      .def(py::init([](const std::string& link, const Vec3& p, const std::optional<Mat3>& R) {
             return At{link, Pose{R.value_or(Mat3::Identity()), p}};
           }),
           py::arg("link"), py::arg_v("p", Vec3(Vec3::Zero()), "(0, 0, 0)"),
           py::arg("R") = py::none())
      .def_readonly("link", &At::link)
      .def_property_readonly(
          "p", [](const At& at) { return at.X_LA.p; }, "[m]")
      .def_property_readonly("R", [](const At& at) { return at.X_LA.R; })
      .def("__repr__",
           [](const At& at) {
             return "At('" + at.link + "', " +
                    py::str(py::tuple(py::cast(at.X_LA.p).attr("tolist")())).cast<std::string>() +
                    ")";
           })
      .def(pickle_fields<At, &At::link, &At::X_LA>());
}

void bind_add_loops(py::class_<B>& c) {
  c.def(
       "add_loop",
       [](B& builder, const std::string& name, const Choice<LoopType>& type, const AtOrLink& a,
          const AtOrLink& b, double distance) -> B& {
         return builder.add_loop(name, to_enum(type, "type"), to_at(a), to_at(b), distance);
       },
       self, docs::add_loop, py::arg("name"), py::arg("type"), py::kw_only(), py::arg("a"),
       py::arg("b"), py::arg("distance") = 0.0)
      .def("add_coupling", &B::add_coupling, self, docs::add_coupling, py::arg("joint"),
           py::kw_only(), py::arg("of"), py::arg("polynomial"))
      .def(
          "set_prescribed",
          [](B& builder, const std::string& joint, const std::optional<std::vector<double>>& times,
             const std::optional<std::vector<double>>& values,
             const std::optional<py::typing::Callable<py::object(double)>>& function) -> B& {
            if (function.has_value() == (times.has_value() || values.has_value())) {
              throw ModelError(
                  "set_prescribed of joint \"" + joint + "\" takes times and values, or a function",
                  "joint", joint);
            }
            if (function) return builder.set_prescribed(joint, to_motion(joint, *function));
            return builder.set_prescribed(joint, times.value_or(std::vector<double>{}),
                                          values.value_or(std::vector<double>{}));
          },
          self, docs::set_prescribed, py::arg("joint"), py::arg("times") = py::none(),
          py::arg("values") = py::none(), py::kw_only(), py::arg("function") = py::none());
}

void bind_model_loops(py::class_<Model>& c, py::module_& m) {
  c.def_property_readonly(
       "loop_names", [](const Model& model) { return names_of(model->equalities.all); },
       "names of the loops and couplings, in the order of their rows")
      .def("loop_gaps", &gaps_of, docs::loop_gaps, py::arg("q"), py::arg("t") = 0.0);
  m.def("close_loops", &closed_state, docs::close_loops, py::arg("model"),
        py::arg("q") = py::none(), py::arg("v") = py::none(), py::kw_only(),
        py::arg("keep") = std::vector<std::string>{}, py::arg("t") = 0.0);
  m.def(
      "equilibrium",
      [](const Model& model, const Coordinates& q, const py::object& control,
         const std::vector<std::string>& keep) {
        const VecX at = equilibrium(model, to_vector(q, model), to_control(control, model),
                                    velocities_of(model, keep));
        return model.state(at, VecX::Zero(model.n_v()));
      },
      docs::equilibrium, py::arg("model"), py::arg("q") = py::none(), py::kw_only(),
      py::arg("control") = py::none(), py::arg("keep") = std::vector<std::string>{});
}

}  // namespace saltus::bindings
