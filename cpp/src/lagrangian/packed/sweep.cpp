// The O(n) recursion for deep trees (packed_matrix.hpp has the formulas).
//
// Rows of nine numbers are padded to twelve, three wide registers; P and its transpose are carried
// side by side, so that both P s and t^T P are sums of rows.
//
// A ball's three joints are eliminated at once, with a 3x3 pivot:
//
//   gain = P s + w (9x3)   row = t^T P + u^T (3x9)   D = t^T gain + Delta
//   P_parent += P - gain D^-1 row      c_parent += c + gain D^-1 e      x = D^-1 (e - row a)
//
// gain and D^-1 row are kept in the slots of the three. At tau = 0 they are as any other joints.
#include <Eigen/LU>

#include "lagrangian/packed/matrix.hpp"
#include "lagrangian/packed/nine.hpp"

namespace saltus::packed {
namespace {

using Carried = PackedMatrix::Carried;

SALTUS_INLINE Nine load(const PackedMatrix::Nine& from) {
  return {load4(from.x), load4(from.x + 4), load4(from.x + 8)};
}
SALTUS_INLINE void save(const Nine& from, PackedMatrix::Nine& to) {
  save4(from.a, to.x);
  save4(from.b, to.x + 4);
  save4(from.c, to.x + 8);
}

/// to <- sum + weight^T rows, N of them. Two sums, so that additions need not wait for each other.
template <int N>
SALTUS_INLINE Nine combine(const Nine& sum, const double* weight, const PackedMatrix::Nine* rows) {
  Nine even = sum, odd = zero();
#pragma GCC unroll 9
  for (int r = 0; r < N; ++r) add(weight[r], load(rows[r]), r % 2 ? odd : even);
  add(1, odd, even);
  return even;
}

/// carried <- carried + sum, or sum alone.
template <int N>
SALTUS_INLINE void add_branch(const Carried& sum, bool loaded, Carried& carried) {
  for (int r = 0; r < N; ++r) {
    Nine P = load(sum.P[r]), PT = load(sum.PT[r]);
    if (loaded) {
      add(1, load(carried.P[r]), P);
      add(1, load(carried.PT[r]), PT);
    }
    save(P, carried.P[r]);
    save(PT, carried.PT[r]);
  }
}

/// carried <- carried - gain row / D; of a leaf, whose P is zero, -gain row / D.
template <int N>
SALTUS_INLINE void reduce(const PackedMatrix::Nine& gain, const PackedMatrix::Nine& row,
                          double inverse, bool loaded, Carried& carried) {
  const Nine wide_gain = load(gain), wide_row = load(row);
#pragma GCC unroll 9
  for (int r = 0; r < N; ++r) {
    Nine P = zero(), PT = zero();
    if (loaded) {
      P = load(carried.P[r]);
      PT = load(carried.PT[r]);
    }
    add(-gain.x[r] * inverse, wide_row, P);
    add(-row.x[r] * inverse, wide_gain, PT);
    save(P, carried.P[r]);
    save(PT, carried.PT[r]);
  }
}

/// gain, row and the pivot of one joint.
template <int N>
SALTUS_INLINE double set_row(int slot, bool loaded, const Carried& carried, PackedMatrix& J) {
  const double *s_t = at(J.s_t, slot), *u_w = at(J.u_w, slot);
  const Nine t = unpack(s_t, 9);
  save(unpack(s_t, 0), J.s[slot]);
  save(t, J.t[slot]);
  Nine gain = unpack(u_w, 9), row = unpack(u_w, 0);
  if (loaded) {
    gain = combine<N>(gain, J.s[slot].x, carried.PT);
    row = combine<N>(row, J.t[slot].x, carried.P);
  }
  save(gain, J.gain[slot]);
  save(row, J.row[slot]);
  return dot(t, gain);
}

using Mat3Map = Eigen::Map<Mat3, 0, Eigen::Stride<3 * lanes, lanes>>;

/// gain, D^-1 row and D^-1 of the ball whose third joint is at `last`; P reduced by all three.
/// @return false where D is singular
SALTUS_INLINE bool eliminate_ball(int last, bool loaded, Carried& carried, PackedMatrix& J) {
  const int first = last - 2;
  for (int slot = first; slot <= last; ++slot) set_row<9>(slot, loaded, carried, J);
  Mat3 D;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) D(i, j) = dot(load(J.t[first + i]), load(J.gain[first + j]));
  }
  D += Mat3Map(at(J.ball, last) + 18 * lanes);
  const Mat3 inverse = D.inverse();
  if (!is_pivot(D.determinant()) || !inverse.allFinite()) return false;
  Mat3Map(at(J.pivot, last)) = inverse;
  const Nine row[3] = {load(J.row[first]), load(J.row[first + 1]), load(J.row[last])};
  for (int i = 0; i < 3; ++i) {
    Nine sum = zero();
    for (int j = 0; j < 3; ++j) add(inverse(i, j), row[j], sum);
    save(sum, J.row[first + i]);
  }
  for (int i = 0; i < 3; ++i) {
    reduce<9>(J.gain[first + i], J.row[first + i], 1, loaded || i > 0, carried);
  }
  return true;
}

/// N = 9, or 6 where tau = 0: there the last three of t and u vanish.
template <int N>
SALTUS_INLINE bool factorize(const PackedGroup& g, PackedMatrix& J) {
  Carried carried;
  bool loaded = false;  // `carried` holds what joint k + 1 left for joint k
  const bool has_added = !J.added.empty();
  auto ball = g.balls.rbegin();
  for (Carried& each : J.branch) each = Carried{};
  for (int k = g.positions - 1; k >= 0; --k) {
    const int slot = g.slot(k), branch = J.branch_of[slot];
    if (branch >= 0) {
      add_branch<N>(J.branch[branch], loaded, carried);
      loaded = true;
    }
    if (N == 9 && ball != g.balls.rend() && *ball + 2 == k) {
      if (!eliminate_ball(slot, loaded, carried, J)) return false;
      k = *ball++;  // its first joint, whose parent is the ball's
      if (g.parent[k] < 0) break;
      loaded = g.parent[k] == k - 1;
      if (!loaded) add_branch<N>(carried, true, J.branch[J.branch_of[g.slot(g.parent[k])]]);
      continue;
    }
    double D = set_row<N>(slot, loaded, carried, J);
    if (has_added) D += *at(J.added, slot);
    const double inverse = *at(J.inverse, slot) = 1 / D;  // tells which pivot failed
    if (!is_pivot(D)) return false;
    if (g.parent[k] < 0) break;
    reduce<N>(J.gain[slot], J.row[slot], inverse, loaded, carried);
    loaded = g.parent[k] == k - 1;
    if (loaded) continue;
    add_branch<N>(carried, true, J.branch[J.branch_of[g.slot(g.parent[k])]]);
  }
  return true;
}

}  // namespace

SALTUS_CLONES bool factorize_sweep(const PackedGroup& g, PackedMatrix& J) {
  return J.symmetric ? factorize<6>(g, J) : factorize<9>(g, J);
}

namespace {

/// x <- D^-1 (x - t.c) of a ball, and gain x to the joint above. Position k is its first joint's.
/// Transposed, where the gains are those of D^-1 row, x <- x - t.c alone.
SALTUS_INLINE void rise_over_ball(const PackedGroup& g, int k, bool transposed, PackedMatrix& J) {
  const int first = g.slot(k), last = first + 2;
  const Nine c = load(J.c[last]);
  Vec3 e;
  for (int i = 0; i < 3; ++i) e[i] = *at(J.x, first + i) - dot(load(J.t[first + i]), c);
  if (!transposed) e = Mat3Map(at(J.pivot, last)) * e;
  for (int i = 0; i < 3; ++i) *at(J.x, first + i) = e[i];
  if (g.parent[k] < 0) return;
  PackedMatrix::Nine& parent = J.c[g.slot(g.parent[k])];
  Nine sum = load(parent);
  add(1, c, sum);
  for (int i = 0; i < 3; ++i) add(e[i], load(J.gain[first + i]), sum);
  save(sum, parent);
}

/// x <- x - D^-1 row a, and a += s x. Transposed, where rows are the gains, D^-T (x - row a).
SALTUS_INLINE void descend_ball(int first, bool transposed, Nine& a, PackedMatrix& J) {
  const Nine above = a;
  Vec3 x;
  for (int i = 0; i < 3; ++i) {
    x[i] = *at(J.x, first + i) - dot(load(J.row[first + i]), above);
  }
  if (transposed) x = (Mat3Map(at(J.pivot, first + 2)).transpose() * x).eval();
  for (int i = 0; i < 3; ++i) {
    *at(J.x, first + i) = x[i];
    add(x[i], load(J.s[first + i]), a);
  }
  save(a, J.a[first + 2]);
}

}  // namespace

SALTUS_CLONES void solve_sweep(const PackedGroup& g, PackedMatrix& J, bool transposed) {
  const bool balls = !J.symmetric && !g.balls.empty();
  std::size_t next = balls ? g.balls.size() : 0;
  for (int k = 0; k < g.positions; ++k) save(zero(), J.c[g.slot(k)]);
  for (int k = g.positions - 1; k >= 0; --k) {
    if (next > 0 && g.balls[next - 1] + 2 == k) {
      k = g.balls[--next];
      rise_over_ball(g, k, transposed, J);
      continue;
    }
    const int slot = g.slot(k);
    double& e = *at(J.x, slot);
    const Nine c = load(J.c[slot]);
    e -= dot(load(J.t[slot]), c);
    if (g.parent[k] < 0) continue;
    PackedMatrix::Nine& parent = J.c[g.slot(g.parent[k])];
    Nine sum = load(parent);
    add(1, c, sum);
    add(e * *at(J.inverse, slot), load(J.gain[slot]), sum);
    save(sum, parent);
  }
  for (int k = 0; k < g.positions; ++k) {
    const int slot = g.slot(k);
    Nine a = zero();
    if (g.parent[k] >= 0) a = load(J.a[g.slot(g.parent[k])]);
    if (balls && next < g.balls.size() && g.balls[next] == k) {
      ++next;
      descend_ball(slot, transposed, a, J);
      k += 2;
      continue;
    }
    double& x = *at(J.x, slot);
    x = (x - dot(load(J.row[slot]), a)) * *at(J.inverse, slot);
    add(x, load(J.s[slot]), a);
    save(a, J.a[slot]);
  }
}

}  // namespace saltus::packed
