// The way of a file: text -> XML with lines (document) -> checks against the schema, of elements,
// of the tree -> rewritten for urdfdom -> parsed by it -> ModelBuilder. What the builder refuses
// gets its line from the document.
#include "saltus/urdf/load_urdf.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "urdf/actuators.hpp"
#include "urdf/checks.hpp"
#include "urdf/extension.hpp"
#include "urdf/geometry.hpp"
#include "urdf/joint_elements.hpp"
#include "urdf/parse.hpp"
#include "urdf/rewrite.hpp"
#include "urdf/shape_inertias.hpp"
#include "urdf/srdf.hpp"
#include "urdf/visuals.hpp"

namespace saltus {
namespace {

using namespace reader;

BodyInertia inertia(const urdf::Link& link) {
  if (link.inertial == nullptr) return {};
  const urdf::Inertial& i = *link.inertial;
  const Pose X_LC = pose(i.origin);
  Mat3 I_C;
  I_C << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
  const Mat3 I_L = X_LC.R * I_C * X_LC.R.transpose();
  return {i.mass, X_LC.p, 0.5 * (I_L + I_L.transpose())};
}

JointType joint_type(const std::string& type) {
  if (is_spherical(type)) return JointType::spherical;
  if (type == "revolute") return JointType::revolute;
  if (type == "continuous") return JointType::continuous;
  if (type == "prismatic") return JointType::prismatic;
  if (type == "planar") return JointType::planar;
  if (type == "floating") return JointType::floating;
  return JointType::fixed;  // check_elements knows them all
}

double limit(double value) {
  return std::abs(value) < no_limit ? value
                                    : std::copysign(std::numeric_limits<double>::infinity(), value);
}

void set_limits(const urdf::Joint& joint, JointSpec& spec) {
  if (joint.limits != nullptr) {
    spec.velocity = limit(joint.limits->velocity);
    spec.effort = limit(joint.limits->effort);
    // only these two have a position that it could limit
    if (spec.type == JointType::revolute || spec.type == JointType::prismatic) {
      spec.lower = limit(joint.limits->lower);
      spec.upper = limit(joint.limits->upper);
    }
  }
  if (joint.dynamics != nullptr) {
    spec.damping = joint.dynamics->damping;
    spec.friction = joint.dynamics->friction;
  }
}

JointSpec joint_spec(const urdf::Joint& joint, const std::string& type, JointEffects effects) {
  JointSpec spec;
  spec.effects = effects;
  spec.name = joint.name;
  spec.type = joint_type(type);
  spec.parent = joint.parent_link_name;
  spec.child = joint.child_link_name;
  spec.X_PJ = pose(joint.parent_to_joint_origin_transform);
  if (has_axis(type)) {
    const Vec3 axis(joint.axis.x, joint.axis.y, joint.axis.z);
    spec.axis = axis / axis.cwiseAbs().maxCoeff();  // else the square of 1e-200 would be zero
  }
  set_limits(joint, spec);
  return spec;
}

/// What moves in one direction, fixed where it stands.
void lock(double displacement, JointSpec& spec) {
  const Vec3 axis = spec.axis.stableNormalized();
  Pose X;
  if (spec.type == JointType::prismatic) {
    X.p = displacement * axis;
  } else {
    X.R = Eigen::AngleAxisd(displacement, axis).toRotationMatrix();
  }
  JointSpec locked;  // without limits, damping and friction
  locked.name = spec.name;
  locked.type = JointType::fixed;
  locked.parent = spec.parent;
  locked.child = spec.child;
  locked.X_PJ = spec.X_PJ * X;
  locked.effects = spec.effects;
  spec = locked;
}

void set_mimic(const Document& document, const XMLElement& joint, const urdf::Joint& parsed,
               JointSpec& spec) {
  if (parsed.mimic == nullptr || spec.type == JointType::fixed) return;
  const urdf::JointMimic& mimic = *parsed.mimic;
  if (document.find("joint", mimic.joint_name) == nullptr) return;  // check_elements tells
  const bool one_way = has_axis(attribute(joint, "type")) && spec.type != JointType::planar;
  const std::optional<double> locked = locked_displacement(document, joint);
  if (one_way && locked) return lock(*locked, spec);
  spec.mimic = Mimic{mimic.joint_name, mimic.multiplier, mimic.offset};
}

std::string unused_name(const Document& document, const char* element, std::string name) {
  while (document.find(element, name) != nullptr) name += "_";
  return name;
}

/// Hangs the file's root on the world; JointType::fixed is the builder's own doing.
void add_root_joint(const Document& document, JointType type, const std::string& world,
                    const std::string& root, ModelBuilder& builder) {
  JointSpec spec;
  spec.name = unused_name(document, "joint", "root");
  spec.type = type;
  spec.parent = world;
  spec.child = root;
  spec.axis = Vec3::UnitZ();
  builder.add_joint(spec);
}

void add_links_and_joints(const Document& document, const urdf::ModelInterface& parsed,
                          CollisionMeshes& meshes, const std::string& fixed_link,
                          InertiaCheck check, JointEffects effects, ModelBuilder& builder) {
  for (const XMLElement* e : document.all("link")) {
    const std::string name = attribute(*e, "name");
    if (name != fixed_link) builder.add_link({name, inertia(*parsed.getLink(name)), check});
  }
  for (const XMLElement* e : document.all("joint")) {
    const urdf::Joint& joint = *parsed.getJoint(attribute(*e, "name"));
    JointSpec spec = joint_spec(joint, attribute(*e, "type"), effects);
    set_mimic(document, *e, joint, spec);
    builder.add_joint(spec);
  }
  for (const XMLElement* e : document.all("link")) {
    add_shapes(*e, *parsed.getLink(attribute(*e, "name")), meshes, builder);
  }
}

/// The root link as the file has it: its mass counts where the robot is put on what moves.
LinkSpec root_link(const Document& document, const urdf::ModelInterface& parsed,
                   const std::string& name, InertiaCheck check) {
  if (document.find("link", name) == nullptr) return {name, {}, check};
  const LinkSpec link{name, inertia(*parsed.getLink(name)), check};
  check_inertia(link.inertia, name, check);
  return link;
}

InertiaCheck check_of(const UrdfOptions& options) {
  if (options.inertia != InertiaUse::checked) return InertiaCheck::as_given;
  return options.strict ? InertiaCheck::strict : InertiaCheck::lenient;
}

/// The plane z = 0, unless the file has it.
void add_floor(const Document& document, ModelBuilder& builder) {
  for (const ShapeSpec& shape : builder.description().shapes) {
    const Vec3 normal = shape.X_LG.R.col(2);
    if (std::holds_alternative<HalfSpace>(shape.shape) && normal == Vec3::UnitZ() &&
        shape.X_LG.p.z() == 0) {
      return;
    }
  }
  builder.add_floor({.name = unused_name(document, "half_space", "floor")});
}

/// Runs what the floor below may refuse, and tells the place in the file if it does.
void located(const Document& document, const std::function<void()>& add) {
  try {
    add();
  } catch (const ModelError& error) {
    throw document.located(error);
  }
}

/// The builder's checks; files that describe a robot for its kinematics only are told a way out.
void check_whole(const ModelBuilder& builder, const UrdfOptions& options) {
  try {
    builder.check();
  } catch (const ModelError& error) {
    const std::string what = error.what();
    if (what.find("moves no mass") == std::string::npos) throw;
    const bool tried = options.inertia == InertiaUse::from_shapes;
    throw ModelError(what + (tried ? ", or a shape to make it of"
                                   : "; inertia=\"from_shapes\" of load_urdf makes those that are "
                                     "missing"),
                     error.element, error.name);
  }
}

}  // namespace

ModelBuilder read_urdf(const std::string& path_or_text, const UrdfOptions& options) {
  const Source source = read_source(path_or_text);
  const Document document(source);
  Warnings warnings(options.strict);
  if (!source.flaw.empty()) warnings.add_flaw("encoding", source.flaw, "");
  check_schema(document, warnings);
  check_elements(document, warnings);
  const std::string root = check_tree(document);
  const std::shared_ptr<urdf::ModelInterface> parsed = parse(document);

  const InertiaCheck check = check_of(options);
  const bool is_fixed = options.root_joint == JointType::fixed;
  const std::string world = is_fixed ? root : unused_name(document, "link", "world");
  const std::string name = attribute(document.robot(), "name");
  ModelDescription empty;
  empty.name = name.empty() ? "model" : name;
  empty.root = world;
  located(document, [&] { empty.links = {root_link(document, *parsed, world, check)}; });
  ModelBuilder builder(std::move(empty));
  builder.set_gravity(options.gravity).set_solver(options.solver).set_source(source.text);
  const MeshFolders folders{source.folder, options.package_dirs};
  MeshFiles files;
  CollisionMeshes meshes(document, folders, files, options.meshes, warnings);
  located(document, [&] {
    if (!is_fixed) add_root_joint(document, options.root_joint, world, root, builder);
    add_links_and_joints(document, *parsed, meshes, world, check, options.effects, builder);
    add_transmissions(document, builder);
  });
  for (const std::string& warning : warnings.lines()) builder.add_warning(warning);
  meshes.warn(builder);
  if (options.inertia == InertiaUse::from_shapes) {
    builder = with_inertias_of_shapes(document, folders, files, std::move(builder));
  }
  if (options.visuals) Visuals(document, folders, files).add(builder);
  add_extension(document, builder);
  if (options.contact) builder.set_default_contact(*options.contact);
  if (options.floor) add_floor(document, builder);
  if (options.srdf) add_srdf(*options.srdf, document, options.strict, builder);
  located(document, [&] { check_whole(builder, options); });
  return builder;
}

Model load_urdf(const std::string& path_or_text, const UrdfOptions& options) {
  return read_urdf(path_or_text, options).build();
}

}  // namespace saltus
