// The `<saltus>` block, see load_urdf.hpp.
#pragma once

#include <map>
#include <string>

#include "saltus/urdf/load_urdf.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// Adds what the block says; needs the checks, and the links added before.
void add_extension(const Document& document, ModelBuilder& builder);

/// The links whose collision meshes the block speaks of.
std::map<std::string, MeshUse> mesh_uses(const Document& document);

}  // namespace saltus::reader
