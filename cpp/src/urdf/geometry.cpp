#include "urdf/geometry.hpp"

#include "urdf/attributes.hpp"
#include "urdf/mesh_path.hpp"
#include "urdf/rewrite.hpp"
#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

const XMLElement* mesh_of(const XMLElement& collision_or_visual) {
  const XMLElement* geometry = collision_or_visual.FirstChildElement("geometry");
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

void warn_of_visuals(const Document& document, const MeshFolders& folders, ModelBuilder& builder) {
  int missing = 0;
  std::string first;
  for (const XMLElement* link : document.all("link")) {
    for (auto v = link->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual")) {
      const XMLElement* mesh = mesh_of(*v);
      if (mesh == nullptr) continue;
      const std::string file = attribute(*mesh, "filename");
      const MeshPath path = find_mesh(file, folders.urdf, folders.packages);
      if (!path.found.empty() || ++missing > 1) continue;
      first = document.at(*mesh) + "link " + in_quotes(attribute(*link, "name")) +
              " has a visual mesh, " + in_quotes(file) + ", which is " + describe(path);
    }
  }
  if (missing > 1) first += "; so are " + std::to_string(missing - 1) + " others";
  if (missing > 0) builder.add_warning(first);
}

}  // namespace saltus::reader
