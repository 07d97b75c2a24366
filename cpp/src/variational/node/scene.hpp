// Scene: what does not change from step to step. Written by its constructor alone.
#pragma once

#include "saltus/model/model.hpp"
#include "saltus/variational/options.hpp"
#include "variational/node/contact_vector.hpp"

namespace saltus {

struct Scene {
  /// Without the model's shapes where options.collisions is false.
  Scene(const Model& model, const StepOptions& options);

  Model shared;
  StepOptions options;
  const ModelData& model;
  TreeCoordinates trees;
  bool has_friction = false;  ///< some pair of materials has
  double total_mass = 0;      ///< [kg]
  double most_touch = 0;      ///< [m] no pair's epsilon_phi is larger, near the origin
  double reach = 0;           ///< [m] sum of all fixed placements

  /// ArcProblem::whole of these options.
  double whole_step() const {
    const bool is_free = !model.forces.acts() && model.equalities.rows == 0;
    return options.law == ImpactLaw::compensated && is_free ? options.h : 0;
  }
};

}  // namespace saltus
