// A gradient by the model with its pairs by name, as Python has it.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "saltus/derivatives/step_derivative.hpp"

namespace saltus::bindings {

struct NamedModelGradient {
  ModelGradient core;
  std::map<std::string, double> restitution, friction, dampers;
  std::map<std::string, std::pair<double, double>> springs;
  std::map<std::string, Vec3> placements;  ///< of joints that move
};

/// Without the numbers of pairs that are 0.
inline NamedModelGradient with_names(const Model& model, ModelGradient&& gradient) {
  NamedModelGradient out{std::move(gradient), {}, {}, {}, {}, {}};
  const auto& springs = model->mass.potentials.springs;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    out.springs[springs[k].name] = {out.core.springs(row, 0), out.core.springs(row, 1)};
  }
  const auto& dampers = model->forces.dampers;
  for (std::size_t k = 0; k < dampers.size(); ++k) {
    out.dampers[dampers[k].name] = out.core.dampers[static_cast<Eigen::Index>(k)];
  }
  for (const JointInfo& joint : model->joints) {
    if (joint.frames.empty()) continue;
    out.placements[joint.name] = out.core.placements.row(joint.index).transpose();
  }
  for (const PairGradient& each : out.core.pairs) {
    const std::string name = model.pair_name(each.pair);
    if (each.restitution != 0) out.restitution[name] = each.restitution;
    if (each.friction != 0) out.friction[name] = each.friction;
  }
  return out;
}

}  // namespace saltus::bindings
