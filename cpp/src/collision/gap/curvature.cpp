// Second partials of a gap from the two features that face each other.
//
// Reference: theory, section 7 (capsule-capsule), here for any two features. Let x(xi) run over a's
// core with tangents T, y(eta) over b's with tangents S, both at 0 at the witnesses, n.x_xixi =
// K_A, n.y_etaeta = K_B, and let a move by the twist t = [w; u] about P = x(0). Then phi is
// stationary in z = (xi, eta, mu) of
//
//   phi + n.u + (z^T M z + 2 z^T g(t) + n.(w x u))/2 + ...
//
//       [ K_A       0       T^T E ]            [ T^T (n x w) ]
//   M = [ 0        -K_B    -S^T E ]     g(t) = [ 0           ]     E: two axes across n
//       [ E^T T   -E^T S    -d I  ]            [ E^T u       ]
//
// mu is how n turns. It stands for the quotient by the distance d, so that the system is regular
// where cores touch. Eliminating z leaves C = -g^T M^-1 g.
#include <Eigen/LU>

#include "collision/shapes/point_distance.hpp"
#include "saltus/collision/gap_motion.hpp"

namespace saltus {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;

Mat32 axes_across(const Vec3& n) {
  Mat32 E;
  E.col(0) = n.unitOrthogonal();
  E.col(1) = n.cross(E.col(0));
  return E;
}

const Vec3& tangent(const Patch& patch, int k) { return k == 0 ? patch.t0 : patch.t1; }

/// Rows and columns of one patch; unused ones are those of the unit matrix.
void add_patch(const Patch& patch, double sign, const Mat32& E, int first, Mat6& M) {
  const double K[2][2] = {{patch.k00, patch.k01}, {patch.k01, patch.k11}};
  for (int i = 0; i < 2; ++i) {
    if (i >= patch.dim) M(first + i, first + i) = 1;
    if (i >= patch.dim) continue;
    for (int j = 0; j < patch.dim; ++j) M(first + i, first + j) = sign * K[i][j];
    M.block<1, 2>(first + i, 4) = sign * tangent(patch, i).transpose() * E;
    M.block<2, 1>(4, first + i) = M.block<1, 2>(first + i, 4).transpose();
  }
}

/// M, and g as a matrix that takes t.
struct Stationary {
  Mat6 M = Mat6::Zero(), g = Mat6::Zero();
};

Stationary stationary(const Gap& gap, const Mat32& E) {
  Stationary out;
  Mat6 &M = out.M, &g = out.g;
  add_patch(gap.a, 1, E, 0, M);
  add_patch(gap.b, -1, E, 2, M);
  M(4, 4) = M(5, 5) = -gap.d;
  for (int i = 0; i < gap.a.dim; ++i) {  // T.(n x w) = w.(T x n)
    g.block<1, 3>(i, 0) = tangent(gap.a, i).cross(gap.n_W).transpose();
  }
  g.bottomRightCorner<2, 3>() = E.transpose();
  return out;
}

/// Of a ball or a corner against a ball, a corner or a plane that stands still.
GapMotion motion_of_point(const Gap& gap, double r_a, double r_b) {
  GapMotion out;
  const Mat3 across = Mat3::Identity() - gap.n_W * gap.n_W.transpose();
  const bool is_flat = gap.b.dim == 2;
  out.n.setZero();
  if (!is_flat) out.n.rightCols<3>() = across / gap.d;
  out.p_WA = -r_a * out.n;
  out.p_WA.rightCols<3>() += Mat3::Identity();
  out.p_WB = r_b * out.n;
  if (is_flat) out.p_WB.rightCols<3>() = across;
  return out;
}

bool is_flat(const Patch& patch) {
  return patch.dim == 2 && patch.k00 == 0 && patch.k01 == 0 && patch.k11 == 0;
}

}  // namespace

GapMotion gap_motion(const Gap& gap) {
  const double r_a = (gap.center_W - gap.p_WA).dot(gap.n_W), r_b = gap.d - gap.phi - r_a;
  const bool is_ball = gap.b.dim == 0 && std::abs(gap.d) > no_length;
  if (gap.a.dim == 0 && (is_ball || is_flat(gap.b))) return motion_of_point(gap, r_a, r_b);
  const Mat32 E = axes_across(gap.n_W);
  const Stationary s = stationary(gap, E);
  const Mat6 z = -Eigen::FullPivLU<Mat6>(s.M).solve(s.g);
  GapMotion out;
  out.n = E * z.bottomRows<2>();
  out.p_WA = -r_a * out.n;
  out.p_WA.rightCols<3>() += Mat3::Identity();  // u is the velocity of the core's point
  out.p_WB = r_b * out.n;
  for (int i = 0; i < gap.a.dim; ++i) out.p_WA += tangent(gap.a, i) * z.row(i);
  for (int i = 0; i < gap.b.dim; ++i) out.p_WB += tangent(gap.b, i) * z.row(2 + i);
  return out;
}

Mat6 curvature(const Gap& gap) {
  const Mat32 E = axes_across(gap.n_W);
  Mat6 C = Mat6::Zero();
  if (gap.a.dim == 0 && gap.b.dim == 0) {  // two points: the inverse of their distance
    const bool apart = std::abs(gap.d) > no_length;
    if (apart) C.bottomRightCorner<3, 3>() = E * E.transpose() / gap.d;
    return C;
  }
  const auto [M, g] = stationary(gap, E);
  C = -g.transpose() * Eigen::FullPivLU<Mat6>(M).solve(g);
  return 0.5 * (C + C.transpose());
}

Mat3 F_W(const Gap& gap) { return curvature(gap).bottomRightCorner<3, 3>(); }

}  // namespace saltus
