// Collision shapes of a link.
#pragma once

#include "saltus/model/model_builder.hpp"
#include "urdf/collision_meshes.hpp"
#include "urdf/document.hpp"
#include "urdf/parse.hpp"

namespace saltus::reader {

Pose pose(const urdf::Pose& origin);

/// Adds the link's shapes.
void add_shapes(const XMLElement& link, const urdf::Link& parsed, CollisionMeshes& meshes,
                ModelBuilder& builder);

}  // namespace saltus::reader
