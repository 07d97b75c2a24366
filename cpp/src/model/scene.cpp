// Scenes for people: a body, or a floor, in one call.
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "model/shape_checks.hpp"

namespace saltus {
namespace {

/// [kg] none for what is fixed and has neither mass nor density.
std::optional<double> mass_of(const BodySpec& body) {
  const auto fail = [&](const std::string& what) {
    throw ModelError("body " + quoted(body.name) + " " + what, "link", body.name);
  };
  if (body.mass && body.density) fail("has a mass and a density; give one of them");
  const bool is_fixed = body.joint == JointType::fixed;
  const std::optional<double>& given = body.mass ? body.mass : body.density;
  if (!given) {
    if (!is_fixed) fail("has neither mass [kg] nor density [kg/m^3]; give one of them");
    return {};
  }
  if (!(*given > 0 && std::isfinite(*given))) {
    std::ostringstream text;
    text << "has " << (body.mass ? "mass " : "density ") << *given
         << "; it is finite and positive; what never moves has a fixed joint, and may have neither";
    fail(text.str());
  }
  return body.mass ? *given : *given * volume(body.shape);
}

}  // namespace

bool same_plane(const Pose& X_WA, const Pose& X_WB) {
  const Vec3 a = X_WA.R.col(2), b = X_WB.R.col(2);
  return (a - b).norm() < 1e-9 && std::abs(a.dot(X_WA.p) - b.dot(X_WB.p)) < 1e-9;
}

ModelBuilder& ModelBuilder::add_body(const BodySpec& body) {
  if (std::holds_alternative<HalfSpace>(body.shape)) {
    throw ModelError(
        "body " + quoted(body.name) + " is a half-space, which cannot move; add_floor adds one",
        "link", body.name);
  }
  check_shape(body.shape, body.name);
  const std::optional<double> mass = mass_of(body);
  JointSpec joint;
  joint.name = body.joint_name.empty() ? body.name : body.joint_name;
  joint.type = body.joint;
  joint.parent = body.parent.empty() ? d_.root : body.parent;
  joint.child = body.name;
  joint.X_PJ = body.X;
  joint.axis = body.axis;
  for (const JointSpec& other : d_.joints) {
    if (other.name == joint.name && body.joint_name.empty()) {
      throw ModelError("body " + quoted(body.name) + " would hang on a joint of its name, which " +
                           "there is already; give it a joint_name",
                       "joint", joint.name);
    }
  }
  add_link({body.name, mass ? solid_inertia(*mass, body.shape) : BodyInertia{}});
  try {
    add_joint(joint);
  } catch (...) {
    d_.links.pop_back();
    links_ = {};
    throw;
  }
  return add_shape(body.name, body.shape);
}

ModelBuilder& ModelBuilder::add_floor(const FloorSpec& floor) {
  if (floor.contact) {
    check_properties(*floor.contact, "half-space " + quoted(floor.name) + " and all else");
  }
  add_half_space(floor.name, floor.normal, floor.offset);
  ShapeSpec& added = d_.shapes.back();
  for (const ShapeSpec& shape : d_.shapes) {
    if (&shape == &added || !std::holds_alternative<HalfSpace>(shape.shape)) continue;
    const std::optional<Pose> X_WL = fixed_pose(d_, shape.link);
    if (!X_WL || !same_plane(*X_WL * shape.X_LG, added.X_LG)) continue;
    const std::string other = quoted(shape.name.empty() ? shape.link : shape.name);
    d_.shapes.pop_back();
    throw ModelError("floor " + quoted(floor.name) + " is the plane of half-space " + other +
                         ", which is there already; bodies would touch it twice",
                     "half_space", floor.name);
  }
  added.material = floor.material.empty() ? floor.name : floor.material;
  added.contact = floor.contact;
  return *this;
}

}  // namespace saltus
