// A law of the user's: asked for p+, checked, reported.
#pragma once

#include "variational/node/node.hpp"

namespace saltus {

/// Writes node.p and node.impulses. Needs the contact matrix.
/// @throws StepError where the law's answer has a wrong length, is not finite, or leaves a contact
/// approaching; what the law throws.
void obey_custom_law(const ModelData& model, const ImpactFunction& law, Node& node);

}  // namespace saltus
