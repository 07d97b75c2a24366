// The contract of the parts of two shapes, over all kinds that have any: each is a gap, and the
// smallest of them is the signed distance where that is near 0.
#include "saltus/collision/parts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "collision/parts_scene.hpp"

namespace saltus {
namespace {

using testing_scene::Bodies;
using testing_scene::kinds_with_parts;
using testing_scene::least_of;
using testing_scene::Part;
using testing_scene::Placed;
using testing_scene::Random;
using testing_scene::random_touching;

using Names = std::pair<std::string, std::string>;

class Parts : public ::testing::TestWithParam<Names> {
 protected:
  Random random{61};
  Placed touching(double phi) { return random_touching(GetParam(), phi, random); }
  double some_phi() { return std::pow(10, random.uniform(-13, -3)); }
};

TEST_P(Parts, AreGaps) {
  for (int k = 0; k < 200; ++k) {
    const double phi = some_phi();
    const Bodies bodies(touching(random.chance(0.3) ? -phi : phi));
    for (const Part& part : bodies.parts()) {
      const Gap& g = part.gap;
      EXPECT_TRUE(part.silent || std::isfinite(g.phi)) << part.name;
      EXPECT_NEAR(g.n_W.norm(), 1, 1e-15) << part.name;
      if (!std::isfinite(g.phi) || part.silent) continue;
      // rims that lie nearly flat, and nearly on each other, tell their witnesses no better
      const PartKind& kind = part.pair.kind;
      const bool rim =
          std::holds_alternative<Rim>(kind) || std::holds_alternative<RimCrossing>(kind);
      const double rounding = rim ? 5e-12 : 2e-14;
      EXPECT_LE((g.p_WA - g.p_WB - g.phi * g.n_W).norm(), rounding) << part.name;
      EXPECT_LE(g.n_W.cross(g.center_W - g.p_WA).norm(), 1e-14) << part.name;
      EXPECT_TRUE(curvature(g).allFinite()) << part.name;
    }
  }
}

// What lies within 1e-9 of the end of an edge, or the border of a face, is taken for the other's.
TEST_P(Parts, TheSmallestIsTheSignedDistance) {
  for (int k = 0; k < 400; ++k) {
    const double phi = std::pow(10, random.uniform(-13, -6));
    const Placed x = touching(phi);
    const double whole = x.gap().phi;
    if (std::abs(whole - phi) > 1e-14) continue;
    const Bodies bodies(x);
    EXPECT_NEAR(least_of(bodies.parts()), whole, 1e-9) << k;
  }
}

TEST_P(Parts, ExchangeTurnsThemRound) {
  if (GetParam().second == "half_space") return;
  for (int k = 0; k < 100; ++k) {
    const Placed x = touching(some_phi());
    std::multiset<double> gaps, turned;
    for (const Part& part : Bodies(x).parts()) {
      if (!part.silent) gaps.insert(part.gap.phi);
    }
    for (const Part& part : Bodies({x.b, x.a, x.X_WB, x.X_WA}).parts()) {
      if (!part.silent) turned.insert(part.gap.phi);
    }
    ASSERT_EQ(gaps.size(), turned.size()) << k;
    for (auto g = gaps.begin(), h = turned.begin(); g != gaps.end(); ++g, ++h) {
      EXPECT_NEAR(*g, *h, 1e-13);
    }
  }
}

TEST_P(Parts, MoveWithTheBodies) {
  for (int k = 0; k < 100; ++k) {
    Bodies bodies(touching(some_phi()));
    const std::vector<Part> before = bodies.parts();
    const Pose X = random.pose(2);
    bodies.at.X_WA = X * bodies.at.X_WA;
    bodies.at.X_WB = X * bodies.at.X_WB;
    for (const Part& part : before) {
      const Part now = bodies.part(part.pair);
      if (part.silent || now.silent) continue;  // on the border of a part rounding decides
      EXPECT_NEAR(now.gap.phi, part.gap.phi, 1e-14) << part.name;
      const double turn = 1e-13 * (1 + curvature(part.gap).norm());
      EXPECT_LE((X.R * part.gap.n_W - now.gap.n_W).norm(), turn) << part.name;
    }
  }
}

constexpr double h = 1e-6;

/// a moved by `size` about (k < 3) or along (k >= 3) an axis of the world through P.
Bodies moved(const Bodies& x, int shape, const Vec3& P, int k, double size) {
  Bodies out = x;
  Pose& X = shape == 0 ? out.at.X_WA : out.at.X_WB;
  if (k >= 3) {
    X.p += size * Vec3::Unit(k - 3);
    return out;
  }
  const Mat3 R = Eigen::AngleAxisd(size, Vec3::Unit(k)).toRotationMatrix();
  X = {R * X.R, P + R * (X.p - P)};
  return out;
}

Vec6 gradient(const Gap& g, const Vec3& P) { return spatial((g.center_W - P).cross(g.n_W), g.n_W); }

Mat6 hessian(const Gap& g) {
  Mat6 H = curvature(g);
  for (int i = 0; i < 3; ++i) {
    for (int l = 0; l < 3; ++l) H(i, 3 + l) += g.n_W.dot(Vec3::Unit(i).cross(Vec3::Unit(l)));
  }
  return H;
}

/// False where the stencil is no good; see test_gap_derivatives.cpp.
bool check_derivatives(const Bodies& x, const Part& part) {
  const Gap& g = part.gap;
  const double bend = curvature(g).norm();
  if (bend > 20) return false;
  Vec6 first;
  Mat6 second;
  double change = 0;
  for (int l = 0; l < 6; ++l) {
    const Part up = moved(x, part.pair.a, g.center_W, l, h).part(part.pair);
    const Part down = moved(x, part.pair.a, g.center_W, l, -h).part(part.pair);
    if (up.silent || down.silent || (up.gap.n_W - down.gap.n_W).norm() > 1e-3) return false;
    first[l] = (up.gap.phi - down.gap.phi) / (2 * h);
    second.col(l) = (gradient(up.gap, g.center_W) - gradient(down.gap, g.center_W)) / (2 * h);
    change = std::max({change, (curvature(up.gap) - curvature(g)).norm(),
                       (curvature(g) - curvature(down.gap)).norm()});
  }
  if (change > 40 * h * (1 + bend * bend)) return false;
  const double size = 1 + bend;
  EXPECT_LE((first - spatial(Vec3::Zero(), g.n_W)).norm(), 1e-8 * size * size) << part.name;
  EXPECT_LE((second - hessian(g)).norm(), 1e-7 * size * size * size) << part.name;
  return true;
}

TEST_P(Parts, HaveTheirDerivatives) {
  int used = 0;
  for (int k = 0; k < 150; ++k) {
    const Bodies bodies(touching(some_phi()));
    for (const Part& part : bodies.parts()) {
      if (!part.silent && part.gap.phi < 0.01) used += check_derivatives(bodies, part);
    }
  }
  EXPECT_GT(used, 30);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Parts, ::testing::ValuesIn(kinds_with_parts()),
                         [](const ::testing::TestParamInfo<Names>& names) {
                           return names.param.first + "_" + names.param.second;
                         });

}  // namespace
}  // namespace saltus
