#include "saltus/collision/contact.hpp"

#include "saltus/collision/parts.hpp"

#include <algorithm>

#include "collision/parts/kinds.hpp"

namespace saltus {
namespace {

/// O of the tree that carries the joint; the world's origin for the world.
Vec3 reference_point(const Tree& tree, const Kinematics& kin, int joint) {
  return joint < 0 ? Vec3(Vec3::Zero()) : kin.origin[tree.root[joint]];
}

/// Pose of a shape with the origin moved to `origin_W`. `kin` holds positions from each tree's O,
/// so two shapes of one tree keep all digits however far away it is.
Pose pose_from(const Tree& tree, const Kinematics& kin, const Placed& shape, const Vec3& origin_W) {
  if (shape.joint < 0) return {shape.X_JG.R, shape.X_JG.p - origin_W};
  const JointMotion& m = kin.joint[shape.joint];
  const Vec3 shift = reference_point(tree, kin, shape.joint) - origin_W;
  return Pose{m.R, m.p + shift} * shape.X_JG;
}

/// Velocity of P, with body a, against body b for unit speed of one joint of the chain.
Vec3 velocity_of(const Tree& tree, const Kinematics& kin, const ChainJoint& k, const Vec3& P_W) {
  const Vec6& S = kin.joint[k.joint].S;
  const Vec3 P = P_W - kin.origin[tree.root[k.joint]];
  return k.sign * (angular(S).cross(P) + linear(S));
}

/// Of a stop: points and normal are those of the joint's frame, for pictures.
Gap stop_gap(const Tree& tree, const Kinematics& kin, const Pair& pair) {
  const int joint = pair.on_a.joint;
  const Pose X_WJ = kin.X_WJ(tree, joint);
  Gap g;
  g.phi = pair.stop.side * (kin.joint[joint].s - pair.stop.bound);
  g.n_W = pair.stop.side * X_WJ.R.col(2);
  g.p_WA = g.p_WB = g.center_W = X_WJ.p;
  g.d = g.phi;
  return g;
}

/// The twist [w; u] of a against b about P for unit speed of one joint of the chain.
Vec6 twist_of(const Tree& tree, const Kinematics& kin, const ChainJoint& k, const Vec3& P_W) {
  Vec6 t;
  t << k.sign * angular(kin.joint[k.joint].S), velocity_of(tree, kin, k, P_W);
  return t;
}

}  // namespace

Gap pair_gap(const Tree& tree, const Kinematics& kin, const Pair& pair) {
  return pair_gap(tree, kin, pair, Vec3::Zero());
}

Gap pair_gap(const Tree& tree, const Kinematics& kin, const Pair& pair, const Vec3& motion_W) {
  if (pair.is_stop()) return stop_gap(tree, kin, pair);
  const Placed &a = pair.on_a, &b = pair.on_b;
  const Vec3 origin = reference_point(tree, kin, std::max(a.joint, b.joint));
  const Pose X_WA = pose_from(tree, kin, a, origin), X_WB = pose_from(tree, kin, b, origin);
  Gap g = part_gap(pair, X_WA, X_WB, motion_W);
  g.p_WA += origin;
  g.p_WB += origin;
  g.center_W += origin;
  return g;
}

bool is_silent(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap) {
  if (pair.is_stop() || !may_be_silent(pair)) return false;
  const Vec3 none = Vec3::Zero();  // the gap's points are from the world's origin
  return is_silent(pair, pose_from(tree, kin, pair.on_a, none),
                   pose_from(tree, kin, pair.on_b, none), gap);
}

double edge_distance(const Tree& tree, const Kinematics& kin, const Pair& pair) {
  const Placed &a = pair.on_a, &b = pair.on_b;
  const Vec3 origin = reference_point(tree, kin, std::max(a.joint, b.joint));
  const Pose X_A = pose_from(tree, kin, a, origin), X_B = pose_from(tree, kin, b, origin);
  const double around = distance_around_cylinder(pair, X_A, X_B);
  return around > 0 ? around : gap(a.shape, X_A, b.shape, X_B).phi;
}

void put_plane_on_b(const Tree& tree, const Kinematics& kin, const Vec3& p_W, const Vec3& n_W,
                    Pair& pair) {
  const Pose X_WJ = kin.X_WJ(tree, pair.on_b.joint);
  pair.on_b.shape = HalfSpace{};
  pair.on_b.X_JG = {rotation_z_to(X_WJ.R.transpose() * n_W), X_WJ.R.transpose() * (p_W - X_WJ.p)};
}

void add_gap_gradient(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap,
                      Eigen::Ref<VecX> phi_q) {
  if (pair.is_stop()) {
    const Drive& drive = tree.drive[pair.on_a.joint];
    phi_q[drive.velocity] += pair.stop.side * drive.multiplier;
    return;
  }
  for (const ChainJoint& k : pair.chain) {
    const Drive& drive = tree.drive[k.joint];
    phi_q[drive.velocity] +=
        drive.multiplier * gap.n_W.dot(velocity_of(tree, kin, k, gap.center_W));
  }
}

namespace {

/// Calls f(velocity, velocity, value) for each pair of joints of the chain, once.
template <class F>
void for_each_second(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap,
                     const F& f) {
  const Mat6 C = curvature(gap);
  for (std::size_t l = 0; l < pair.chain.size(); ++l) {
    const Drive& drive_l = tree.drive[pair.chain[l].joint];
    const Vec6 t_l = twist_of(tree, kin, pair.chain[l], gap.center_W);
    Vec6 C_t = C * t_l;
    C_t.head<3>() += t_l.tail<3>().cross(gap.n_W);  // n.(w x u) = w.(u x n)
    for (std::size_t i = 0; i <= l; ++i) {
      const ChainJoint& k = pair.chain[i];
      const Drive& drive_i = tree.drive[k.joint];
      const Vec6 t_i = twist_of(tree, kin, k, gap.center_W);
      double second = t_i.dot(C_t);
      if (i < l &&
          are_of_one_ball(tree, k.joint, pair.chain[l].joint)) {  // the mean of both orders
        const Vec3 w_i = t_i.head<3>(), u_i = t_i.tail<3>(), w_l = t_l.head<3>(),
                   u_l = t_l.tail<3>();
        second += 0.5 * gap.n_W.dot(w_l.cross(u_i) - w_i.cross(u_l));
      }
      f(drive_i.velocity, drive_l.velocity, drive_i.multiplier * drive_l.multiplier * second,
        i == l);
    }
  }
}

}  // namespace

void add_gap_hessian(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap,
                     Eigen::Ref<MatX> phi_qq) {
  if (pair.is_stop()) return;  // phi is linear
  for_each_second(tree, kin, pair, gap, [&](int i, int l, double value, bool same) {
    phi_qq(i, l) += value;
    if (!same) phi_qq(l, i) += value;
  });
}

void list_velocities(const Tree& tree, const Pair& pair, std::vector<int>& velocities) {
  velocities.clear();
  for (const ChainJoint& k : pair.chain) velocities.push_back(tree.drive[k.joint].velocity);
  std::sort(velocities.begin(), velocities.end());
  velocities.erase(std::unique(velocities.begin(), velocities.end()), velocities.end());
}

void set_gap_hessian(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap,
                     MatX& phi_qq, std::vector<int>& velocities) {
  list_velocities(tree, pair, velocities);
  const auto n = static_cast<Eigen::Index>(velocities.size());
  phi_qq.setZero(n, n);
  if (pair.is_stop()) return;
  const auto index = [&](int velocity) {
    return std::lower_bound(velocities.begin(), velocities.end(), velocity) - velocities.begin();
  };
  for_each_second(tree, kin, pair, gap, [&](int i, int l, double value, bool same) {
    phi_qq(index(i), index(l)) += value;
    if (!same) phi_qq(index(l), index(i)) += value;
  });
}

}  // namespace saltus
