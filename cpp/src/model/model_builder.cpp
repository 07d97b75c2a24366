#include "saltus/model/model_builder.hpp"

#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "model/force_checks.hpp"
#include "model/shape_checks.hpp"

namespace saltus {
namespace {

std::string show(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x[0] << " " << x[1] << " " << x[2] << ")";
  return text.str();
}

}  // namespace

template <class Items>
bool ModelBuilder::is_taken(const Items& items, const std::string& name, KnownNames& known) {
  if (known.count > items.size()) known = {};
  for (; known.count < items.size(); ++known.count) known.names.insert(items[known.count].name);
  return known.names.count(name) > 0;
}

template <class Items>
void ModelBuilder::check_new_name(const Items& items, const std::string& element,
                                  const std::string& name, KnownNames& known) {
  if (name.empty()) throw ModelError("a " + element + " has no name", element, name);
  if (!is_taken(items, name, known)) return;
  throw ModelError("two " + element + "s are named " + quoted(name), element, name);
}

void check_inertia(const BodyInertia& inertia, const std::string& link, InertiaCheck check) {
  const auto fail = [&](const std::string& what) {
    throw ModelError("link " + quoted(link) + " has " + what, "link", link);
  };
  std::ostringstream mass;
  mass << inertia.mass;
  if (!std::isfinite(inertia.mass) || inertia.mass < 0) {
    fail("mass " + mass.str() + "; a mass is finite and not negative");
  }
  if (!inertia.c_J.allFinite()) fail("a centre of mass that is not finite: " + show(inertia.c_J));
  if (!inertia.I_J.allFinite()) fail("an inertia that is not finite");
  const double size = inertia.I_J.norm();
  if ((inertia.I_J - inertia.I_J.transpose()).norm() > 1e-12 * size) {
    fail("an inertia matrix that is not symmetric");
  }
  const bool without_mass = inertia.mass == 0 && size > 0;
  if (without_mass && check == InertiaCheck::strict) fail("an inertia but no mass");
}

ModelBuilder::ModelBuilder(std::string name, std::string root) {
  d_.name = std::move(name);
  d_.root = std::move(root);
  d_.links.push_back({d_.root, {}});
}

ModelBuilder& ModelBuilder::set_solver(TreeSolver solver) {
  d_.solver = solver;
  return *this;
}

ModelBuilder& ModelBuilder::set_gravity(const Vec3& gravity) {
  if (!gravity.allFinite()) throw ModelError("gravity " + show(gravity) + " is not finite");
  d_.gravity = gravity;
  return *this;
}

ModelBuilder& ModelBuilder::set_source(std::string text) {
  d_.source = std::move(text);
  return *this;
}

ModelBuilder& ModelBuilder::add_link(const LinkSpec& link) {
  check_new_name(d_.links, "link", link.name, links_);
  check_inertia(link.inertia, link.name, link.check);
  d_.links.push_back(link);
  return *this;
}

ModelBuilder& ModelBuilder::add_joint(const JointSpec& joint) {
  const auto fail = [&](const std::string& what) {
    throw ModelError("joint " + quoted(joint.name) + " " + what, "joint", joint.name);
  };
  check_new_name(d_.joints, "joint", joint.name, joints_);
  JointSpec checked = joint;
  checked.X_PJ = checked_pose(joint.X_PJ, "joint", joint.name);
  if (!joint.axis.allFinite()) fail("has an axis that is not finite: " + show(joint.axis));
  if (joint.axis.stableNorm() == 0) fail("has zero axis");
  if (!std::isfinite(joint.pitch)) fail("has a pitch that is not finite");
  if (joint.pitch != 0 && joint.type != JointType::helical) fail("has a pitch but is not helical");
  if (std::isnan(joint.lower) || std::isnan(joint.upper) || joint.lower > joint.upper) {
    std::ostringstream limits;
    limits << "has lower limit " << joint.lower << " and upper limit " << joint.upper;
    fail(limits.str());
  }
  for (const double number : {joint.velocity, joint.effort, joint.damping, joint.friction}) {
    if (std::isnan(number)) fail("has a limit, damping or friction that is not a number");
  }
  check_forces(joint);
  if (joint.mimic &&
      !(std::isfinite(joint.mimic->multiplier) && std::isfinite(joint.mimic->offset))) {
    fail("has a mimic multiplier or offset that is not finite");
  }
  d_.joints.push_back(std::move(checked));
  return *this;
}

ModelBuilder& ModelBuilder::add_shape(const std::string& link, const Shape& shape,
                                      const Pose& X_LG) {
  check_shape(shape, link);
  if (std::holds_alternative<HalfSpace>(shape) && link != d_.root) {
    throw ModelError("link " + quoted(link) + " carries a half-space, which only the root link " +
                         quoted(d_.root) + " may",
                     "link", link);
  }
  d_.shapes.push_back({link, "", shape, checked_pose(X_LG, "link", link)});
  return *this;
}

ModelBuilder& ModelBuilder::add_visual(const Visual& visual) {
  check_visual(visual);
  d_.visuals.push_back(visual);
  d_.visuals.back().X_LG = checked_pose(visual.X_LG, "link", visual.link);
  return *this;
}

ModelBuilder& ModelBuilder::add_half_space(const std::string& name, const Vec3& normal,
                                           double offset) {
  if (!normal.allFinite() || normal.stableNorm() == 0 || !std::isfinite(offset)) {
    std::ostringstream text;
    text << "half-space " << quoted(name) << " has normal " << show(normal) << " and offset "
         << offset << "; both are finite, and the normal is not zero";
    throw ModelError(text.str(), "half_space", name);
  }
  if (name.empty()) throw ModelError("a half-space has no name", "half_space", name);
  for (const ShapeSpec& shape : d_.shapes) {
    if (shape.name == name) {
      throw ModelError("two half-spaces are named " + quoted(name), "half_space", name);
    }
  }
  const Vec3 n = normal.stableNormalized();
  d_.shapes.push_back(
      {d_.root, name, HalfSpace{}, {rotation_z_to(n), n * (offset / normal.stableNorm())}});
  return *this;
}

ModelBuilder& ModelBuilder::add_exclusion(const std::string& link_a, const std::string& link_b) {
  d_.filter.links.push_back({link_a, link_b});
  return *this;
}

ModelBuilder& ModelBuilder::add_body_exclusion(const std::string& link_a,
                                               const std::string& link_b) {
  d_.filter.bodies.push_back({link_a, link_b});
  return *this;
}

ModelBuilder& ModelBuilder::set_group(const std::string& link, const std::string& group) {
  if (group.empty()) {
    throw ModelError("link " + quoted(link) + " is put into a group without a name", "link", link);
  }
  d_.filter.group_of[link] = group;
  return *this;
}

ModelBuilder& ModelBuilder::add_group_exclusion(const std::string& group_a,
                                                const std::string& group_b) {
  d_.filter.groups.push_back({group_a, group_b});
  return *this;
}

ModelBuilder& ModelBuilder::set_adjacent_links(AdjacentLinks adjacent) {
  d_.filter.adjacent = adjacent;
  return *this;
}

ModelBuilder& ModelBuilder::add_warning(std::string text) {
  d_.warnings.push_back(std::move(text));
  return *this;
}

void ModelBuilder::check() const { Assembly(d_).check(); }

Model ModelBuilder::build() const { return Assembly(d_).build(); }

}  // namespace saltus
