// What drives a step, checked before anything is changed.
#pragma once

#include "saltus/force/force_model.hpp"
#include "saltus/model/model.hpp"

namespace saltus {

/// @throws ModelError on wrong lengths, numbers that are not finite and bodies that do not move
void check_input(const Model& model, const ForceInput& input);

}  // namespace saltus
