#include "saltus/lagrangian/packed_point.hpp"

namespace saltus {

PackedPoint pack_point(const Tree& tree, const PackedTree& t, const BodyPoint& point) {
  PackedPoint out;
  out.p_J = point.p_J;
  if (point.joint < 0) return out;
  out.slot = t.slot[point.joint];
  out.root = t.slot[tree.root[point.joint]];
  for (int i = point.joint; i >= 0; i = tree.parent[i]) {
    out.movers.push_back({t.slot[i], tree.drive[i].velocity, tree.drive[i].multiplier});
  }
  return out;
}

Vec3 position_from_O(const Packed& w, const PackedPoint& point) {
  if (point.slot < 0) return point.p_J;
  const double* R = at(w.R, point.slot);
  Vec3 P = three(at(w.p, point.slot));
  for (int c = 0; c < 3; ++c) P += point.p_J[c] * three(R + 3 * c * lanes);
  return P;
}

Vec3 origin_of(const Packed& w, const PackedPoint& point) {
  if (point.slot < 0) return Vec3::Zero();
  const double* p = at(w.p, point.root);  // p_WO = step of the root - p of the root
  return three(p + 3 * lanes) - three(p);
}

void add_pull(const Packed& w, const PackedPoint& point, const Vec3& P, const Vec3& f, VecX& Q,
              VecX& size) {
  for (const PointMover& m : point.movers) {
    const Vec3 J = motion_of(w, m.slot, P);
    Q[m.velocity] += m.multiplier * J.dot(f);
    size[m.velocity] += std::abs(m.multiplier) * J.cwiseAbs().dot(f.cwiseAbs());
  }
}

void add_pull_partials(const PackedPoint& point, const Vec3& P, const Vec3& f, Packed& w) {
  for (const PointMover& m : point.movers) {
    const Vec3 G = motion_of(w, m.slot, P).cross(f);
    double* to = at(w.U_F_G, m.slot) + 12 * lanes;
    for (int c = 0; c < 3; ++c) to[c * lanes] += G[c];
  }
}

void add_motion(const Packed& w, const PackedPoint& point, const Vec3& P, double sign,
                Eigen::Ref<MatX, 0, Eigen::OuterStride<>> columns) {
  for (const PointMover& m : point.movers) {
    columns.row(m.velocity) += sign * m.multiplier * motion_of(w, m.slot, P).transpose();
  }
}

void add_ball_pull(const PackedTree& t, double tau, const VecX& Q, Packed& w) {
  for (const PackedBall& ball : t.balls) {
    const Vec3 torque = Q.segment<3>(ball.velocity);
    if (torque.isZero(0)) continue;
    const double c2 = at(w.ball_arc, ball.slot[2])[lanes];
    Vec3 f;
    for (int axis = 0; axis < 3; ++axis) f[axis] = tau * *at(w.s_dot, ball.slot[axis]);
    const Vec3 more = tau / 2 * c2 * f.cross(torque);
    for (int axis = 0; axis < 3; ++axis) {
      double* arc = at(w.arc, ball.slot[axis]);
      arc[0] += more[axis];
      arc[lanes] += torque[axis];
    }
  }
}

}  // namespace saltus
