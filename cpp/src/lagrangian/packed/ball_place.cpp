#include "lagrangian/packed/ball.hpp"

namespace saltus::packed {
namespace {

/// Of a unit quaternion x y z w.
SALTUS_INLINE M3 rotation(double x, double y, double z, double w) {
  const double xx = 2 * x * x, yy = 2 * y * y, zz = 2 * z * z, xy = 2 * x * y, xz = 2 * x * z;
  const double yz = 2 * y * z, wx = 2 * w * x, wy = 2 * w * y, wz = 2 * w * z;
  return {{1 - yy - zz, xy + wz, xz - wy}, {xy - wz, 1 - xx - zz, yz + wx},
          {xz + wy, yz - wx, 1 - xx - yy}};
}

}  // namespace

SALTUS_CLONES void turn_balls(const PackedTree& t, Packed& w) {
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      const double* q = at(w.ball, s.z) + l;
      store(at(w.R, s.z) + l, 0,
            load9(at(t.X, s.z) + l, 0) * rotation(q[0], q[lanes], q[2 * lanes], q[3 * lanes]));
    });
  }
}

SALTUS_CLONES void set_ball_screws(const PackedTree& t, Packed& w) {
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      const V3 axis = cross(load3(at(w.S_W, s.x) + l, 0), load3(at(w.S_W, s.y) + l, 0));
      store(at(w.S_W, s.z) + l, 0, V6{axis, cross(load3(at(w.p, s.z) + l, 0), axis)});
    });
  }
}

SALTUS_CLONES void set_ball_twists(const PackedTree& t, Packed& w) {
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      const V6 V = load6(at(w.V, s.z) + l, 0);
      double *x = at(w.S_W, s.x) + l, *y = at(w.S_W, s.y) + l;
      store(x, 6, cross_motion(V, load6(x, 0)));
      store(y, 6, cross_motion(V, load6(y, 0)));
    });
  }
}

}  // namespace saltus::packed
