#include "saltus/collision/slip.hpp"

#include <cmath>

#include "saltus/collision/gap_motion.hpp"

namespace saltus {
namespace {

void add(double factor, const Screw& screw, Screw& sum) {
  sum.w += factor * screw.w;
  sum.xi += factor * screw.xi;
}

/// A contact whose bodies move: what the joints do together, at P.
struct Slipping {
  const Gap& gap;
  Tangents t;
  int axis;
  Vec3 P;
  Eigen::Matrix<double, 3, 6> n_t, P_t;  ///< what a twist of a makes of n and P
  Screw all;
};

/// By joint j: of t0.U and t1.U.
/// @param below what the joints below j do, those of its own ball aside
Eigen::Vector2d slip_change(const Slipping& s, const Screw& j, int sign, const Screw& below) {
  Vec6 t;
  t << sign * j.w, sign * (j.xi + j.w.cross(s.gap.center_W - s.P));
  Vec3 dn = s.n_t * t, dP = s.P_t * t;
  if (sign < 0) {  // b moves, and all with it
    dn += j.w.cross(s.gap.n_W);
    dP += j.xi;
  }
  const Tangents d = turned(s.t, s.gap.n_W, s.axis, dn);
  const Vec3 turn = s.all.w.cross(dP) + j.w.cross(below.xi) - below.w.cross(j.xi);
  return {d.t0.dot(s.all.xi) + s.t.t0.dot(turn), d.t1.dot(s.all.xi) + s.t.t1.dot(turn)};
}

}  // namespace

int tangent_axis(const Vec3& n_W) {
  constexpr double equal = 1e-6;  // rounding of a normal along an axis must not turn its tangents
  int axis = 1;                   // y: scenes in the plane are most often in x and z
  for (const int k : {2, 0}) {
    if (std::abs(n_W[k]) < std::abs(n_W[axis]) - equal) axis = k;
  }
  return axis;
}

Tangents tangents(const Vec3& n_W, int axis) {
  const Vec3 e = Vec3::Unit(axis);
  const Vec3 t1 = (e - n_W[axis] * n_W).normalized();
  return {t1.cross(n_W), t1};
}

Tangents turned(const Tangents& t, const Vec3& n, int axis, const Vec3& dn) {
  const Vec3 raw = Vec3::Unit(axis) - n[axis] * n, draw = -dn[axis] * n - n[axis] * dn;
  const Vec3 d1 = (draw - t.t1 * t.t1.dot(draw)) / raw.norm();
  return {d1.cross(n) + t.t1.cross(dn), d1};
}

Screw screw_at(const Tree& tree, const Kinematics& kin, int joint, const Vec3& P_W) {
  const Vec6& S = kin.joint[joint].S;
  const Vec3 P = P_W - kin.origin[tree.root[joint]];
  return {angular(S), angular(S).cross(P) + linear(S)};
}

void add_motion_gradient(const Tree& tree, const Kinematics& kin, const Pair& pair, const Vec3& P_W,
                         const Vec3& d_W, Eigen::Ref<VecX> row) {
  for (const ChainJoint& k : pair.chain) {
    const Drive& drive = tree.drive[k.joint];
    const Vec6& S = kin.joint[k.joint].S;
    const Vec3 P = P_W - kin.origin[tree.root[k.joint]];
    const Vec3 velocity = k.sign * (angular(S).cross(P) + linear(S));
    row[drive.velocity] += drive.multiplier * d_W.dot(velocity);
  }
}

void add_slip_change(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap,
                     int axis, const VecRef& v, double factor, Eigen::Ref<VecX> c0,
                     Eigen::Ref<VecX> c1) {
  const GapMotion motion = gap_motion(gap);
  Slipping s{gap,      tangents(gap.n_W, axis),         axis, contact_point(gap),
             motion.n, (motion.p_WA + motion.p_WB) / 2, {}};
  const auto rate = [&](const ChainJoint& k) {
    const Drive& drive = tree.drive[k.joint];
    return k.sign * drive.multiplier * v[drive.velocity];
  };
  for (const ChainJoint& k : pair.chain) add(rate(k), screw_at(tree, kin, k.joint, s.P), s.all);
  const int count = static_cast<int>(pair.chain.size());
  // The chain goes up from b and then down to a: those below j are before it, and behind it.
  const auto walk = [&](int sign, int from, int step) {
    Screw below, ball;  // of the ball that j may be a part of, those below it
    for (int i = from; i >= 0 && i < count && pair.chain[i].sign == sign; i += step) {
      const ChainJoint& joint = pair.chain[i];
      const int before = i - step;
      const bool has_ball = before >= 0 && before < count && pair.chain[before].sign == sign &&
                            are_of_one_ball(tree, joint.joint, pair.chain[before].joint);
      if (!has_ball) {
        add(1, ball, below);
        ball = {};
      }
      const Screw j = screw_at(tree, kin, joint.joint, s.P);
      const Drive& drive = tree.drive[joint.joint];
      const Eigen::Vector2d change = factor * drive.multiplier * slip_change(s, j, sign, below);
      c0[drive.velocity] += change[0];
      c1[drive.velocity] += change[1];
      add(rate(joint), j, ball);
    }
  };
  walk(-1, 0, 1);
  walk(+1, count - 1, -1);
}

}  // namespace saltus
