// f_a = -c d' n, n = r / d, d' = n.r'; with J = J_a - J_b and N = (1 - n n^T) / d:
//
//   Q   = J^T f_a
//   Q_v = -c J^T n n^T J
//   Q_q = f_a.H - c J^T n z^T - c d' J^T N J,     z = n.dr'/dq + J^T N r'
//
// f.H is made of generators (packed_point.hpp). A point P of a body with twist V, by joint i above:
//
//   dP'/dq_i = lin X + ang X x P + ang V x J_i,   X = S_i x (V - V_i) = S_i x V + W_i
#include "variational/arc/point_dampers.hpp"

namespace saltus {
namespace {

Vec3 velocity_of(const Packed& w, const PackedPoint& point, const Vec3& P) {
  if (point.slot < 0) return Vec3::Zero();
  const double* V = at(w.V, point.slot);
  return three(V + 3 * lanes) + three(V).cross(P);
}

/// z += sign n.dP'/dq.
void add_turned_rates(const Packed& w, const PackedPoint& point, const Vec3& P, const Vec3& n,
                      double sign, Eigen::Ref<VecX, 0, Eigen::InnerStride<>> z) {
  if (point.slot < 0) return;
  const Vec6 V = six(at(w.V, point.slot));
  for (const PointMover& m : point.movers) {
    const double* numbers = at(w.S_W, m.slot);
    const Vec6 S = six(numbers), X = cross_motion(S, V) + six(numbers + 6 * lanes);
    const Vec3 rate =
        linear(X) + angular(X).cross(P) + angular(V).cross(linear(S) + angular(S).cross(P));
    z[m.velocity] += sign * m.multiplier * n.dot(rate);
  }
}

}  // namespace

std::vector<PlacedDamper> pack_dampers(const ModelData& model) {
  std::vector<PlacedDamper> out;
  for (const PointDamper& each : model.forces.dampers) {
    PlacedDamper placed;
    placed.a = pack_point(model.tree, model.packed, {each.joint_a, each.p_a});
    placed.b = pack_point(model.tree, model.packed, {each.joint_b, each.p_b});
    placed.damping = each.damping;
    out.push_back(placed);
  }
  return out;
}

void add_damper(const Packed& w, PlacedDamper& x, VecX& Q, VecX& size) {
  x.P_a = position_from_O(w, x.a);
  x.P_b = position_from_O(w, x.b);
  const Vec3 r = (x.P_a - x.P_b) + (origin_of(w, x.a) - origin_of(w, x.b));
  x.d = r.norm();
  x.r_rate = velocity_of(w, x.a, x.P_a) - velocity_of(w, x.b, x.P_b);
  const Vec3 line = x.d > 0 ? r : x.r_rate;
  x.n = line.isZero(0) ? Vec3(Vec3::Zero()) : Vec3(line.normalized());
  x.force = -x.damping * x.n.dot(x.r_rate) * x.n;
  add_pull(w, x.a, x.P_a, x.force, Q, size);
  add_pull(w, x.b, x.P_b, -x.force, Q, size);
}

void add_damper_partials(const PlacedDamper& x, Eigen::Index column, Packed& w) {
  add_pull_partials(x.a, x.P_a, x.force, w);
  add_pull_partials(x.b, x.P_b, -x.force, w);
  auto J = w.coupled.middleCols<3>(column);
  J.setZero();
  add_motion(w, x.a, x.P_a, 1, w.coupled.middleCols(column, 3));
  add_motion(w, x.b, x.P_b, -1, w.coupled.middleCols(column, 3));
  const Mat3 along = x.n * x.n.transpose();
  const Mat3 across = x.d > 0 ? Mat3((Mat3::Identity() - along) / x.d) : Mat3(Mat3::Zero());
  w.coupled_v.middleCols<3>(column) = J.lazyProduct(-x.damping * along);
  auto by_q = w.coupled_q.middleCols<3>(column);
  auto z = by_q.col(2);  // until it is spread over all three
  z = J.lazyProduct(across * x.r_rate);
  add_turned_rates(w, x.a, x.P_a, x.n, 1, z);
  add_turned_rates(w, x.b, x.P_b, x.n, -1, z);
  for (int c = 0; c < 3; ++c) by_q.col(c) = -x.damping * x.n[c] * z;
  by_q -= J.lazyProduct(x.damping * x.n.dot(x.r_rate) * across);
}

}  // namespace saltus
