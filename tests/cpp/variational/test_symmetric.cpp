// Contacts that hit together: generalized reflections, and plastic impacts by projection.
#include <gtest/gtest.h>

#include "kit/contact_problems.hpp"

namespace saltus {
namespace {

constexpr CascadeOptions symmetric{.order = ImpactOrder::symmetric};

ImpactOutcome together(const MatX& N, const VecX& v, double e = 1) {
  return resolve_impact(MatX::Identity(v.size(), v.size()), N, v, e, symmetric);
}

TEST(Symmetric, ThreeBallsInLineAreNotSorted) {
  const ImpactOutcome out = together(line(3), vec({2, 1.5, -1}));
  expect_near(out.v, vec({-1. / 3, 1. / 6, 8. / 3}), 1e-15);
  EXPECT_EQ(out.impulses.size(), 2u);
  // one contact at a time is no different where one approaches at a time
  expect_near(together(line(3), vec({1, 0, 0})).v, vec({0, 0, 1}), 1e-15);
}

TEST(Symmetric, BernoullisCueComesStraightBack) {
  VecX v = VecX::Zero(6);
  v[0] = 2;
  const ImpactOutcome out = together(bernoulli(), v);
  const double y = 1.2 / std::sqrt(3.);  // .692820
  expect_near(out.v, vec({-.4, 0, 1.2, -y, 1.2, y}), 1e-15);
  EXPECT_NEAR(y, .692820, 1e-6);
}

TEST(Symmetric, ABallIntoACornerComesStraightBack) {
  for (const double half : {.3, .7, 1.2}) {  // [rad] half the corner's angle
    const MatX N =
        (MatX(2, 2) << std::sin(half), std::cos(half), std::sin(half), -std::cos(half)).finished();
    expect_near(together(N, vec({-1, 0})).v, vec({1, 0}), 1e-14);
    expect_near(together(N, vec({-1, 0}), .5).v, vec({.5, 0}), 1e-14);
  }
}

/// 15 discs in a triangle whose tip a cue hits along x; ball i of row r is mirrored by r - i.
struct Rack {
  std::vector<std::array<double, 2>> centre{{-1, 0}};  ///< the cue first
  std::vector<int> mirror{0};
};

Rack rack(double radius) {
  Rack out;
  for (int row = 0; row < 5; ++row) {
    const int first = static_cast<int>(out.centre.size());
    for (int i = 0; i <= row; ++i) {
      out.centre.push_back({row * std::sqrt(3.) * radius, (2 * i - row) * radius});
      out.mirror.push_back(first + row - i);
    }
  }
  out.centre[0][0] = -2 * radius;
  return out;
}

TEST(Symmetric, ABilliardBreakKeepsItsMirror) {
  const double radius = .028575;
  const Rack balls = rack(radius);
  const MatX N = touching_discs(balls.centre, radius);
  ASSERT_EQ(N.rows(), 31);
  VecX v = VecX::Zero(32);
  v[0] = 5;
  for (const double e : {1., .9, 0.}) {
    const ImpactOutcome out = together(N, v, e);
    for (std::size_t i = 0; i < balls.mirror.size(); ++i) {
      const auto a = static_cast<Eigen::Index>(2 * i), b = 2L * balls.mirror[i];
      EXPECT_NEAR(out.v[a], out.v[b], 5e-12) << e;  // 1e-12 of 5 m/s
      EXPECT_NEAR(out.v[a + 1], -out.v[b + 1], 5e-12) << e;
    }
    EXPECT_GE((N * out.v).minCoeff(), -1e-11);
    if (e == 1) {
      EXPECT_NEAR(out.v.squaredNorm(), 25, 1e-12 * 25);
    }
    RecordProperty("impulses", static_cast<int>(out.impulses.size()));
  }
}

TEST(Symmetric, UnlikeContactsLoseWhatEachTakesUp) {
  // e = 1 and 0 side by side: half of the energy that went in is lost, and none is gained
  VecX v = VecX::Zero(6);
  v[0] = 2;
  const MatX M = MatX::Identity(6, 6);
  const ImpactOutcome out = resolve_impact(M, bernoulli(), v, vec({1, 0}), symmetric);
  const ImpactOutcome plastic = resolve_impact(M, bernoulli(), v, 0, symmetric);
  const double taken = 4 - plastic.v.squaredNorm();
  EXPECT_NEAR(out.v.squaredNorm(), 4 - taken / 2, 1e-14);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 3 + trial % 5, m = 2 + trial % 4;
    const MatX N = random_matrix(m, n, random);
    const VecX came = random_vector(n, random);
    VecX e(m);
    for (double& x : e) x = any(random);
    try {
      const VecX left = resolve_impact(MatX::Identity(n, n), N, came, e, symmetric).v;
      EXPECT_LE(left.norm(), came.norm() * (1 + 1e-14));
      EXPECT_GE((N * left).minCoeff(), -1e-12 * N.norm() * came.norm());
    } catch (const JammedError&) {  // more contacts than coordinates may have no way out
      EXPECT_GT(m, n);
    }
  }
}

TEST(Plastic, IsTheNearestVelocityInTheConeWhateverTheOrder) {
  for (const ImpactOrder order :
       {ImpactOrder::fastest, ImpactOrder::index, ImpactOrder::symmetric}) {
    const MatX M = MatX::Identity(3, 3);
    const VecX out = resolve_impact(M, line(3), vec({1, 0, 0}), 0, {.order = order}).v;
    expect_near(out, VecX::Constant(3, 1. / 3), 1e-15);
    const VecX balls = resolve_impact(M, line(3), vec({2, 1.5, -1}), 0, {.order = order}).v;
    expect_near(balls, VecX::Constant(3, 2.5 / 3), 1e-15);
  }
}

TEST(Plastic, MeetsItsConditionsForRandomContacts) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> decade(-3, 3);
  for (int trial = 0; trial < 400; ++trial) {
    const int n = 2 + trial % 9, m = 2 + trial % 11;
    VecX mass(n);
    for (double& x : mass) x = std::pow(10, decade(random));
    MatX N = random_matrix(m, n, random);
    switch (trial % 5) {
      case 0:
        N.row(1) = 2.5 * N.row(0);
        break;  // the same normal twice
      case 1:
        N.row(m - 1) = -N.row(0);
        break;  // no way out between two
      case 2:
        N.row(m - 1) = N.row(0) + N.row(1);
        break;  // redundant
      default:
        break;
    }
    const MatX M = mass.asDiagonal();
    const VecX v = random_vector(n, random);
    const ImpactOutcome out = resolve_impact(M, N, v, 0);
    const VecX root = (N * mass.cwiseInverse().asDiagonal() * N.transpose()).diagonal().cwiseSqrt();
    const double speed = kinetic_norm(M, v);
    const VecX u = (N * out.v).cwiseQuotient(root) / speed;
    VecX p = M * (out.v - v);
    double strongest = 1;  // impulses between jammed bodies of unlike masses can be huge
    for (const Impulse& impulse : out.impulses) {
      EXPECT_GT(impulse.lambda, 0);
      strongest = std::max(strongest, impulse.lambda * root[impulse.pair] / speed);
      p -= impulse.lambda * N.row(impulse.pair).transpose();
    }
    const double tolerance = 1e-10 + 1e-13 * strongest;  // as contact_multipliers() promises
    EXPECT_GE(u.minCoeff(), -tolerance) << trial;
    for (const Impulse& impulse : out.impulses) {
      EXPECT_LE(std::abs(u[impulse.pair]), tolerance) << trial;
    }
    EXPECT_LE(p.norm(), 1e-10 * (M * v).norm());
    EXPECT_LE(out.impulses.size(), static_cast<std::size_t>(m));
  }
}

TEST(Plastic, RedundantContactsShareAlike) {
  // a square table that falls flat on its four legs: each takes a quarter
  MatX N(4, 3);
  N << 1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1;  // height, roll, pitch
  const MatX M = vec({2, .3, .3}).asDiagonal();
  const ImpactOutcome flat = resolve_impact(M, N, vec({-1, 0, 0}), 0);
  ASSERT_EQ(flat.impulses.size(), 4u);
  for (const Impulse& impulse : flat.impulses) EXPECT_NEAR(impulse.lambda, .5, 1e-15);
  const ImpactOutcome elastic = resolve_impact(M, N, vec({-1, 0, 0}), 1, symmetric);
  expect_near(elastic.v, vec({1, 0, 0}), 1e-15);
  // with a roll too: nothing tells the two legs on a side apart
  const ImpactOutcome rolls = resolve_impact(M, N, vec({-1, .2, 0}), 0);
  ASSERT_EQ(rolls.impulses.size(), 4u);
  EXPECT_NEAR(rolls.impulses[0].lambda, rolls.impulses[1].lambda, 1e-15);
  EXPECT_NEAR(rolls.impulses[2].lambda, rolls.impulses[3].lambda, 1e-15);
}

}  // namespace
}  // namespace saltus
