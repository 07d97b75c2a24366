// W of contacts at a node: what an impulse at one changes of the rates of all, by M^-1 there.
#pragma once

#include <span>

#include "variational/node/node.hpp"

namespace saltus {

/// Writes W and the rates u of these contacts, and their columns M^-1 [N; T]^T. Needs M and v.
void set_contact_blocks(const ModelData& model, std::span<Contact* const> contacts, Node& node,
                        ContactBlocks& W, std::vector<Vec3>& u);

/// An impulse (lambda, beta) at a contact, whose columns are written: changes p and v.
void apply(const Contact& contact, const Vec3& p, Node& node);

}  // namespace saltus
