// Where two features face each other: closed forms of points and lines, Newton where one is round.
//
//   x(xi) - y(eta) = d n,   T.n = 0,   S.n = 0       T, S: tangents of the features
//
// n turns by E mu (E: two axes across n). The Newton matrix is M of curvature.cpp, regular where
// the cores touch: no direction is taken from x - y there.
//
//   [ K_A     0      T^T E ] [ xi  ]     [  T^T n       ]
//   [ 0      -K_B   -S^T E ] [ eta ] = - [ -S^T n       ]
//   [ E^T T  -E^T S  -d I  ] [ mu  ]     [  E^T (x - y) ]
#include "collision/convex/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saltus {
namespace {

using Kind = Feature::Kind;

Vec3 across(const Vec3& v, const Vec3& t) { return v - t.dot(v) * t; }

/// The unit vector along v and across t to the last digit; zero if v is along t.
Vec3 unit_across(const Vec3& v, const Vec3& t) {
  const Vec3 w = across(v, t);
  const double norm = w.norm();
  if (!(norm > 1e-150)) return Vec3::Zero();
  return across(w / norm, t).normalized();
}

bool meet_straight(double least_cos, Feature& a, Feature& b, Vec3& n) {
  const bool line_a = a.kind == Kind::edge, line_b = b.kind == Kind::edge;
  const Vec3 guess = n, w = a.x - b.x;
  if (line_a && line_b) {
    const Vec3 k = a.t0.cross(b.t0);
    const double square = k.squaredNorm();
    if (square < 1e-28) return false;  // parallel to rounding: an end meets the other edge
    // orthogonal to both again: the product of nearly parallel ones has lost digits
    n = unit_across(unit_across(k, b.t0), a.t0);
    a.x += (b.t0.cross(w).dot(k) / square) * a.t0;
    b.x += b.t0.dot(a.x - b.x) * b.t0;
  } else if (line_a || line_b) {
    Feature& line = line_a ? a : b;
    n = unit_across(w, line.t0);
    line.x += line.t0.dot(line_a ? Vec3(-w) : w) * line.t0;
  } else {
    n = w.norm() > 1e-150 ? Vec3(w.normalized()) : Vec3(Vec3::Zero());
  }
  if (n.dot(guess) < 0) n = -n;
  return n.dot(guess) > least_cos;
}

/// M and -r, side by side: rows of a's tangents, of b's, and of the two axes across n.
struct System {
  double row[6][7] = {};
  int size = 0;

  /// Gauss's elimination with row pivots; false where it is singular. The solution is the last
  /// column.
  bool solve() {
    for (int k = 0; k < size; ++k) {
      int pivot = k;
      for (int i = k + 1; i < size; ++i) {
        if (std::abs(row[i][k]) > std::abs(row[pivot][k])) pivot = i;
      }
      if (!(std::abs(row[pivot][k]) > 1e-300)) return false;
      if (pivot != k) std::swap(row[pivot], row[k]);
      for (int i = k + 1; i < size; ++i) {
        const double factor = row[i][k] / row[k][k];
        for (int j = k + 1; j < 7; ++j) row[i][j] -= factor * row[k][j];
      }
    }
    for (int k = size - 1; k >= 0; --k) {
      for (int j = k + 1; j < size; ++j) row[k][6] -= row[k][j] * row[j][6];
      row[k][6] /= row[k][k];
    }
    return true;
  }
};

/// Rows and columns of one feature, from `first`; those of n's turn are from `turn`.
void add_feature(const Patch& f, double sign, const Vec3& n, const Vec3 (&E)[2], int first,
                 int turn, System& M) {
  const double K[2][2] = {{f.k00, f.k01}, {f.k01, f.k11}};
  const Vec3* t[2] = {&f.t0, &f.t1};
  for (int i = 0; i < f.dim; ++i) {
    for (int j = 0; j < f.dim; ++j) M.row[first + i][first + j] = sign * K[i][j];
    for (int j = 0; j < 2; ++j) {
      M.row[first + i][turn + j] = M.row[turn + j][first + i] = sign * t[i]->dot(E[j]);
    }
    M.row[first + i][6] = -sign * t[i]->dot(n);
  }
}

double norm(double x, double y) { return std::sqrt(x * x + y * y); }

constexpr double rounding = 4e-16;  ///< [length]

struct State {
  Feature a, b;
  Vec3 n;
};

/// [m] what the slant of n against a feature's tangents counts as: the way to where it has none,
/// where the feature bends more than over `length`. A sharp end tells n only to rounding times
/// bend.
double slant(const Patch& f, const Vec3& n, double length) {
  double out = 0;
  if (f.dim > 0) out += std::abs(f.t0.dot(n)) / (1 / length + std::abs(f.k00));
  if (f.dim > 1) out += std::abs(f.t1.dot(n)) / (1 / length + std::abs(f.k11));
  return out;
}

/// One step of Newton's method, or none where the residual is rounding; returns it [m].
double newton_step(const Solid& A, const Solid& B, double length, State& x) {
  const Vec3 first_axis = x.n.unitOrthogonal(), w = x.a.x - x.b.x;
  const Vec3 E[2] = {first_axis, x.n.cross(first_axis)};
  const Patch a = patch_of(A, x.a, x.n), b = patch_of(B, x.b, x.n);
  const int turn = a.dim + b.dim;
  System M;
  M.size = turn + 2;
  add_feature(a, 1, x.n, E, 0, turn, M);
  add_feature(b, -1, x.n, E, a.dim, turn, M);
  for (int j = 0; j < 2; ++j) {
    M.row[turn + j][turn + j] = -x.n.dot(w);
    M.row[turn + j][6] = -E[j].dot(w);
  }
  const double residual =
      norm(M.row[turn][6], M.row[turn + 1][6]) + slant(a, x.n, length) + slant(b, x.n, length);
  if (residual <= rounding * length || !M.solve()) return residual;
  const double u = M.row[turn][6], v = M.row[turn + 1][6], turned = norm(u, v);
  if (!std::isfinite(turned)) return residual;
  const double shorter = turned > 0.3 ? 0.3 / turned : 1;
  // no farther than a solid's length
  const auto held = [&](int first, int k, int dim) {
    return k < dim ? std::clamp(shorter * M.row[first + k][6], -length, length) : 0;
  };
  slide(A, held(0, 0, a.dim), held(0, 1, a.dim), x.a);
  slide(B, held(a.dim, 0, b.dim), held(a.dim, 1, b.dim), x.b);
  x.n = (x.n + shorter * (u * E[0] + v * E[1])).normalized();
  return residual;
}

}  // namespace

bool meet(const Solid& A, const Solid& B, Feature& a, Feature& b, Vec3& n, double turn) {
  const double least_cos = std::cos(turn);
  if (a.kind <= Kind::edge && b.kind <= Kind::edge) return meet_straight(least_cos, a, b, n);
  const double length = A.length + B.length;
  State x{a, b, n}, best = x;
  double least = -1;
  for (int k = 0; k < 16; ++k) {
    const State here = x;
    const double residual = newton_step(A, B, length, x);
    if (!(x.n.dot(n) > least_cos)) return false;  // others meet there
    const bool better = least < 0 || residual < least;
    if (!better && least < 1e-9 * length) break;  // at rounding
    if (better) best = here;
    if (better) least = residual;
    if (least <= rounding * length) break;
  }
  if (!(least <= 1e-10 * length)) return false;
  a = best.a;
  b = best.b;
  n = best.n;
  return true;
}

}  // namespace saltus
