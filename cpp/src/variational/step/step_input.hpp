// What drives a step, checked before anything is changed: the law of impacts and the input.
#pragma once

#include "saltus/force/force_model.hpp"
#include "saltus/model/model.hpp"
#include "variational/node/scene.hpp"

namespace saltus {

/// @throws ModelError on a law that the model has not what it needs for
void check_law(const ModelData& model, ImpactLaw law);

/// @throws ModelError on wrong lengths, numbers that are not finite and bodies that do not move
void check_input(const Model& model, const ForceInput& input);

/// Velocities whose damping may be stiff in a step (stiff_damping.hpp): where bodies are, each
/// feels another inertia, within a factor of 4 as a rule.
std::vector<int> perhaps_stiff(const Scene& scene);

}  // namespace saltus
