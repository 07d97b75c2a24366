#include "saltus/tree/coordinates.hpp"

#include <algorithm>

namespace saltus {

namespace {

/// to <- exp(f) from, both x y z w.
void turn(const Vec3& f, const double* from, double* to) {
  const Quaternion by = quaternion_exp(f);
  const double a = by.x(), b = by.y(), c = by.z(), d = by.w();
  const double x = from[0], y = from[1], z = from[2], w = from[3];
  const double nx = d * x + a * w + b * z - c * y, ny = d * y + b * w + c * x - a * z;
  const double nz = d * z + c * w + a * y - b * x, nw = d * w - a * x - b * y - c * z;
  // both are of length 1 to rounding, and so is their product: one step of Newton's is exact
  const double length = 1.5 - 0.5 * (nx * nx + ny * ny + nz * nz + nw * nw);
  to[0] = length * nx;
  to[1] = length * ny;
  to[2] = length * nz;
  to[3] = length * nw;
}

}  // namespace

void integrate(const Tree& tree, const VecRef& q, double scale, const VecRef& v, VecX& out) {
  if (tree.balls.empty()) {
    out = q + scale * v;
    return;
  }
  // from ball to ball: the numbers between two of them are in step
  int i = 0, k = 0;
  const double *from = q.data(), *rate = v.data();
  double* to = out.data();
  for (const Ball& ball : tree.balls) {
    for (; k < ball.velocity; ++i, ++k) to[i] = from[i] + scale * rate[k];
    turn(scale * Vec3(rate[k], rate[k + 1], rate[k + 2]), from + i, to + i);
    i += 4;
    k += 3;
  }
  for (; k < tree.n_v; ++i, ++k) to[i] = from[i] + scale * rate[k];
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
