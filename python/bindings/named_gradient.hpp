// A gradient by the model with its pairs by name, as Python has it.
#pragma once

#include <map>
#include <string>

#include "bindings.hpp"
#include "saltus/derivatives/step_derivative.hpp"

namespace saltus::bindings {

struct NamedModelGradient {
  ModelGradient core;
  std::map<std::string, double> restitution, friction;
};

/// Without the numbers that are 0.
inline NamedModelGradient with_names(const Model& model, ModelGradient&& gradient) {
  NamedModelGradient out{std::move(gradient), {}, {}};
  for (const PairGradient& each : out.core.pairs) {
    const std::string name = model.pair_name(each.pair);
    if (each.restitution != 0) out.restitution[name] = each.restitution;
    if (each.friction != 0) out.friction[name] = each.friction;
  }
  return out;
}

}  // namespace saltus::bindings
