// Collision shapes of a link.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"
#include "urdf/parse.hpp"

namespace saltus::reader {

struct MeshFolders {
  std::filesystem::path urdf;
  std::vector<std::string> packages;
};

Pose pose(const urdf::Pose& origin);

/// Adds the link's shapes; a mesh is no shape yet, and becomes a warning with the place of its
/// file.
void add_shapes(const Document& document, const XMLElement& link, const urdf::Link& parsed,
                const MeshFolders& folders, ModelBuilder& builder);

/// One warning for all meshes of visuals that are not found: they are only looked at.
void warn_of_visuals(const Document& document, const MeshFolders& folders, ModelBuilder& builder);

}  // namespace saltus::reader
