#include "saltus/tree/coordinates.hpp"

#include <algorithm>

namespace saltus {

void integrate(const Tree& tree, const VecRef& q, double scale, const VecRef& v, VecX& out) {
  if (tree.balls.empty()) {
    out = q + scale * v;
    return;
  }
  // from ball to ball: the numbers between two of them are in step
  int i = 0, k = 0;
  const auto add = [&](int count) {
    out.segment(i, count) = q.segment(i, count) + scale * v.segment(k, count);
    i += count;
    k += count;
  };
  for (const Ball& ball : tree.balls) {
    add(ball.velocity - k);
    const Quaternion turn = quaternion_exp(scale * v.segment<3>(k));
    Quaternion end = turn * quaternion(ball, q);
    end.coeffs() /= end.norm();
    out.segment<4>(i) = end.coeffs();
    i += 4;
    k += 3;
  }
  add(tree.n_v - k);
}

void difference(const Tree& tree, const VecRef& q0, const VecRef& q1, VecX& out) {
  for (int k = 0; k < tree.n_v; ++k) out[k] = q1[tree.coordinate[k]] - q0[tree.coordinate[k]];
  for (const Ball& ball : tree.balls) {
    const Quaternion turn = quaternion(ball, q1) * quaternion(ball, q0).conjugate();
    out.segment<3>(ball.velocity) = quaternion_log(turn);
  }
}

VecX neutral(const Tree& tree) {
  VecX q = VecX::Zero(tree.n_q);
  for (const Ball& ball : tree.balls) q[ball.coordinate + 3] = 1;
  return q;
}

const Ball& ball_of(const Tree& tree, int joint) {
  const int first = joint - tree.joint[joint].axis;
  return *std::lower_bound(tree.balls.begin(), tree.balls.end(), first,
                           [](const Ball& ball, int j) { return ball.joint < j; });
}

}  // namespace saltus
