// The certificate of an impact that has just been resolved at a node.
#pragma once

#include <string>

#include "variational/impact/impact.hpp"

namespace saltus {

/// In words, of the contacts that took impulses and those that feel them; "" for a single one.
/// Needs the contact matrix. Allocates: for people who ask.
std::string certify(const ImpactScratch& impact);

/// The same of an impact with friction, whose contacts have still the rates before it: whether
/// another order was possible.
std::string certify_with_friction(const Node& node, const ImpactScratch& impact);

}  // namespace saltus
