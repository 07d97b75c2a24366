// Walks from a to b: the exact point with two derivatives, without any matrix of a pose.
//
// A joint with displacement x(s) = x0 + s w takes a point p of its own frame to its parent's by
//
//   r = Rz p + h x z,          p_P = X_PJ r        (Rz by x if it turns; h: slide per unit of x)
//   r'  = Rz (p' + w z x p) + h w z
//   r'' = Rz (p'' + 2 w z x p' + w^2 z x (z x p))
//
// A walk up a branch goes by these; a walk down by their inverse, which is the same with x, w and
// the placement reversed.
#include <cmath>

#include "collision/chord_path.hpp"

namespace saltus {
namespace {

struct MovingPoint {
  Vec3 p, v, a;  ///< [m] the point and its first and second derivative by s
};

Vec3 z_cross(const Vec3& x) { return {-x.y(), x.x(), 0}; }

void turn(MovingPoint& P, double angle, double w) {
  const double c = std::cos(angle), n = std::sin(angle);
  const auto Rz = [&](const Vec3& x) {
    return Vec3(c * x.x() - n * x.y(), n * x.x() + c * x.y(), x.z());
  };
  const Vec3 z_x_p = z_cross(P.p);
  P.a = Rz(P.a + 2 * w * z_cross(P.v) + w * w * z_cross(z_x_p));
  P.v = Rz(P.v + w * z_x_p);
  P.p = Rz(P.p);
}

void go_up(const Chord& chord, int joint, double s, MovingPoint& P) {
  const double w = chord.rate(joint), x = chord.start(joint) + s * w;
  const double h = chord.slide_per_unit(joint);
  if (chord.tree.joint[joint].turns()) turn(P, x, w);
  P.p.z() += h * x;
  P.v.z() += h * w;
  const Pose& X_PJ = chord.tree.X_PJ[joint];
  P = {X_PJ * P.p, X_PJ.R * P.v, X_PJ.R * P.a};
}

void go_down(const Chord& chord, int joint, double s, MovingPoint& P) {
  const double w = chord.rate(joint), x = chord.start(joint) + s * w;
  const double h = chord.slide_per_unit(joint);
  const Pose& X_PJ = chord.tree.X_PJ[joint];
  const Mat3 R_JP = X_PJ.R.transpose();
  P = {R_JP * (P.p - X_PJ.p), R_JP * P.v, R_JP * P.a};
  P.p.z() -= h * x;
  P.v.z() -= h * w;
  if (chord.tree.joint[joint].turns()) turn(P, -x, -w);
}

/// A shape's origin in the frame of the common ancestor; `k` runs over its branch, leaf first.
template <class Iterator>
MovingPoint rise(const Chord& chord, const PlacedShape& shape, double sign, double s, Iterator k,
                 Iterator end) {
  MovingPoint P{shape.X_JG.p, Vec3::Zero(), Vec3::Zero()};
  for (; k != end && k->sign == sign; ++k) go_up(chord, k->joint, s, P);
  return P;
}

/// From the frame of the common ancestor to that of shape b.
MovingPoint descend_to_b(const Chord& chord, double s, MovingPoint P) {
  const std::vector<ChainJoint>& chain = chord.pair.chain;
  for (auto k = chain.rbegin(); k != chain.rend(); ++k) {
    if (k->sign < 0) go_down(chord, k->joint, s, P);
  }
  const Pose& X_JB = chord.b().X_JG;
  const Mat3 R_BJ = X_JB.R.transpose();
  return {R_BJ * (P.p - X_JB.p), R_BJ * P.v, R_BJ * P.a};
}

}  // namespace

ChordSample sample_chord(const Chord& chord, double s) {
  const std::vector<ChainJoint>& chain = chord.pair.chain;
  MovingPoint P = rise(chord, chord.a(), +1, s, chain.rbegin(), chain.rend());
  if (chord.b_is_sphere()) {
    const MovingPoint B = rise(chord, chord.b(), -1, s, chain.begin(), chain.end());
    P = {P.p - B.p, P.v - B.v, P.a - B.a};
  } else {
    P = descend_to_b(chord, s, P);
  }
  const Gap g = gap(chord.a().shape, {Mat3::Identity(), P.p}, chord.b().shape, {});
  return {g.phi, g.n_W.dot(P.v), g.n_W.dot(P.a)};
}

}  // namespace saltus
