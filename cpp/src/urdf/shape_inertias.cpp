#include "urdf/shape_inertias.hpp"

#include <set>

namespace saltus::reader {
namespace {

constexpr double density = 1000;  // [kg/m^3] of water, and of most robots within a factor of 3

using Inertias = std::map<std::string, BodyInertia>;  // by link

void add(const std::string& link, const Shape& shape, const Pose& X_LG, Inertias& inertias) {
  if (std::holds_alternative<HalfSpace>(shape)) return;
  BodyInertia& sum = inertias[link];
  sum = weld(sum, transform(X_LG, solid_inertia(density * volume(shape), shape)));
}

/// A mesh is filled to its convex hull; one that is flat has no inside.
void add(const Visual& visual, Inertias& inertias) {
  try {
    const auto* mesh = std::get_if<TriangleMesh>(&visual.shape);
    const Shape shape =
        mesh == nullptr
            ? std::get<Shape>(visual.shape)
            : Convex{std::make_shared<const Hull>(convex_hull(mesh->triangles->vertices))};
    add(visual.link, shape, visual.X_LG, inertias);
  } catch (const ModelError&) {
    return;
  }
}

}  // namespace

ModelBuilder with_inertias_of_shapes(const Document& document, const MeshFolders& folders,
                                     MeshFiles& files, ModelBuilder builder) {
  ModelDescription d = builder.description();
  std::set<std::string> missing;
  for (const LinkSpec& link : d.links) {
    if (link.inertia.mass == 0) missing.insert(link.name);
  }
  if (missing.empty()) return builder;
  Inertias of_shapes, of_visuals;
  for (const ShapeSpec& shape : d.shapes) {
    if (missing.count(shape.link) > 0) add(shape.link, shape.shape, shape.X_LG, of_shapes);
  }
  ModelBuilder looks = builder;
  Visuals(document, folders, files).add(looks);
  for (const Visual& visual : looks.description().visuals) {
    const bool is_bare = missing.count(visual.link) > 0 && of_shapes.count(visual.link) == 0;
    if (is_bare) add(visual, of_visuals);
  }
  of_shapes.insert(of_visuals.begin(), of_visuals.end());
  for (LinkSpec& link : d.links) {
    const auto found = of_shapes.find(link.name);
    if (found != of_shapes.end()) link.inertia = found->second;
  }
  return ModelBuilder(std::move(d));
}

}  // namespace saltus::reader
