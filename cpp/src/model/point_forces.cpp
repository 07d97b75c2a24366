// Springs between points, compensation of gravity, and functions: from names to indices.
#include <algorithm>

#include "model/assembly.hpp"

namespace saltus {

BodyPoint Assembly::body_point(const At& point, const std::string& user,
                               const std::string& culprit) const {
  const int link = link_index(point.link, user, "spring", culprit);
  return {place_[link].joint, place_[link].X_JF * point.X_LA.p};
}

void Assembly::add_springs() {
  for (const SpringSpec& spec : d_.springs) {
    const std::string user = "spring " + quoted(spec.name) + " is fixed to";
    const BodyPoint a = body_point(spec.a, user, spec.name);
    const BodyPoint b = body_point(spec.b, user, spec.name);
    if (a.joint == b.joint) {
      throw ModelError("spring " + quoted(spec.name) + " joins links " + quoted(spec.a.link) +
                           " and " + quoted(spec.b.link) +
                           ", which are one body: it would do nothing",
                       "spring", spec.name);
    }
    if (spec.stiffness > 0) {
      m_.mass.potentials.springs.push_back({spec.name, a, b, spec.stiffness, spec.length});
    }
    if (spec.damping > 0) {
      m_.forces.dampers.push_back({spec.name, a.joint, b.joint, a.p_J, b.p_J, spec.damping});
    }
  }
}

void Assembly::add_compensations() {
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    const LinkSpec& link = d_.links[i];
    if (link.compensation == 0 || link.inertia.mass == 0 || place_[i].joint < 0) continue;
    const Vec3 lift = -link.compensation * link.inertia.mass * d_.gravity;
    m_.mass.potentials.forces.push_back(
        {{place_[i].joint, place_[i].X_JF * link.inertia.c_J}, lift});
  }
}

void Assembly::add_functions() {
  for (const ForceSpec& spec : d_.forces) {
    FunctionForce force{spec.name, {}, spec.function};
    for (const std::string& name : spec.coordinates) {
      const auto& names = m_.velocity_names;
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) {
        throw ModelError("force " + quoted(spec.name) + " pushes coordinate " + quoted(name) +
                             ", which does not exist; they are " + list_names(names),
                         "force", spec.name);
      }
      force.velocities.push_back(static_cast<int>(found - names.begin()));
    }
    for (int c = 0; c < m_.tree.n_v && spec.coordinates.empty(); ++c) {
      force.velocities.push_back(c);
    }
    m_.forces.functions.push_back(std::move(force));
  }
  m_.mass.potentials.functions = d_.potentials;
}

}  // namespace saltus
