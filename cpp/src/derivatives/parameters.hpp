// Gradients by what a model is made of: inertias of links, springs, damping, armature, actuators,
// placements of joints (placements.hpp).
//
// L is linear in each body's ten inertial parameters (m, h = m c, I about the joint's origin). In a
// joint's frame, with its twist (v, w) and a change of q along x and of v along y,
//
//   dL = m (v.dv + g.dp) + h.(dv x w + v x dw + R^T (g x dphi)) + w.I dw
//
// where (dw, dv) is the twist sum S_i y_i + W_i x_i over i at or above, and (dphi, dp) = sum S_i
// x_i.
#pragma once

#include <utility>

#include "derivatives/placements.hpp"
#include "derivatives/rubbing.hpp"
#include "saltus/derivatives/step_derivative.hpp"

namespace saltus {

/// Covectors of the parameters.
struct ParameterGradient {
  MatX body;                                ///< (joints, 10): m, h, I as xx xy xz yy yz zz
  VecX stiffness, rest, damping, armature;  ///< (n_v)
  MatX actuators;                           ///< (n_u, 4): gain, bias, bias_l, bias_v
  MatX springs;                             ///< (springs between points, 2): stiffness, length
  VecX dampers;                             ///< (dampers between points)
  PlacementGradient placement;
  /// Pair and its number, as they come: by restitution of each impulse.
  std::vector<std::pair<int, double>> restitution;

  std::vector<Vec6> twist, turn;  ///< (joints) scratch

  void start(const ModelData& model);
};

/// Sets the bodies of to.placement, too: to += factor (what all but placements make of x.L_q +
/// y.L_v) at w.
void add_gradient(const ModelData& model, const Packed& w, const VecX& x, const VecX& y,
                  double factor, ParameterGradient& to);

/// to += factor (what all this makes of y.L_v) at w.
void add_node_gradient(const ModelData& model, const Packed& w, const VecX& y, double factor,
                       ParameterGradient& to);

/// Of an arc that has just been pulled back, with what that added to Q.
void add_arc_gradient(const ModelData& model, const ArcDerivative& arc, const VecX& Q,
                      ParameterGradient& to);

/// From bodies of joints to links: (links, 10), in each link's own frame; of fixed ones 0.
MatX by_link(const ModelData& model, const ParameterGradient& gradient);

/// By pairs, in the order of their numbers.
std::vector<PairGradient> by_pair(const ParameterGradient& gradient, const Rubbing& friction);

}  // namespace saltus
