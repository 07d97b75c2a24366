// The core of shape a as b sees it, along a chord q(s) = q + s dq.
//
// Seen from a frame in which b's solid is at rest: b's own; but where b is a sphere, one that goes
// with its centre and keeps the directions of the joint frame above both branches. So two balls
// that swing side by side are at rest to each other, although both turn.
//
// The three joints of a ball act as one, its third: along the chord it turns from R(q) about one
// axis, that of its three numbers of dq, by their length. The first two are at rest.
#pragma once

#include "saltus/collision/contact.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {

/// What the functions of a chord are about; refers to the caller's data.
struct Chord {
  const Tree& tree;
  const Pair& pair;
  const VecRef& q;
  const VecRef& dq;
  const Placed* part_a = nullptr;  ///< in place of pair.on_a, or pair.on_b
  const Placed* part_b = nullptr;

  const Placed& a() const { return part_a == nullptr ? pair.on_a : *part_a; }
  const Placed& b() const { return part_b == nullptr ? pair.on_b : *part_b; }
  bool b_is_sphere() const { return std::holds_alternative<Sphere>(b().shape); }
  /// A ball's directions do not matter: it is not asked how it turns.
  bool a_is_ball() const {
    return std::holds_alternative<Sphere>(a().shape) && pair.inward.empty();
  }
  /// [rad | m] displacement of a joint at s = 0
  double start(int joint) const { return displacement(tree, joint, q); }
  /// [rad | m] its change over the whole chord
  double rate(int joint) const {
    const Joint& j = tree.joint[joint];
    if (j.is_ball()) return j.axis == 2 ? turn_of_ball(joint).norm() : 0;
    const Drive& drive = tree.drive[joint];
    return drive.multiplier * dq[drive.velocity];
  }
  /// [rad] axis times angle of a ball, in the axes of its placement; `joint` is its third
  Vec3 turn_of_ball(int joint) const { return dq.segment<3>(tree.drive[joint].velocity - 2); }
  /// R of a ball at s = 0; likewise
  Mat3 start_of_ball(int joint) const {
    return quaternion(ball_of(tree, joint), q).toRotationMatrix();
  }
  double slide_per_unit(int joint) const {  ///< motion along the axis per unit of displacement
    const Joint& j = tree.joint[joint];
    return j.kind == Joint::Kind::prismatic ? 1 : j.pitch;  // a ball has none
  }
};

/// n.x for the points x of a's core near one s, where n stays as it is there: x = o + R y with y in
/// a's frame, n.x(s + d) = c[0] + m[0].y + (c[1] + m[1].y) d + (c[2] + m[2].y) d^2/2 + ...
struct Heights {
  double c[3];
  Vec3 m[3];
};

/// The gap at one s.
struct ChordSample {
  double phi;       ///< [m]
  double rate;      ///< [m] phi' = n.P', P the point of a's core on the contact line
  Heights heights;  ///< m = 0 where a is a ball: its core is y = 0
};

/// Of a's part as b's part sees it.
Pose pose_at_start(const Chord& chord);

ChordSample sample_chord(const Chord& chord, double s);

/// Bounds on the motion over the whole chord.
struct ChordBounds {
  double mu;      ///< [m] |phi'| <= mu
  double B;       ///< [m] |x''| <= B for every point x of a's core
  double C;       ///< [m] |x'''| <= C
  double length;  ///< [m] greatest coordinate that the walk from a to b meets
};

/// Writes mu and length; B and C are left 0.
ChordBounds first_bounds(const Chord& chord);

/// Adds B and C to the first bounds; `phi` is the gap at s = 0.
void add_higher_bounds(const Chord& chord, double phi, ChordBounds& bounds);

}  // namespace saltus
