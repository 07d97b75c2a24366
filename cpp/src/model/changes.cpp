// Links and joints that are said anew.
#include <algorithm>
#include <cmath>

#include "model/assembly.hpp"

namespace saltus {
namespace {

void check_name(const std::string& now, const std::string& element, const std::string& name) {
  if (now == name) return;
  throw ModelError(
      element + " " + quoted(name) + " cannot become " + quoted(now) + ": others know it by name",
      element, name);
}

}  // namespace

const LinkSpec& ModelBuilder::link_spec(const std::string& name) const {
  return named(d_.links, "link", name);
}

const JointSpec& ModelBuilder::joint_spec(const std::string& name) const {
  return named(d_.joints, "joint", name);
}

ModelBuilder& ModelBuilder::change_link(const std::string& name,
                                        const std::function<void(LinkSpec&)>& change) {
  LinkSpec& link = named(d_.links, "link", name);
  LinkSpec changed = link;
  change(changed);
  check_name(changed.name, "link", name);
  check_inertia(changed.inertia, name, changed.check);
  link = std::move(changed);
  d_.source.clear();
  return *this;
}

ModelBuilder& ModelBuilder::change_joint(const std::string& name,
                                         const std::function<void(JointSpec&)>& change) {
  JointSpec& joint = named(d_.joints, "joint", name);
  JointSpec changed = joint;
  change(changed);
  check_name(changed.name, "joint", name);
  ModelBuilder judge;  // add_joint has the checks
  joint = judge.add_joint(changed).d_.joints.back();
  d_.source.clear();
  return *this;
}

ModelBuilder& ModelBuilder::set_mass(const std::string& link, double mass) {
  return change_link(link, [&](LinkSpec& spec) {
    const double before = spec.inertia.mass;
    spec.inertia.mass = mass;
    if (std::isfinite(mass) && before > 0) spec.inertia.I_J *= mass / before;
  });
}

}  // namespace saltus
