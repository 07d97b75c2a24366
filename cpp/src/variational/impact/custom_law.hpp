// A law of the user's: asked for p+, checked, reported.
#pragma once

#include "variational/node/node.hpp"

namespace saltus {

/// Asks options.custom: writes node.p and the impulses.
/// @throws StepError where the law's answer has a wrong length, is not finite, or leaves a contact
/// approaching; what the law throws.
void obey_custom_law(const Scene& scene, Node& node, std::vector<Impulse>& impulses);

}  // namespace saltus
