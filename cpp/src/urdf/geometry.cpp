#include "urdf/geometry.hpp"

#include "urdf/attributes.hpp"
#include "urdf/rewrite.hpp"
#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

const XMLElement* mesh_of(const XMLElement& collision) {
  const XMLElement* geometry = collision.FirstChildElement("geometry");
  return geometry == nullptr ? nullptr : geometry->FirstChildElement("mesh");
}

}  // namespace

Pose pose(const urdf::Pose& origin) {
  const urdf::Rotation& r = origin.rotation;
  return {Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix(),
          {origin.position.x, origin.position.y, origin.position.z}};
}

void add_shapes(const XMLElement& link, const urdf::Link& parsed, CollisionMeshes& meshes,
                ModelBuilder& builder) {
  auto next = parsed.collision_array.begin();
  for (auto c = link.FirstChildElement("collision"); c; c = c->NextSiblingElement("collision")) {
    if (const XMLElement* mesh = mesh_of(*c)) {
      const std::shared_ptr<const Hull> hull = meshes.hull(*mesh, parsed.name);
      if (hull != nullptr) builder.add_shape(parsed.name, Convex{hull}, origin(*c));
    } else if (const XMLElement* usable = usable_shape(*c)) {
      if (next == parsed.collision_array.end()) {
        throw ModelError("urdfdom dropped a collision of link " + in_quotes(parsed.name), "link",
                         parsed.name);
      }
      builder.add_shape(parsed.name, shape_in_geometry(usable->Name())->read(*usable),
                        pose((*next++)->origin));
    }
  }
}

}  // namespace saltus::reader
