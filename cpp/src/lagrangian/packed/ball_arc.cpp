// An arc's momenta at balls: L_v' and L_q' of packed.hpp (theory, O2).
#include "lagrangian/packed/ball.hpp"

namespace saltus::packed {
namespace {

SALTUS_INLINE void set_arc_coefficients(const PackedGroup& g, double tau, Packed& w) {
  const auto by_series = [&](int z, int l, double x) SALTUS_INLINE_LAMBDA {
    double* to = at(w.ball_arc, z) + l;
    to[0] = turn_series::sum(turn_series::arc1, x);
    to[lanes] = turn_series::sum(turn_series::arc2, x);
  };
  for_each_turn(g, w, tau, by_series, [&](int z, const Vec3& f) {
    const ArcCoefficients k = arc_coefficients(f);
    at(w.ball_arc, z)[0] = k.c1;
    at(w.ball_arc, z)[lanes] = k.c2;
  });
}

}  // namespace

SALTUS_CLONES void correct_momenta(const PackedTree& t, double tau, Packed& w) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (const PackedGroup& g : t.groups) set_arc_coefficients(g, tau, w);
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      const double *S_x = at(w.S_W, s.x) + l, *S_y = at(w.S_W, s.y) + l, *S_z = at(w.S_W, s.z) + l;
      const double *s_x = at(w.s_dot, s.x) + l, *I_h = at(w.I_h, s.x) + l;
      const double m = *(at(t.weight, s.x) + l);
      const V3 omega = load_ball(s_x, at(w.s_dot, s.y) + l, at(w.s_dot, s.z) + l), f = tau * omega;
      const V6 H = load6(at(w.H, s.x) + l, 0);
      // V of what is above, without a rounding error where that is nothing
      const V6 V = load6(at(w.V, s.x) + l, 0), S = load6(S_x, 0);
      const V6 up{V.w - rounded_product(*s_x, S.w), V.v - rounded_product(*s_x, S.v)};
      // L_q' = W'.H + S.g with W' = up x S, that is S.(g - up x* H); less up.v x m up.v, which is
      // nothing: a body that flies feels no torque, to the last bit
      const V3 carried = rounded_product(m, up.v);
      const V6 torque{cross(load3(I_h, 6), gravity) - cross(up.w, H.w) - cross(up.v, H.v - carried),
                      m * gravity - cross(up.w, H.v)};
      const V3 L_q{dot(load6(S_x, 0), torque), dot(load6(S_y, 0), torque),
                   dot(load6(S_z, 0), torque)};
      double *x = at(w.arc, s.x) + l, *y = at(w.arc, s.y) + l, *z = at(w.arc, s.z) + l;
      const double* k = at(w.ball_arc, s.z) + l;
      V3 L_v = load_ball(x, y, z);
      L_v = L_v - k[0] * cross(f, cross(f, L_v)) + tau / 2 * k[lanes] * cross(f, L_q);
      x[0] = L_v.x;
      y[0] = L_v.y;
      z[0] = L_v.z;
      x[lanes] = L_q.x;
      y[lanes] = L_q.y;
      z[lanes] = L_q.z;
    });
  }
}

}  // namespace saltus::packed
