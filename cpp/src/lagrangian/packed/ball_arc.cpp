// An arc's momenta and Newton matrix at balls (theory, O2).
//
//   K = J(f), C = J(f/2), f = tau w      p = p_start
//   Delta = -tau D(f, p) - tau^2/4 D(f/2, L_q) - tau/2 C [L_v]
//
// Rows of the matrix at a ball are multiplied by K, and so are right-hand sides (solve). With a
// ball's columns as 6x3 matrices, W^c = W C and W^r = W C^T, and F, G, S_w likewise, its generators
// are those of packed_matrix.hpp, and its own nine entries t_i.w_j + Delta_ij.
#include "lagrangian/packed/ball.hpp"

namespace saltus::packed {
namespace {

/// J(f) and D(f, x) from their coefficients b, c, b', c'.
SALTUS_INLINE M3 jacobian(V3 f, const double* k) {
  const double b = k[0], c = k[lanes];
  return scalar_matrix(1 - c * dot(f, f)) + b * cross_matrix(f) + c * outer(f, f);
}
SALTUS_INLINE M3 jacobian_derivative(V3 f, V3 x, const double* k) {
  const double b = k[0], c = k[lanes], b1 = k[2 * lanes], c1 = k[3 * lanes];
  const V3 f_x = cross(f, x);
  return scalar_matrix(c * dot(f, x)) + outer(b1 * f_x + c1 * cross(f, f_x), f) -
         cross_matrix(b * x + c * f_x) - c * outer(x, f);
}

/// Columns of a ball, A = (x y z), times a matrix: A M.
struct Columns {
  V6 x, y, z;
  SALTUS_INLINE Columns operator*(const M3& M) const { return {along(M.x), along(M.y), along(M.z)}; }
  SALTUS_INLINE V6 along(V3 m) const { return m.x * x + m.y * y + m.z * z; }
};
SALTUS_INLINE Columns load_columns(const double* x, const double* y, const double* z, int c) {
  return {load6(x, c), load6(y, c), load6(z, c)};
}
SALTUS_INLINE M3 load_columns3(const double* x, const double* y, const double* z, int c) {
  return {load3(x, c), load3(y, c), load3(z, c)};
}

SALTUS_INLINE void set_coefficients(const PackedTree& t, const Packed& w, double tau,
                                    PackedMatrix& J) {
  for (const PackedBall& ball : t.balls) {
    const Vec3 f = tau * Vec3(*at(w.s_dot, ball.slot[0]), *at(w.s_dot, ball.slot[1]),
                              *at(w.s_dot, ball.slot[2]));
    double* to = at(J.ball_k, ball.slot[2]);
    const JacobianCoefficients whole = jacobian_coefficients(f), half = jacobian_coefficients(f / 2);
    const double all[] = {whole.b, whole.c, whole.b1, whole.c1, half.b, half.c, half.b1, half.c1};
    for (int c = 0; c < 8; ++c) to[c * lanes] = all[c];
  }
}

/// K, C, Delta.
SALTUS_INLINE void set_matrices(const BallSlots& s, int l, const Packed& w, double tau,
                                PackedMatrix& J) {
  const double half = tau / 2, quarter = tau * tau / 4;
  const double *x = at(w.first, s.x) + l, *y = at(w.first, s.y) + l, *z = at(w.first, s.z) + l;
  const double *ax = at(w.arc, s.x) + l, *ay = at(w.arc, s.y) + l, *az = at(w.arc, s.z) + l;
  const V3 omega = load_ball(at(w.s_dot, s.x) + l, at(w.s_dot, s.y) + l, at(w.s_dot, s.z) + l);
  const V3 f = tau * omega, f_half = half * omega;
  const V3 L_v = load_ball(x, y, z), L_q = load_ball(x + lanes, y + lanes, z + lanes);
  const V3 p_start = load_ball(ax, ay, az) - half * load_ball(ax + lanes, ay + lanes, az + lanes);
  const double* k = at(J.ball_k, s.z) + l;
  double* to = at(J.ball, s.z) + l;
  const M3 C = jacobian(f_half, k + 4 * lanes);
  store(to, 0, jacobian(f, k));
  store(to, 9, C);
  store(to, 18,
        -tau * jacobian_derivative(f, p_start, k) -
            quarter * jacobian_derivative(f_half, L_q, k + 4 * lanes) -
            half * (C * cross_matrix(L_v)));
}

SALTUS_INLINE void set_generators(const BallSlots& s, int l, const Packed& w, double tau,
                                  PackedMatrix& J) {
  const double half = tau / 2, quarter = -tau * tau / 4;
  const M3 C = load9(at(J.ball, s.z) + l, 9), CT = transpose(C);
  const double *x = at(w.S_W, s.x) + l, *y = at(w.S_W, s.y) + l, *z = at(w.S_W, s.z) + l;
  const Columns W = load_columns(x, y, z, 6), W_c = W * C, W_r = W * CT;
  const M3 S_w = load_columns3(x, y, z, 0), S_c = S_w * C, S_r = S_w * CT;
  const auto put_s_t = [&](int slot, const double* S, V6 Wc, V6 Wr, V3 Sc, V3 Sr) SALTUS_INLINE_LAMBDA {
    double* to = at(J.s_t, slot) + l;
    store(to, 0, load6(S, 0) + half * Wc);
    store(to, 6, Sc);
    store(to, 9, load6(S, 0) - half * Wr);
    store(to, 15, quarter * Sr);
  };
  put_s_t(s.x, x, W_c.x, W_r.x, S_c.x, S_r.x);
  put_s_t(s.y, y, W_c.y, W_r.y, S_c.y, S_r.y);
  put_s_t(s.z, z, W_c.z, W_r.z, S_c.z, S_r.z);

  const double *ux = at(w.U_F_G, s.x) + l, *uy = at(w.U_F_G, s.y) + l, *uz = at(w.U_F_G, s.z) + l;
  const Columns F = load_columns(ux, uy, uz, 6), F_c = F * C, F_r = F * CT;
  const M3 G = load_columns3(ux, uy, uz, 12), G_c = G * C, G_r = G * CT;
  const auto put_u_w = [&](int slot, const double* U, V6 Fc, V6 Fr, V3 Gc, V3 Gr) SALTUS_INLINE_LAMBDA {
    double* to = at(J.u_w, slot) + l;
    store(to, 0, load6(U, 0) - half * Fr);
    store(to, 6, quarter * Gr);
    store(to, 9, load6(U, 0) + half * Fc);
    store(to, 15, Gc);
  };
  put_u_w(s.x, ux, F_c.x, F_r.x, G_c.x, G_r.x);
  put_u_w(s.y, uy, F_c.y, F_r.y, G_c.y, G_r.y);
  put_u_w(s.z, uz, F_c.z, F_r.z, G_c.z, G_r.z);
}

/// t_i.w_j, i and j joints of one ball.
SALTUS_INLINE double product(const double* s_t, const double* u_w) {
  return dot(load6(s_t, 9), load6(u_w, 9)) + dot(load3(s_t, 15), load3(u_w, 15));
}

}  // namespace

SALTUS_CLONES void correct_momenta(const PackedTree& t, double tau, Packed& w) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (const PackedBall& ball : t.balls) {
    const Vec3 f = tau * Vec3(*at(w.s_dot, ball.slot[0]), *at(w.s_dot, ball.slot[1]),
                              *at(w.s_dot, ball.slot[2]));
    const ArcCoefficients k = arc_coefficients(f);
    double* to = at(w.ball_arc, ball.slot[2]);
    to[0] = k.c1;
    to[lanes] = k.c2;
  }
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      const double *S_x = at(w.S_W, s.x) + l, *S_y = at(w.S_W, s.y) + l, *S_z = at(w.S_W, s.z) + l;
      const double *s_x = at(w.s_dot, s.x) + l, *I_h = at(w.I_h, s.x) + l;
      const double m = *(at(t.weight, s.x) + l);
      const V3 omega = load_ball(s_x, at(w.s_dot, s.y) + l, at(w.s_dot, s.z) + l), f = tau * omega;
      const V6 H = load6(at(w.H, s.x) + l, 0);
      const V6 up = load6(at(w.V, s.x) + l, 0) - *s_x * load6(S_x, 0);  // V of what is above
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

SALTUS_CLONES void set_ball_generators(const PackedTree& t, const Packed& w, double tau,
                                       PackedMatrix& J) {
  set_coefficients(t, w, tau, J);
  for (const PackedGroup& g : t.groups) {
    for_each_ball(g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA {
      set_matrices(s, l, w, tau, J);
      set_generators(s, l, w, tau, J);
    });
  }
}

// Rows of J by depth: entry (row, level) of lane l of a group.
void set_ball_entries(const PackedGroup& g, PackedMatrix& J) {
  const auto entry = [&](PackedRows& rows, int row, int level, int lane) -> double& {
    const long at = g.row[row] * lanes + level * g.width + lane;
    return rows[static_cast<std::size_t>(at / lanes)].x[0][at % lanes];
  };
  for (const int k : g.balls) {
    for (int lane = 0; lane < g.trees; ++lane) {
      const double* Delta = at(J.ball, g.slot(k + 2) + lane) + 18 * lanes;
      for (int i = 0; i < 3; ++i) {
        const double* s_t = at(J.s_t, g.slot(k + i) + lane);
        for (int j = 0; j < 3; ++j) {
          const double* u_w = at(J.u_w, g.slot(k + j) + lane);
          const double J_ij = product(s_t, u_w) + Delta[(3 * j + i) * lanes];
          if (i <= j) entry(J.upper, k + j, g.level[k + i], lane) = J_ij;
          if (i >= j) entry(J.lower, k + i, g.level[k + j], lane) = J_ij;
        }
      }
    }
  }
}

}  // namespace saltus::packed
