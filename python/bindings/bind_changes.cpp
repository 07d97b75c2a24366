// Model floor: links and joints of a builder, read and said anew.
#include "bindings.hpp"
#include "saltus/model/model_builder.hpp"

namespace saltus::bindings {
namespace {

constexpr auto link_doc = R"(A link of a builder: what is set here is checked and kept at once.

Made by `ModelBuilder.link`. Models that were built before do not change.
)";

constexpr auto joint_doc = R"(A joint of a builder: what is set here is checked and kept at once.

Made by `ModelBuilder.joint`. Models that were built before do not change.
)";

constexpr auto builder_link_doc = R"(A link by name, to read and to change.

Parameters
----------
name : str

Returns
-------
BuilderLink

Raises
------
ModelError
    On an unknown name; lists the names there are.

Examples
--------
>>> import saltus
>>> builder = saltus.read_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
>>> builder.link("ball_0").mass = 2.0
>>> builder.build().link("ball_0").mass
2.0
)";

constexpr auto builder_joint_doc = R"(A joint by name, to read and to change.

Parameters
----------
name : str

Returns
-------
BuilderJoint

Raises
------
ModelError
    On an unknown name; lists the names there are.
)";

constexpr auto model_builder_doc = R"(A new builder that holds what this model was built of.

To change a mass, a limit, a material, or to add to it, and build another model.

Returns
-------
ModelBuilder
)";

/// One item of a builder; the builder is kept alive by whoever binds this.
struct BuilderLink {
  ModelBuilder* builder;
  std::string name;
  const LinkSpec& spec() const { return builder->link_spec(name); }
};
struct BuilderJoint {
  ModelBuilder* builder;
  std::string name;
  const JointSpec& spec() const { return builder->joint_spec(name); }
};

std::optional<std::string> material(const BuilderLink& link) {
  const auto& of_link = link.builder->description().materials.of_link;
  const auto found = of_link.find(link.name);
  return found == of_link.end() ? std::nullopt : std::optional(found->second);
}

void bind_link(py::module_& m) {
  using L = BuilderLink;
  py::class_<L>(m, "BuilderLink", link_doc)
      .def_readonly("name", &L::name)
      .def_property(
          "mass", [](const L& link) { return link.spec().inertia.mass; },
          [](L& link, double mass) { link.builder->set_mass(link.name, mass); },
          "[kg] When it is set the centre of mass stays, and the inertia about it grows with it")
      .def_property(
          "inertia", [](const L& link) { return link.spec().inertia; },
          [](L& link, const BodyInertia& inertia) {
            link.builder->change_link(link.name, [&](LinkSpec& spec) { spec.inertia = inertia; });
          },
          "BodyInertia: mass, centre of mass and inertia about it, in the link's frame")
      .def_property(
          "material", &material,
          [](L& link, const std::string& name) { link.builder->set_material(link.name, name); },
          "what its shapes are made of, see `set_contact`; None where nothing is said")
      .def("__repr__", [](const L& link) { return "BuilderLink('" + link.name + "')"; });
}

/// Reads and changes a field of a JointSpec.
template <auto field>
void bind_field(py::class_<BuilderJoint>& c, const char* name, const char* doc) {
  using T = std::decay_t<decltype(std::declval<JointSpec>().*field)>;
  const auto set = [](BuilderJoint& joint, const T& value) {
    joint.builder->change_joint(joint.name, [&](JointSpec& spec) { spec.*field = value; });
  };
  c.def_property(
      name, [](const BuilderJoint& joint) { return joint.spec().*field; },
      // named, because pybind11 tells a value of a wrong type by the setter's name
      py::cpp_function(set, py::name(name), py::is_method(c)), doc);
}

void bind_joint(py::module_& m) {
  using J = BuilderJoint;
  py::class_<J> c(m, "BuilderJoint", joint_doc);
  c.def_readonly("name", &J::name)
      .def_property_readonly("type", [](const J& joint) { return joint.spec().type; })
      .def_property_readonly("parent", [](const J& joint) { return joint.spec().parent; })
      .def_property_readonly("child", [](const J& joint) { return joint.spec().child; })
      .def("__repr__", [](const J& joint) { return "BuilderJoint('" + joint.name + "')"; });
  bind_field<&JointSpec::X_PJ>(c, "X_PJ", "Pose of the joint's frame in the parent link's");
  bind_field<&JointSpec::axis>(c, "axis", "in the joint's frame, of any length but 0, shape (3,)");
  bind_field<&JointSpec::pitch>(c, "pitch", "[m/rad] helical joints only");
  bind_field<&JointSpec::mimic>(c, "mimic", "Mimic or None");
  bind_field<&JointSpec::lower>(c, "lower", "[rad | m] limit, -inf where there is none");
  bind_field<&JointSpec::upper>(c, "upper", "[rad | m] limit, inf where there is none");
  bind_field<&JointSpec::velocity>(c, "velocity", "[rad/s | m/s] limit, inf where there is none");
  bind_field<&JointSpec::effort>(c, "effort", "[N m | N] limit, inf where there is none");
  bind_field<&JointSpec::damping>(c, "damping", "[N m s/rad | N s/m]");
  bind_field<&JointSpec::friction>(c, "friction", "[N m | N]");
}

}  // namespace

void bind_changes(py::class_<ModelBuilder>& c, py::module_& m) {
  bind_link(m);
  bind_joint(m);
  c.def(
       "link",
       [](ModelBuilder& builder, const std::string& name) {
         return BuilderLink{&builder, builder.link_spec(name).name};
       },
       py::keep_alive<0, 1>(), builder_link_doc, py::arg("name"))
      .def(
          "joint",
          [](ModelBuilder& builder, const std::string& name) {
            return BuilderJoint{&builder, builder.joint_spec(name).name};
          },
          py::keep_alive<0, 1>(), builder_joint_doc, py::arg("name"))
      .def_property_readonly("link_names",
                             [](const ModelBuilder& b) { return names_of(b.description().links); })
      .def_property_readonly(
          "joint_names", [](const ModelBuilder& b) { return names_of(b.description().joints); });
  py::class_<Model> model(py::object(m.attr("Model")));
  model.def(
      "builder", [](const Model& whole) { return ModelBuilder(*whole->description); },
      model_builder_doc);
}

}  // namespace saltus::bindings
