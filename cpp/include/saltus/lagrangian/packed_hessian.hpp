// Products of the Hessian of L with a direction, in one pass up and one down: O(n).
//
// Theory, section 2: every second partial is a dot product of generators. With x a direction of q
// and y one of v, sums over the subtree of k and over its proper ancestors,
//
//   up    a_k = sum U_j y_j + F_j x_j    g_k = sum G_j x_j
//   down  s_k = sum S_i y_i + W_i x_i    r_k = sum S_i x_i
//
//   (L_vv y + L_vq x)_k   = S_k.a_k + U_k.s_k
//   (L_vq^T y + L_qq x)_k = W_k.a_k + S_k.g_k + F_k.s_k + G_k.r_k
//
// Joints of a ball: as products.cpp. What forces add to L_q, Packed::slope and Packed::coupled, is
// in the second line too, with Q_v y and Q_q x.
#pragma once

#include "saltus/lagrangian/packed.hpp"

namespace saltus {

struct HessianProduct {
  HessianProduct() = default;
  SALTUS_EXPORT explicit HessianProduct(const Tree& tree);

  VecX by_v;  ///< (n_v) L_vv y + L_vq x
  VecX by_q;  ///< (n_v) (L_vq^T + Q_v) y + (L_qq + Q_q) x

  /// By joint, one beside the other: in lanes each number is in a cache line of its own.
  struct Generators {
    Vec6 S, W, U, F;
    Vec3 G;
    double multiplier;
    int velocity, parent;
  };
  std::vector<Generators> own;

  // scratch, by joint
  struct Below {
    Vec6 a;
    Vec3 g;
  };
  struct Above {
    Vec6 s;
    Vec3 r;  ///< its angular part, all that G needs
  };
  std::vector<Below> below;
  std::vector<Above> above;
};

/// Takes the generators at one (q, v), for many products there. Needs second_pass.
SALTUS_EXPORT void take_generators(const Tree& tree, const PackedTree& packed, const Packed& w,
                                   HessianProduct& out);

/// Writes both products of x and y (n_v). Needs take_generators, and the slopes of forces.
SALTUS_EXPORT void multiply_by_hessian(const Tree& tree, const PackedTree& packed, const Packed& w,
                                       const VecRef& x, const VecRef& y, HessianProduct& out);

/// The transposed one, x a covector of by_q and y one of by_v:
/// by_v = L_vv y + (L_vq + Q_v^T) x, by_q = L_vq^T y + (L_qq + Q_q)^T x. Without balls and forces
/// it is the same.
SALTUS_EXPORT void multiply_by_transposed(const Tree& tree, const PackedTree& packed,
                                          const Packed& w, const VecRef& x, const VecRef& y,
                                          HessianProduct& out);

}  // namespace saltus
