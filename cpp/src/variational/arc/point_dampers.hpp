// Dampers between points in an arc: their pull, and its partials for Newton's matrix.
#pragma once

#include "saltus/force/point_damper.hpp"
#include "saltus/lagrangian/packed_point.hpp"
#include "saltus/model/model.hpp"

namespace saltus {

/// A damper in the middle of the arc that was evaluated last.
struct PlacedDamper {
  PackedPoint a, b;
  double damping = 0;          ///< [N s/m]
  Vec3 P_a = Vec3::Zero();     ///< [m] its ends, from O of their trees
  Vec3 P_b = Vec3::Zero();     ///< likewise
  Vec3 n = Vec3::Zero();       ///< unit from b to a, or 0 where there is no line
  Vec3 r_rate = Vec3::Zero();  ///< [m/s] of a from b
  double d = 0;                ///< [m]
  Vec3 force = Vec3::Zero();   ///< [N] on a
};

/// Dampers of the model, not placed yet.
std::vector<PlacedDamper> pack_dampers(const ModelData& model);

/// Places a damper and adds its pull to Q (n_v) and the size of that to `size`. Needs move.
void add_damper(const Packed& w, PlacedDamper& damper, VecX& Q, VecX& size);

/// Writes three columns of w.coupled from `column` on, and adds to G. Needs add_damper at the same
/// evaluation, and second_pass.
void add_damper_partials(const PlacedDamper& damper, Eigen::Index column, Packed& w);

}  // namespace saltus
