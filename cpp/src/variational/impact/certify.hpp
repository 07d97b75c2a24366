// The certificate of an impact that has just been resolved at a node.
#pragma once

#include <string>

#include "variational/impact/impact.hpp"

namespace saltus {

/// In words, of the contacts that took impulses and those that feel them; "" for a single one.
/// Needs the contact matrix. Allocates: for people who ask.
std::string certify(const ImpactScratch& impact);

}  // namespace saltus
