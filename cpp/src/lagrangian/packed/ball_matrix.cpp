// An arc's Newton matrix at balls (theory, O2).
//
//   K = J(f), C = J(f/2), f = tau w      p = p_start
//   Delta = -tau D(f, p) - tau^2/4 D(f/2, L_q) - tau/2 C [L_v]
//
// Rows of the matrix at a ball are multiplied by K, and so are right-hand sides (solve). With a
// ball's columns as 6x3 matrices, W^c = W C and W^r = W C^T, and F, G, S_w likewise, its generators
// are those of packed_matrix.hpp, and its own nine entries t_i.w_j + Delta_ij.
#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/nine.hpp"

namespace saltus::packed {
namespace {

/// J(f) from its coefficients b, c. Sums with zeros are spelled out here and below: they cannot be
/// left out by a compiler that keeps the sign of zero.
SALTUS_INLINE M3 jacobian(V3 f, const double* k) {
  const V3 bf = k[0] * f, cf = k[lanes] * f;
  const double d = 1 - dot(cf, f), xy = cf.x * f.y, xz = cf.x * f.z, yz = cf.y * f.z;
  return {{d + cf.x * f.x, xy + bf.z, xz - bf.y},
          {xy - bf.z, d + cf.y * f.y, yz + bf.x},
          {xz + bf.y, yz - bf.x, d + cf.z * f.z}};
}

/// D(f, x) = u f^T - [m] + d 1.
struct JacobianDerivative {
  V3 u, m;
  double d;
};
SALTUS_INLINE JacobianDerivative jacobian_derivative(V3 f, V3 x, const double* k) {
  const double b = k[0], c = k[lanes], b1 = k[2 * lanes], c1 = k[3 * lanes];
  const V3 f_x = cross(f, x);
  return {b1 * f_x + c1 * cross(f, f_x) - c * x, b * x + c * f_x, c * dot(f, x)};
}

/// Columns of a ball, A = (x y z).
struct Columns {
  V6 x, y, z;
  SALTUS_INLINE V6 along(V3 m) const { return m.x * x + m.y * y + m.z * z; }
};
SALTUS_INLINE Columns load_columns(const double* x, const double* y, const double* z, int c) {
  return {load6(x, c), load6(y, c), load6(z, c)};
}
SALTUS_INLINE M3 load_columns3(const double* x, const double* y, const double* z, int c) {
  return {load3(x, c), load3(y, c), load3(z, c)};
}

SALTUS_INLINE void set_coefficients(const PackedGroup& g, const Packed& w, double tau,
                                    PackedMatrix& J) {
  const auto by_series = [&](int z, int l, double x) SALTUS_INLINE_LAMBDA {
    using namespace turn_series;
    double* to = at(J.ball_k, z) + l;
    for (const double y : {x, x / 4}) {
      to[0] = sum(turn_series::b, y);
      to[lanes] = sum(c, y);
      to[2 * lanes] = sum(b1, y);
      to[3 * lanes] = sum(c1, y);
      to += 4 * lanes;
    }
  };
  for_each_turn(g, w, tau, by_series, [&](int z, const Vec3& f) {
    double* to = at(J.ball_k, z);
    for (const JacobianCoefficients& k : {jacobian_coefficients(f), jacobian_coefficients(f / 2)}) {
      to[0] = k.b;
      to[lanes] = k.c;
      to[2 * lanes] = k.b1;
      to[3 * lanes] = k.c1;
      to += 4 * lanes;
    }
  });
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
  const JacobianDerivative whole = jacobian_derivative(f, p_start, k);
  const JacobianDerivative middle = jacobian_derivative(f_half, L_q, k + 4 * lanes);
  const V3 u = -tau * whole.u - quarter / 2 * middle.u, m = tau * whole.m + quarter * middle.m;
  const double d = -tau * whole.d - quarter * middle.d;
  const V3 L = half * L_v;  // columns of C [L] are those of C, crossed
  store(to, 18, f.x * u + V3{d, m.z, -m.y} - (L.z * C.y - L.y * C.z));
  store(to, 21, f.y * u + V3{-m.z, d, m.x} - (L.x * C.z - L.z * C.x));
  store(to, 24, f.z * u + V3{m.y, -m.x, d} - (L.y * C.x - L.x * C.y));
}

/// S_i + (A M)_i and S_i - (A M^T)_i, and the last three numbers of the generators.
SALTUS_INLINE void put(const double* from, V6 plus, V6 minus, V3 plus_last, V3 minus_last,
                       double* to) {
  const V6 S = load6(from, 0);
  store(to, 0, S + plus);
  store(to, 6, plus_last);
  store(to, 9, S - minus);
  store(to, 15, minus_last);
}

SALTUS_INLINE void set_generators(const BallSlots& s, int l, const Packed& w, double tau,
                                  PackedMatrix& J) {
  const M3 C = load9(at(J.ball, s.z) + l, 9), half_C = tau / 2 * C, half_CT = transpose(half_C);
  const M3 quarter_CT = -tau / 2 * half_CT;
  const double *x = at(w.S_W, s.x) + l, *y = at(w.S_W, s.y) + l, *z = at(w.S_W, s.z) + l;
  const Columns W = load_columns(x, y, z, 6);
  const M3 S_w = load_columns3(x, y, z, 0);
  double *st_x = at(J.s_t, s.x) + l, *st_y = at(J.s_t, s.y) + l, *st_z = at(J.s_t, s.z) + l;
  put(x, W.along(half_C.x), W.along(half_CT.x), S_w * C.x, S_w * quarter_CT.x, st_x);
  put(y, W.along(half_C.y), W.along(half_CT.y), S_w * C.y, S_w * quarter_CT.y, st_y);
  put(z, W.along(half_C.z), W.along(half_CT.z), S_w * C.z, S_w * quarter_CT.z, st_z);

  // u is of the minus, w of the plus
  const double *ux = at(w.U_F_G, s.x) + l, *uy = at(w.U_F_G, s.y) + l, *uz = at(w.U_F_G, s.z) + l;
  const Columns F = load_columns(ux, uy, uz, 6);
  const M3 G = load_columns3(ux, uy, uz, 12);
  double *uw_x = at(J.u_w, s.x) + l, *uw_y = at(J.u_w, s.y) + l, *uw_z = at(J.u_w, s.z) + l;
  const auto put_u_w = [&](const double* U, V3 c, V3 r, V3 G_c, V3 G_r, double* to)
                           SALTUS_INLINE_LAMBDA {
                             const V6 each = load6(U, 0);
                             store(to, 0, each - F.along(r));
                             store(to, 6, G_r);
                             store(to, 9, each + F.along(c));
                             store(to, 15, G_c);
                           };
  put_u_w(ux, half_C.x, half_CT.x, G * C.x, G * quarter_CT.x, uw_x);
  put_u_w(uy, half_C.y, half_CT.y, G * C.y, G * quarter_CT.y, uw_y);
  put_u_w(uz, half_C.z, half_CT.z, G * C.z, G * quarter_CT.z, uw_z);
}

/// Of one tree, where the three joints lie side by side in a block with a fourth lane after them:
/// the same by rows, a row of all three at a time.
SALTUS_INLINE bool lies_in_rows(const PackedGroup& g, int first) {
  return g.width == 1 && static_cast<unsigned>(first) % lanes + 3 < lanes;
}

struct Rows {
  Four x, y, z;
  /// x m.x + y m.y + z m.z of the three numbers of a row.
  SALTUS_INLINE Four along(const double* m) const { return m[0] * x + m[1] * y + m[2] * z; }
};
SALTUS_INLINE Rows operator*(double k, const Rows& A) { return {k * A.x, k * A.y, k * A.z}; }
SALTUS_INLINE void save3(Four from, double* x) { std::memcpy(x, &from, 3 * sizeof(double)); }

/// From A (6 rows of S or U), B (of W or F) and D (3 rows of S_w or G): A + half B C, D C to
/// `plus`, and A - half B C^T, -quarter D C^T to `minus`.
SALTUS_INLINE void put_rows(const double* A, const double* B, const double* D, const Rows& C,
                            const Rows& CT, double half, double* plus, double* minus) {
  const Rows half_C = half * C, half_CT = half * CT, quarter_CT = (-half * half) * CT;
  for (int r = 0; r < 6; ++r) {
    const Four a = load4(A + r * lanes);
    save3(a + half_C.along(B + r * lanes), plus + r * lanes);
    save3(a - half_CT.along(B + r * lanes), minus + r * lanes);
  }
  for (int r = 0; r < 3; ++r) {
    save3(C.along(D + r * lanes), plus + (6 + r) * lanes);
    save3(quarter_CT.along(D + r * lanes), minus + (6 + r) * lanes);
  }
}

SALTUS_INLINE void set_generators_by_rows(const BallSlots& s, const Packed& w, double tau,
                                          PackedMatrix& J) {
  const double* c = at(J.ball, s.z) + 9 * lanes;
  const auto number = [c](int i) { return c[i * lanes]; };
  const Rows CT{{number(0), number(1), number(2), 0},
                {number(3), number(4), number(5), 0},
                {number(6), number(7), number(8), 0}};
  const Rows C{{number(0), number(3), number(6), 0},
               {number(1), number(4), number(7), 0},
               {number(2), number(5), number(8), 0}};
  const double *S_W = at(w.S_W, s.x), *U_F_G = at(w.U_F_G, s.x);
  double *s_t = at(J.s_t, s.x), *u_w = at(J.u_w, s.x);
  put_rows(S_W, S_W + 6 * lanes, S_W, C, CT, tau / 2, s_t, s_t + 9 * lanes);
  put_rows(U_F_G, U_F_G + 6 * lanes, U_F_G + 12 * lanes, C, CT, tau / 2, u_w + 9 * lanes, u_w);
}

/// t_i.w_j, i and j joints of one ball.
SALTUS_INLINE double product(const double* s_t, const double* u_w) {
  return dot(load6(s_t, 9), load6(u_w, 9)) + dot(load3(s_t, 15), load3(u_w, 15));
}

}  // namespace

SALTUS_CLONES void set_ball_generators(const PackedTree& t, const Packed& w, double tau,
                                       PackedMatrix& J) {
  for (const PackedGroup& g : t.groups) {
    set_coefficients(g, w, tau, J);
    for_each_ball(
        g, [&](const BallSlots& s, int l) SALTUS_INLINE_LAMBDA { set_matrices(s, l, w, tau, J); });
    for (const int k : g.balls) {
      const BallSlots first{g.slot(k), g.slot(k + 1), g.slot(k + 2)};
      if (lies_in_rows(g, first.x)) {
        set_generators_by_rows(first, w, tau, J);
        continue;
      }
      for (int b = 0; b < g.width; b += lanes) {
        const int last = g.width == 1 ? 1 : lanes;
        const BallSlots s{first.x + b, first.y + b, first.z + b};
        SALTUS_LANES
        for (int l = 0; l < last; ++l) set_generators(s, l, w, tau, J);
      }
    }
  }
}

// The rows of J have t_i.w_j already where i is above j or j itself, which lacks Delta_ij alone.
SALTUS_CLONES void set_ball_entries(const PackedGroup& g, PackedMatrix& J) {
  const int last = g.width == 1 ? 1 : lanes;
  for (const int k : g.balls) {
    for (int b = 0; b < g.width; b += lanes) {
      const double* Delta = at(J.ball, g.slot(k + 2) + b) + 18 * lanes;
      for (int i = 0; i < 3; ++i) {
        const int column_i = (g.level[k] + i) * g.width + b;
        const double* s_t = at(J.s_t, g.slot(k + i) + b);
        double *lower = J.lower[g.row[k + i]].x[0], *upper = J.upper[g.row[k + i]].x[0] + column_i;
        for (int j = 0; j < i; ++j) {
          const double* u_w = at(J.u_w, g.slot(k + j) + b);
          const int column_j = (g.level[k] + j) * g.width + b;
          double *J_ij = lower + column_j, *J_ji = J.upper[g.row[k + i]].x[0] + column_j;
          SALTUS_LANES
          for (int l = 0; l < last; ++l) {
            J_ij[l] = product(s_t + l, u_w + l) + Delta[(3 * j + i) * lanes + l];
            J_ji[l] += Delta[(3 * i + j) * lanes + l];
          }
        }
        SALTUS_LANES
        for (int l = 0; l < last; ++l) {
          upper[l] += Delta[4 * i * lanes + l];
          lower[column_i + l] = upper[l];
        }
      }
    }
  }
}

}  // namespace saltus::packed
