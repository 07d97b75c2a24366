// Row i of a symmetric-by-branch product collects its subtree through the sums of (U, F, G) v and
// its ancestors through those of W v and S v = V:
//
//   (L_vq v)_i = S_i.sum F_j v_j                     + U_i.up W_k v_k
//   (L_qv v)_i = W_i.sum U_j v_j                     + F_i.up S_k v_k
//   (L_qq v)_i = W_i.sum F_j v_j + S_i.sum G_j v_j   + F_i.up W_k v_k + G_i.up S_k v_k
//
// Sums are over the joint and what is below, `up` over what is above. A joint of a ball takes the
// other two as below, but for (L_qv v)_i, where it takes them and itself as above.
#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/own_terms.hpp"
#include "saltus/lagrangian/packed.hpp"

namespace saltus {
namespace packed {
namespace {

SALTUS_CLONES void set_sums(const PackedTree& t, const Packed& w, PackedProducts& out) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *U_F_G = w.U_F_G[b].x[0], *S_W = w.S_W[b].x[0], *s_dot = w.s_dot[b].x[0];
    double *below = out.below[b].x[0], *above = out.above[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      store(below + l, 0, s_dot[l] * load6(U_F_G + l, 0));
      store(below + l, 6, s_dot[l] * load6(U_F_G + l, 6));
      store(below + l, 12, s_dot[l] * load3(U_F_G + l, 12));
      store(above + l, 0, s_dot[l] * load6(S_W + l, 6));
    }
  }
  for (const PackedGroup& g : t.groups) {
    add_up<15>(g, out.below, 0);
    add_down<6>(g, out.above, 0);
  }
}

SALTUS_CLONES void set_products(const PackedTree& t, const Packed& w, PackedProducts& out) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *U_F_G = w.U_F_G[b].x[0], *S_W = w.S_W[b].x[0], *s_dot = w.s_dot[b].x[0];
    const double *below = out.below[b].x[0], *above = out.above[b].x[0], *V = w.V[b].x[0];
    double* to = out.by_joint[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = load6(S_W + l, 6);
      const V6 U = load6(U_F_G + l, 0), F = load6(U_F_G + l, 6);
      const V6 up_S = load6(V + l, 0) - s_dot[l] * S;
      const V6 up_W = load6(above + l, 0) - s_dot[l] * W;
      const V6 sum_U = load6(below + l, 0), sum_F = load6(below + l, 6);
      to[l] = dot(S, sum_F) + dot(U, up_W);
      to[lanes + l] = dot(W, sum_U) + dot(F, up_S);
      to[2 * lanes + l] = dot(W, sum_F) + dot(S.w, load3(below + l, 12)) + dot(F, up_W) +
                          dot(load3(U_F_G + l, 12), up_S.w);
    }
  }
}

SALTUS_CLONES void set_ball_products(const PackedTree& t, const Packed& w, PackedProducts& out) {
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      const double *S_x = at(w.S_W, s.x) + l, *below_x = at(out.below, s.x) + l;
      const double s_x = *(at(w.s_dot, s.x) + l), s_z = *(at(w.s_dot, s.z) + l);
      const V6 up_W = load6(at(out.above, s.x) + l, 0) - s_x * load6(S_x, 6);
      const V6 up_S = load6(at(w.V, s.x) + l, 0) - s_x * load6(S_x, 0);
      const V6 V = load6(at(w.V, s.z) + l, 0), sum_F = load6(below_x, 6);
      const V6 sum_U = load6(at(out.below, s.z) + l, 0) - s_z * load6(at(w.U_F_G, s.z) + l, 0);
      const V3 sum_G = load3(below_x, 12);
      const auto put = [&](int slot) SALTUS_INLINE_LAMBDA {
        const double *S_W = at(w.S_W, slot) + l, *U_F_G = at(w.U_F_G, slot) + l;
        const V6 S = load6(S_W, 0), W = load6(S_W, 6), U = load6(U_F_G, 0), F = load6(U_F_G, 6);
        double* to = at(out.by_joint, slot) + l;
        to[0] = dot(S, sum_F) + dot(U, up_W);
        to[lanes] = dot(W, sum_U) + dot(F, V);
        to[2 * lanes] =
            dot(W, sum_F) + dot(S.w, sum_G) + dot(F, up_W) + dot(load3(U_F_G, 12), up_S.w);
      };
      put(s.x);
      put(s.y);
      put(s.z);
    });
  }
}

}  // namespace
}  // namespace packed

PackedProducts::PackedProducts(const PackedTree& tree) {
  const std::size_t n = static_cast<std::size_t>(tree.slots / lanes);
  by_joint.resize(n);
  below.resize(n);
  above.resize(n);
}

void multiply_by_rates(const PackedTree& t, const Packed& w, PackedProducts& out) {
  packed::set_sums(t, w, out);
  packed::set_products(t, w, out);
  packed::set_ball_products(t, w, out);
  packed::add_own_products(t, w, out);
}

}  // namespace saltus
