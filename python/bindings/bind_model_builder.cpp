// Model floor: describing a model link by link.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "model_builder_docs.hpp"
#include "pickle.hpp"
#include "saltus/model/model_builder.hpp"
#include "scene_docs.hpp"

namespace saltus::bindings {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto self = py::return_value_policy::reference_internal;

ModelBuilder& add_joint(ModelBuilder& builder, const std::string& name,
                        const Choice<JointType>& type, const std::string& parent,
                        const std::string& child, const Pose& X_PJ, const Vec3& axis, double pitch,
                        const std::optional<Mimic>& mimic, double lower, double upper,
                        double velocity, double effort, double damping, double friction) {
  return builder.add_joint({name, to_enum(type, "type"), parent, child, X_PJ, axis, pitch, mimic,
                            lower, upper, velocity, effort, damping, friction});
}

void bind_add_joint(py::class_<ModelBuilder>& c) {
  c.def("add_joint", &add_joint, self, docs::add_joint, py::arg("name"), py::arg("type"),
        py::kw_only(), py::arg("parent"), py::arg("child"), py::arg_v("X_PJ", Pose{}, "Pose()"),
        py::arg_v("axis", Vec3(Vec3::UnitX()), "(1, 0, 0)"), py::arg("pitch") = 0.0,
        py::arg_v("mimic", std::optional<Mimic>{}, "None"),
        py::arg_v("lower", -infinity, "-math.inf"), py::arg_v("upper", infinity, "math.inf"),
        py::arg_v("velocity", infinity, "math.inf"), py::arg_v("effort", infinity, "math.inf"),
        py::arg("damping") = 0.0, py::arg("friction") = 0.0);
}

ModelBuilder& add_body(ModelBuilder& builder, const std::string& name, const Shape& shape,
                       const std::optional<double>& mass, const std::optional<double>& density,
                       const Pose& X, const Choice<JointType>& joint,
                       const std::optional<std::string>& parent,
                       const std::optional<std::string>& joint_name, const Vec3& axis) {
  return builder.add_body({name, shape, mass, density, X, to_enum(joint, "joint"),
                           joint_name.value_or(""), parent.value_or(""), axis});
}

ModelBuilder& add_floor(ModelBuilder& builder, const std::string& name, const Vec3& normal,
                        double offset, const std::optional<double>& restitution,
                        const std::optional<double>& friction,
                        const std::optional<std::string>& material) {
  FloorSpec floor{name, normal, offset, {}, material.value_or("")};
  if (restitution || friction) floor.contact = {restitution.value_or(0), friction.value_or(0)};
  return builder.add_floor(floor);
}

ModelBuilder& add(ModelBuilder& builder, const std::variant<ModelBuilder, Model>& other,
                  const std::string& prefix, const std::optional<std::string>& parent,
                  const Pose& X, bool own_materials) {
  const auto* model = std::get_if<Model>(&other);
  return builder.add(model ? *(*model)->description : std::get<ModelBuilder>(other).description(),
                     {prefix, parent.value_or(""), X, own_materials});
}

void bind_scenes(py::class_<ModelBuilder>& c) {
  c.def("add_body", &add_body, self, docs::add_body, py::arg("name"), py::arg("shape"),
        py::kw_only(), py::arg("mass") = py::none(), py::arg("density") = py::none(),
        py::arg_v("X", Pose{}, "Pose()"),
        py::arg_v("joint", JointType::floating, "JointType.floating"),
        py::arg("parent") = py::none(), py::arg("joint_name") = py::none(),
        py::arg_v("axis", Vec3(Vec3::UnitX()), "(1, 0, 0)"))
      .def("add_floor", &add_floor, self, docs::add_floor, py::arg("name") = FloorSpec{}.name,
           py::kw_only(), py::arg_v("normal", FloorSpec{}.normal, "(0, 0, 1)"),
           py::arg("offset") = 0.0, py::arg("restitution") = py::none(),
           py::arg("friction") = py::none(), py::arg("material") = py::none())
      .def("add", &add, self, docs::add, py::arg("other"), py::arg("prefix") = "", py::kw_only(),
           py::arg("parent") = py::none(), py::arg_v("X", Pose{}, "Pose()"),
           py::arg("own_materials") = false);
}

/// Checks, freezes, and says aloud what the model warns of.
Model build(const ModelBuilder& builder) {
  Model model = builder.build();
  if (!model->warnings.empty()) {
    py::module_::import("saltus.urdf").attr("issue_warnings")(model->warnings);
  }
  return model;
}

void bind_materials(py::class_<ModelBuilder>& c) {
  c.def("set_material", &ModelBuilder::set_material, self, docs::set_material, py::arg("link"),
        py::arg("material"))
      .def(
          "set_contact",
          [](ModelBuilder& builder, const std::string& a, const std::string& b, double restitution,
             double friction) -> ModelBuilder& {
            return builder.set_contact(a, b, {restitution, friction});
          },
          self, docs::set_contact, py::arg("material_a"), py::arg("material_b"), py::kw_only(),
          py::arg("restitution") = ContactProperties{}.restitution,
          py::arg("friction") = ContactProperties{}.friction)
      .def(
          "set_default_contact",
          [](ModelBuilder& builder, double restitution, double friction) -> ModelBuilder& {
            return builder.set_default_contact({restitution, friction});
          },
          self, docs::set_default_contact, py::kw_only(),
          py::arg("restitution") = ContactProperties{}.restitution,
          py::arg("friction") = ContactProperties{}.friction);
}

void bind_links(py::class_<ModelBuilder>& c) {
  c.def(
       "add_link",
       [](ModelBuilder& builder, const std::string& name, const BodyInertia& inertia,
          const Choice<InertiaCheck>& check) -> ModelBuilder& {
         return builder.add_link({name, inertia, to_enum(check, "check")});
       },
       self, docs::add_link, py::arg("name"), py::arg_v("inertia", BodyInertia{}, "BodyInertia()"),
       py::kw_only(), py::arg_v("check", InertiaCheck::strict, "InertiaCheck.strict"))
      .def("add_shape", &ModelBuilder::add_shape, self, docs::add_shape, py::arg("link"),
           py::arg("shape"), py::arg_v("X_LG", Pose{}, "Pose()"))
      .def(
          "add_visual",
          [](ModelBuilder& builder, const std::string& link,
             const std::variant<Shape, TriangleMesh>& shape, const Pose& X_LG, const Rgba& rgba,
             const std::string& name) -> ModelBuilder& {
            return builder.add_visual({link, shape, X_LG, rgba, name});
          },
          self, docs::add_visual, py::arg("link"), py::arg("shape"),
          py::arg_v("X_LG", Pose{}, "Pose()"), py::kw_only(),
          py::arg_v("rgba", Visual::grey, "(0.7, 0.7, 0.7, 1)"), py::arg("name") = "")
      .def("add_half_space", &ModelBuilder::add_half_space, self, docs::add_half_space,
           py::arg("name"), py::arg("normal"), py::arg("offset") = 0.0);
}

/// What a builder's methods take.
void bind_parts(py::module_& m) {
  py::native_enum<InertiaCheck>(m, "InertiaCheck", "enum.Enum", docs::inertia_check)
      .value("strict", InertiaCheck::strict)
      .value("lenient", InertiaCheck::lenient)
      .value("as_given", InertiaCheck::as_given)
      .finalize();
  py::native_enum<AdjacentLinks>(m, "AdjacentLinks", "enum.Enum", docs::adjacent_links)
      .value("excluded", AdjacentLinks::excluded)
      .value("watched", AdjacentLinks::watched)
      .finalize();
}

}  // namespace

void bind_model_builder(py::module_& m) {
  bind_parts(m);
  bind_points(m);
  m.def("solid_inertia", &solid_inertia, docs::solid_inertia, py::arg("mass"), py::arg("shape"));
  m.def("volume", &volume, docs::volume, py::arg("shape"));

  py::class_<ModelBuilder> c(m, "ModelBuilder", docs::model_builder);
  c.def(py::init<std::string, std::string>(), py::arg("name") = "model", py::arg("root") = "world");
  bind_add_joint(c);
  bind_links(c);
  bind_materials(c);
  bind_scenes(c);
  bind_actuators(c);
  bind_joint_forces(c);
  bind_springs(c);
  bind_check_derivatives(m);
  bind_changes(c, m);
  bind_add_loops(c);
  bind_named_states(c);
  bind_add_sensor(c);
  c.def("set_gravity", &ModelBuilder::set_gravity, self, docs::set_gravity, py::arg("gravity"))
      .def(
          "set_solver",
          [](ModelBuilder& builder, const Choice<TreeSolver>& solver) -> ModelBuilder& {
            return builder.set_solver(to_enum(solver, "solver"));
          },
          self, docs::set_solver, py::arg("solver"))
      .def("add_exclusion", &ModelBuilder::add_exclusion, self, docs::add_exclusion,
           py::arg("link_a"), py::arg("link_b"))
      .def("add_body_exclusion", &ModelBuilder::add_body_exclusion, self, docs::add_body_exclusion,
           py::arg("link_a"), py::arg("link_b"))
      .def("set_group", &ModelBuilder::set_group, self, docs::set_group, py::arg("link"),
           py::arg("group"))
      .def("add_group_exclusion", &ModelBuilder::add_group_exclusion, self,
           docs::add_group_exclusion, py::arg("group_a"), py::arg("group_b"))
      .def(
          "set_adjacent_links",
          [](ModelBuilder& builder, const Choice<AdjacentLinks>& adjacent) -> ModelBuilder& {
            return builder.set_adjacent_links(to_enum(adjacent, "adjacent"));
          },
          self, docs::set_adjacent_links, py::arg("adjacent"))
      .def("add_warning", &ModelBuilder::add_warning, self,
           "Adds to the model's `warnings`; returns the builder.", py::arg("text"))
      .def_property_readonly("warnings", &ModelBuilder::warnings)
      .def("check", &ModelBuilder::check, "The checks of `build` alone; raises ModelError.")
      .def("build", &build, docs::build)
      .def("__repr__", [](const ModelBuilder& builder) {
        const ModelDescription& d = builder.description();
        return "ModelBuilder('" + d.name + "', " + counted(std::ssize(d.links), "link") + ", " +
               counted(std::ssize(d.joints), "joint") + ", " +
               counted(std::ssize(d.shapes), "shape") + ")";
      });
}

}  // namespace saltus::bindings
