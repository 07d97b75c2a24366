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
#include "collision/meeting.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

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

bool meet_straight(Feature& a, Feature& b, Vec3& n) {
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
  return n.dot(guess) > 0.1;
}

using Mat32 = Eigen::Matrix<double, 3, 2>;

/// Rows and columns of one feature; unused ones are those of the unit matrix.
void add_feature(const Patch& f, double sign, const Vec3& n, const Mat32& E, int first, Mat6& M,
                 Vec6& r) {
  const double K[2][2] = {{f.k00, f.k01}, {f.k01, f.k11}};
  const Vec3* t[2] = {&f.t0, &f.t1};
  for (int i = 0; i < 2; ++i) {
    if (i >= f.dim) M(first + i, first + i) = 1;
    if (i >= f.dim) continue;
    for (int j = 0; j < f.dim; ++j) M(first + i, first + j) = sign * K[i][j];
    M.block<1, 2>(first + i, 4) = sign * t[i]->transpose() * E;
    M.block<2, 1>(4, first + i) = M.block<1, 2>(first + i, 4).transpose();
    r[first + i] = sign * t[i]->dot(n);
  }
}

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

/// One step of Newton's method; returns the residual [m] before it.
double newton_step(const Solid& A, const Solid& B, double length, State& x) {
  Mat32 E;
  E.col(0) = x.n.unitOrthogonal();
  E.col(1) = x.n.cross(E.col(0));
  const Vec3 w = x.a.x - x.b.x;
  Mat6 M = Mat6::Zero();
  Vec6 r = Vec6::Zero();
  const Patch a = patch_of(A, x.a, x.n), b = patch_of(B, x.b, x.n);
  add_feature(a, 1, x.n, E, 0, M, r);
  add_feature(b, -1, x.n, E, 2, M, r);
  M(4, 4) = M(5, 5) = -x.n.dot(w);
  r.tail<2>() = E.transpose() * w;
  const double residual = r.tail<2>().norm() + slant(a, x.n, length) + slant(b, x.n, length);
  const Vec6 step = -M.partialPivLu().solve(r);
  if (!step.allFinite()) return residual;
  const double turn = step.tail<2>().norm(), shorter = turn > 0.3 ? 0.3 / turn : 1;
  // no farther than a solid's length
  const auto held = [&](int k) { return std::clamp(shorter * step[k], -length, length); };
  slide(A, held(0), held(1), x.a);
  slide(B, held(2), held(3), x.b);
  x.n = (x.n + shorter * E * step.tail<2>()).normalized();
  return residual;
}

}  // namespace

bool meet(const Solid& A, const Solid& B, Feature& a, Feature& b, Vec3& n) {
  if (a.kind <= Kind::edge && b.kind <= Kind::edge) return meet_straight(a, b, n);
  const double length = A.length + B.length;
  State x{a, b, n}, best = x;
  double least = -1;
  for (int k = 0; k < 16; ++k) {
    const State here = x;
    const double residual = newton_step(A, B, length, x);
    const bool better = least < 0 || residual < least;
    if (!better && least < 1e-9 * length) break;  // at rounding
    if (better) best = here;
    if (better) least = residual;
    if (least < 1e-17 * length) break;
  }
  if (!(least <= 1e-10 * length) || best.n.dot(n) < 0.1) return false;
  a = best.a;
  b = best.b;
  n = best.n;
  return true;
}

}  // namespace saltus
