// Inertias of links that have none, from their shapes.
#pragma once

#include "urdf/visuals.hpp"

namespace saltus::reader {

/// The builder with links without a mass filled with water, see InertiaUse::from_shapes. Its links
/// and shapes are added before; what links look like is read here if need be, and not added.
ModelBuilder with_inertias_of_shapes(const Document& document, const MeshFolders& folders,
                                     MeshFiles& files, ModelBuilder builder);

}  // namespace saltus::reader
