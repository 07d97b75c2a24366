// How p_start changes with an arc's duration. One-degree joints:
//
//   dp_start/dtau = (L_vq v - L_q)/2 - tau/4 L_qq v
//
// joints of a ball, times K, with f = tau w and p = p_start:
//
//   (L_vq v - exp(f/2) L_q)/2 - tau/4 C L_qq v - D(f, p) w
#include "saltus/lagrangian/packed_matrix.hpp"

namespace saltus {
namespace {

/// Number c of a ball's joints.
template <int C>
Vec3 numbers(const Blocks<C>& blocks, const PackedBall& ball, int c) {
  Vec3 out;
  for (int axis = 0; axis < 3; ++axis) out[axis] = at(blocks, ball.slot[axis])[c * lanes];
  return out;
}

Vec3 ball_rate(const PackedBall& ball, const Packed& w, double tau, const PackedProducts& products) {
  const Vec3 omega = numbers(w.s_dot, ball, 0), f = tau * omega;
  const Vec3 L_vq_v = numbers(products.by_joint, ball, 0), L_q = numbers(w.first, ball, 1);
  const Vec3 L_qq_v = numbers(products.by_joint, ball, 2);
  const Vec3 p_start = numbers(w.arc, ball, 0) - tau / 2 * numbers(w.arc, ball, 1);
  return (quaternion_exp(f / 2) * L_q - L_vq_v) / 2 + tau / 4 * left_jacobian(f / 2) * L_qq_v +
         left_jacobian_derivative(f, p_start) * omega;
}

}  // namespace

void set_momentum_rate(const Tree& tree, const PackedTree& t, const Packed& w, double tau,
                       PackedProducts& products, VecX& x, VecX& rate) {
  multiply_by_rates(t, w, products);
  gather(tree, t, w.first, 1, x);
  gather(tree, t, products.by_joint, 0, rate);
  rate = (x - rate) / 2;
  gather(tree, t, products.by_joint, 2, x);
  rate += tau / 4 * x;
  for (const PackedBall& ball : t.balls) {
    rate.segment<3>(ball.velocity) = ball_rate(ball, w, tau, products);
  }
}

}  // namespace saltus
