#include "saltus/collision/slip.hpp"

#include <array>
#include <cmath>

#include "saltus/collision/gap_motion.hpp"

namespace saltus {
namespace {

void add(double factor, const Screw& screw, Screw& sum) {
  sum.w += factor * screw.w;
  sum.xi += factor * screw.xi;
}

double rate_of(const Tree& tree, const ChainJoint& k, const VecRef& v) {
  const Drive& drive = tree.drive[k.joint];
  return k.sign * drive.multiplier * v[drive.velocity];
}

/// What a number is of a screw at P: w . screw.w + xi . screw.xi.
struct OfScrew {
  Vec3 w, xi;
};

double dot(const OfScrew& x, const Screw& screw) { return x.w.dot(screw.w) + x.xi.dot(screw.xi); }

/// A contact whose bodies move.
struct Slipping {
  const Gap& gap;
  GapMotion motion;
  Tangents t;
  int axis;
  Vec3 P;
  Screw all;  ///< what the joints do together, at P
};

/// What (W x P').t + t'.U is of dP and dn: dn.of_n + dP.of_P.
struct OfMotion {
  Vec3 of_n, of_P;
};

/// By the normal that t0, t1 are tangents of, `turned` read backwards.
std::array<OfMotion, 2> of_motion(const Slipping& s) {
  const Vec3& n = s.gap.n_W;
  const Vec3& x = s.all.xi;
  const double size = (Vec3::Unit(s.axis) - n[s.axis] * n).norm();
  const auto of_t1 = [&](const Vec3& along) -> Vec3 {
    const Vec3 y = (along - s.t.t1 * s.t.t1.dot(along)) / size;
    return -y.dot(n) * Vec3::Unit(s.axis) - n[s.axis] * y;
  };
  return {OfMotion{of_t1(n.cross(x)) + x.cross(s.t.t1), s.t.t0.cross(s.all.w)},
          OfMotion{of_t1(x), s.t.t1.cross(s.all.w)}};
}

/// Of what a joint that moves a (sign 1), or b and all with it (-1), does by itself.
OfScrew of_joint(const Slipping& s, const OfMotion& of, int sign) {
  const Vec6 by = s.motion.n.transpose() * of.of_n +
                  (s.motion.p_WA + s.motion.p_WB).transpose() * (of.of_P / 2);
  const Vec3 xi = by.tail<3>(), w = by.head<3>() + (s.gap.center_W - s.P).cross(xi);
  if (sign > 0) return {w, xi};
  return {s.gap.n_W.cross(of.of_n) - w, of.of_P - xi};
}

/// By joint j: of t.U, with what the joints below j do, those of its own ball aside.
double slip_change(const Vec3& t, const OfScrew& of, const Screw& j, const Screw& below) {
  return dot(of, j) + j.w.dot(below.xi.cross(t)) - j.xi.dot(t.cross(below.w));
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

Screw relative_motion(const Tree& tree, const Kinematics& kin, const Pair& pair, const Vec3& P_W,
                      const VecRef& v) {
  Screw sum;
  for (const ChainJoint& k : pair.chain) {
    add(rate_of(tree, k, v), screw_at(tree, kin, k.joint, P_W), sum);
  }
  return sum;
}

void add_slip_change(const Tree& tree, const Kinematics& kin, const Pair& pair, const Gap& gap,
                     int axis, const VecRef& v, double factor, Eigen::Ref<VecX> c0,
                     Eigen::Ref<VecX> c1) {
  const Vec3 P = contact_point(gap);
  const Screw all = relative_motion(tree, kin, pair, P, v);
  const Slipping s{gap, gap_motion(gap), tangents(gap.n_W, axis), axis, P, all};
  const std::array<OfMotion, 2> of = of_motion(s);
  const int count = static_cast<int>(pair.chain.size());
  // The chain goes up from b and then down to a: those below j are before it, and behind it.
  const auto walk = [&](int sign, int from, int step) {
    if (from < 0 || from >= count || pair.chain[from].sign != sign) return;
    const OfScrew of_t0 = of_joint(s, of[0], sign), of_t1 = of_joint(s, of[1], sign);
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
      const double part = factor * drive.multiplier;
      c0[drive.velocity] += part * slip_change(s.t.t0, of_t0, j, below);
      c1[drive.velocity] += part * slip_change(s.t.t1, of_t1, j, below);
      add(rate_of(tree, joint, v), j, ball);
    }
  };
  walk(-1, 0, 1);
  walk(+1, count - 1, -1);
}

}  // namespace saltus
