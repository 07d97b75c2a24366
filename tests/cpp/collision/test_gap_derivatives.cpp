// First and second partials of gaps along motions of a, turning included, over all pairs.
//
// Contract (gap.hpp), for motions exp(alpha t_i) exp(beta t_l) of a, t = [w; u], u at P:
//   phi_q[i]    = n.u_i
//   phi_qq[i,l] = t_i^T C t_l + n.(w_i x u_l)
// P moves: along the screw t_i, which stays, u_i at P' is u_i + w_i x (P' - P).
#include <gtest/gtest.h>

#include "collision/gap_scene.hpp"

namespace saltus {
namespace {

using testing_scene::Placed;
using testing_scene::Random;
using testing_scene::random_placed;

using Names = std::pair<std::string, std::string>;

constexpr double h = 1e-5;

/// a moved by `size` about (k < 3) or along (k >= 3) an axis of the world through P.
Placed moved(const Placed& x, const Vec3& P, int k, double size) {
  if (k >= 3) return x.moved_by(size * Vec3::Unit(k - 3));
  const Mat3 R = Eigen::AngleAxisd(size, Vec3::Unit(k)).toRotationMatrix();
  return {x.a, x.b, {R * x.X_WA.R, P + R * (x.X_WA.p - P)}, x.X_WB};
}

/// phi_q of the six motions about P, at a state whose contact line goes through another point.
Vec6 gradient(const Gap& g, const Vec3& P) { return spatial((g.center_W - P).cross(g.n_W), g.n_W); }

/// phi_qq by the formula.
Mat6 hessian(const Gap& g) {
  Mat6 H = curvature(g);
  for (int i = 0; i < 3; ++i) {
    for (int l = 0; l < 3; ++l) {  // w_i x u_l of axes
      H(i, 3 + l) += g.n_W.dot(Vec3::Unit(i).cross(Vec3::Unit(l)));
    }
  }
  return H;
}

class Derivatives : public ::testing::TestWithParam<Names> {};

/// False where the stencil is no good: a sharp curvature, or one that jumps.
bool check(const Placed& x) {
  const Gap g = x.gap();
  const Vec3 P = g.center_W;
  const double bend = curvature(g).norm();
  if (x.scale() > 100 || bend > 20) return false;
  Vec6 first;
  Mat6 second;
  double change = 0;  // of the curvature over the stencil: large where it straddles two features
  for (int l = 0; l < 6; ++l) {
    const Gap up = moved(x, P, l, h).gap(), down = moved(x, P, l, -h).gap();
    first[l] = (up.phi - down.phi) / (2 * h);
    second.col(l) = (gradient(up, P) - gradient(down, P)) / (2 * h);
    change = std::max(
        {change, (curvature(up) - curvature(g)).norm(), (curvature(g) - curvature(down)).norm()});
    // faces bend alike, but n jumps from one to the next: by far more than h times `bend`
    if (std::max((up.n_W - g.n_W).norm(), (g.n_W - down.n_W).norm()) > 1e-3) return false;
  }
  if (change > 40 * h * (1 + bend * bend)) return false;
  const double size = 1 + bend;
  // rounding of positions (1e-15 at 10 m) over h; truncation h^2 times a third or fourth partial,
  // which for round features goes with the square of how much the curvature changes over h
  EXPECT_LE((first - spatial(Vec3::Zero(), g.n_W)).norm(), 2e-9 * size * size);
  EXPECT_LE((second - hessian(g)).norm(), 4e-9 * size * size * size + change * change / size);
  return true;
}

TEST_P(Derivatives, AlongAllMotions) {
  Random random(11);
  int used = 0;
  for (int k = 0; k < 600; ++k) used += check(random_placed(GetParam(), random));
  EXPECT_GT(used, 300);
}

// Brought together along n. Corners that meet corners or edges are left out by their curvature.
TEST_P(Derivatives, WhereBodiesTouch) {
  Random random(12);
  int used = 0;
  for (int k = 0; k < 600; ++k) {
    Placed x = random_placed(GetParam(), random);
    x.X_WA.p -= x.X_WB.p;
    x.X_WB.p.setZero();
    const double phi = random.uniform(-1, 1) * std::pow(10, -3.0 - random.index(13));
    const Gap g = x.gap();
    used += check(x.moved_by((phi - g.phi) * g.n_W));
  }
  EXPECT_GT(used, 100);
}

INSTANTIATE_TEST_SUITE_P(Table, Derivatives, ::testing::ValuesIn(gap_table()),
                         [](const ::testing::TestParamInfo<Names>& names) {
                           return names.param.first + "_" + names.param.second;
                         });

}  // namespace
}  // namespace saltus
