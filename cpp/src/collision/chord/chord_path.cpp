// Walks from a to b: exact points with two derivatives, without any matrix of a pose.
//
// A joint with displacement x(s) = x0 + s w takes a point p of its own frame to its parent's by
//
//   r = Rz p + h x z,          p_P = X_PJ r        (Rz by x if it turns; h: slide per unit of x)
//   r'  = Rz (p' + w z x p) + h w z
//   r'' = Rz (p'' + 2 w z x p' + w^2 z x (z x p))
//
// A ball turns a point by E R, E = exp(s f) about its axis and R its start, and has f x for w z x.
//
// A walk up a branch goes by these; a walk down by their inverse, which is the same with x, w and
// the placement reversed.
#include <cmath>

#include "collision/chord/chord_path.hpp"
#include "saltus/collision/parts.hpp"

namespace saltus {
namespace {

/// Of parts that go on beyond their ends, what is convex: edges as they are, without sides.
Gap chord_gap(const Chord& chord, const Pose& X_BA) {
  if (chord.pair.kind == PairKind::crossing) return gap(chord.a().shape, X_BA, chord.b().shape, {});
  return part_gap(chord.pair, X_BA, {});
}

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

/// By E = exp(s f), s of the chord.
void turn(MovingPoint& P, const Mat3& E, const Vec3& f) {
  const Vec3 f_x_p = f.cross(P.p);
  P.a = E * (P.a + 2 * f.cross(P.v) + f.cross(f_x_p));
  P.v = E * (P.v + f_x_p);
  P.p = E * P.p;
}

MovingPoint turned(const Mat3& R, const MovingPoint& P) { return {R * P.p, R * P.v, R * P.a}; }

void turn_by_ball(const Chord& chord, int joint, double s, MovingPoint& P) {
  const Vec3 f = chord.turn_of_ball(joint);
  P = turned(chord.start_of_ball(joint), P);
  turn(P, quaternion_exp(s * f).toRotationMatrix(), f);
}

void turn_back_by_ball(const Chord& chord, int joint, double s, MovingPoint& P) {
  const Vec3 f = -chord.turn_of_ball(joint);
  turn(P, quaternion_exp(s * f).toRotationMatrix(), f);
  P = turned(chord.start_of_ball(joint).transpose(), P);
}

bool is_third_of_ball(const Chord& chord, int joint) {
  const Joint& j = chord.tree.joint[joint];
  return j.is_ball() && j.axis == 2;
}

void go_up(const Chord& chord, int joint, double s, MovingPoint& P) {
  if (is_third_of_ball(chord, joint)) turn_by_ball(chord, joint, s, P);
  const bool is_ball = chord.tree.joint[joint].is_ball();
  const double w = chord.rate(joint), x = chord.start(joint) + s * w;
  const double h = chord.slide_per_unit(joint);
  if (chord.tree.joint[joint].turns() && !is_ball) turn(P, x, w);
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
  const bool is_ball = chord.tree.joint[joint].is_ball();
  if (chord.tree.joint[joint].turns() && !is_ball) turn(P, -x, -w);
  if (is_third_of_ball(chord, joint)) turn_back_by_ball(chord, joint, s, P);
}

/// The origin of a shape's frame and the points one along each of its axes.
struct MovingFrame {
  MovingPoint point[4];
  int count;  ///< 1: the origin alone
};

MovingFrame frame_of(const Placed& shape, int count) {
  const Vec3 zero = Vec3::Zero();
  MovingFrame F{{}, count};
  F.point[0] = {shape.X_JG.p, zero, zero};
  for (int k = 1; k < count; ++k) {
    F.point[k] = {shape.X_JG.p + shape.X_JG.R.col(k - 1), zero, zero};
  }
  return F;
}

/// From a shape's joint to the frame of the common ancestor; `k` runs over its branch, leaf first.
template <class Iterator>
void rise(const Chord& chord, double sign, double s, Iterator k, Iterator end, MovingFrame& F) {
  for (; k != end && k->sign == sign; ++k) {
    for (int i = 0; i < F.count; ++i) go_up(chord, k->joint, s, F.point[i]);
  }
}

/// From the frame of the common ancestor to that of shape b.
void descend_to_b(const Chord& chord, double s, MovingFrame& F) {
  const std::vector<ChainJoint>& chain = chord.pair.chain;
  for (auto k = chain.rbegin(); k != chain.rend(); ++k) {
    if (k->sign > 0) continue;
    for (int i = 0; i < F.count; ++i) go_down(chord, k->joint, s, F.point[i]);
  }
  const Pose& X_JB = chord.b().X_JG;
  const Mat3 R_BJ = X_JB.R.transpose();
  for (int i = 0; i < F.count; ++i) {
    MovingPoint& P = F.point[i];
    P = {R_BJ * (P.p - X_JB.p), R_BJ * P.v, R_BJ * P.a};
  }
}

/// The frame of a's part as b sees it.
MovingFrame see_a(const Chord& chord, double s) {
  const std::vector<ChainJoint>& chain = chord.pair.chain;
  // a ball looks the same however it turns, but which face bears a corner is told by its edges
  const bool turns = !chord.a_is_ball() || !chord.pair.inward.empty();
  MovingFrame F = frame_of(chord.a(), turns ? 4 : 1);
  rise(chord, +1, s, chain.rbegin(), chain.rend(), F);
  if (!chord.b_is_sphere()) {
    descend_to_b(chord, s, F);
    return F;
  }
  MovingFrame b = frame_of(chord.b(), 1);
  rise(chord, -1, s, chain.begin(), chain.end(), b);
  const MovingPoint& B = b.point[0];
  for (int i = 0; i < F.count; ++i) {
    MovingPoint& P = F.point[i];
    P = {P.p - B.p, P.v - B.v, P.a - B.a};
  }
  return F;
}

Pose pose_of(const MovingFrame& F) {
  const MovingPoint& o = F.point[0];
  Pose X_BA{Mat3::Identity(), o.p};
  for (int k = 1; k < F.count; ++k) X_BA.R.col(k - 1) = F.point[k].p - o.p;
  return X_BA;
}

}  // namespace

Pose pose_at_start(const Chord& chord) { return pose_of(see_a(chord, 0)); }

ChordSample sample_chord(const Chord& chord, double s) {
  const MovingFrame F = see_a(chord, s);
  const MovingPoint& o = F.point[0];
  const Pose X_BA = pose_of(F);
  const Gap g = chord_gap(chord, X_BA);
  ChordSample out{};
  Heights& h = out.heights;
  const Vec3& n = g.n_W;
  for (Vec3& m : h.m) m.setZero();
  h.c[0] = n.dot(o.p);
  h.c[1] = n.dot(o.v);
  h.c[2] = n.dot(o.a);
  for (int k = 1; k < F.count; ++k) {
    const MovingPoint& P = F.point[k];
    h.m[0][k - 1] = n.dot(P.p - o.p);
    h.m[1][k - 1] = n.dot(P.v - o.v);
    h.m[2][k - 1] = n.dot(P.a - o.a);
  }
  out.phi = g.phi;
  const Vec3 P_A = X_BA.R.transpose() * (g.center_W - o.p);
  out.rate = h.c[1] + h.m[1].dot(P_A);
  return out;
}

}  // namespace saltus
