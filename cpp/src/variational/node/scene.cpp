#include "variational/node/scene.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

Scene::Scene(const Model& with, const StepOptions& with_options)
    : shared(with_options.collisions ? with : with.without_collisions()),
      options(with_options),
      model(*shared),
      trees(model) {
  const auto& materials = model.materials.contact;
  has_friction = std::any_of(materials.begin(), materials.end(),
                             [](const auto& each) { return each.friction > 0; });
  for (const BodyInertia& body : model.mass.body) total_mass += body.mass;
  for (const Pose& X_PJ : model.tree.X_PJ) reach += X_PJ.p.cwiseAbs().maxCoeff();
  for (const PlacedShape& shape : model.shapes) {
    const double touch = relative_touch * feature_size(shape.shape);
    if (std::isfinite(touch)) most_touch = std::max(most_touch, touch);
  }
}

}  // namespace saltus
