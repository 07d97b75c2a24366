// Impacts with friction, in contact space: what no choice of bodies may break.
#include "kit/contact_problems.hpp"
#include "saltus/variational/friction.hpp"

namespace saltus {
namespace {

struct Scene {
  MatX M, N, T;
  VecX v, e, mu;
};

/// Contacts whose normals lie in a cone, so that they can all be left.
Scene random_scene(int contacts, int n, double greatest_friction, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  const MatX A = random_matrix(n, n, random);
  Scene s;
  s.M = A * A.transpose() + 0.3 * MatX::Identity(n, n);
  s.N = random_matrix(contacts, n, random);
  s.N.col(0) = s.N.col(0).cwiseAbs().array() + 1;
  s.T = random_matrix(2 * contacts, n, random);
  s.v = random_vector(n, random);
  s.v[0] -= 3;
  s.e.resize(contacts);
  s.mu.resize(contacts);
  for (double& e : s.e) e = unit(random);
  for (double& mu : s.mu) mu = greatest_friction * unit(random);
  return s;
}

/// Whose rates are independent of each other.
Scene random_scene(int contacts, double greatest_friction, std::mt19937& random) {
  return random_scene(contacts, 3 + 2 * contacts, greatest_friction, random);
}

FrictionOutcome resolve(const Scene& s) { return resolve_impact(s.M, s.N, s.T, s.v, s.e, s.mu); }

double energy(const MatX& M, const VecX& v) { return v.dot(M * v) / 2; }

TEST(FrictionImpact, NeverGainsEnergyAndStaysInTheCone) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const Scene s = random_scene(1 + trial % 6, 2, random);
    const FrictionOutcome out = resolve(s);
    VecX v = s.v;
    double before = energy(s.M, v);
    for (const FrictionImpulse& i : out.impulses) {  // each of them, not the whole alone
      ASSERT_GE(i.p[0], 0);
      ASSERT_LE(i.p.tail<2>().norm(), s.mu[i.contact] * i.p[0] * (1 + 1e-12));
      VecX force = s.N.row(i.contact).transpose() * i.p[0];
      force += s.T.middleRows(2 * i.contact, 2).transpose() * i.p.tail<2>();
      v += s.M.llt().solve(force);
      const double after = energy(s.M, v);
      ASSERT_LE(after, before * (1 + 1e-12)) << trial;
      before = after;
    }
    expect_near(out.v, v, 1e-9);
    ASSERT_GE((s.N * out.v).minCoeff(), -1e-9) << trial;
  }
}

TEST(FrictionImpact, WithoutFrictionIsThePlainCascade) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Scene s = random_scene(1 + trial % 6, 0, random);
    const FrictionOutcome out = resolve(s);
    const ImpactOutcome plain = resolve_impact(s.M, s.N, s.v, s.e);
    ASSERT_EQ(out.impulses.size(), plain.impulses.size());
    for (std::size_t k = 0; k < plain.impulses.size(); ++k) {
      ASSERT_EQ(out.impulses[k].contact, plain.impulses[k].pair);
      ASSERT_NEAR(out.impulses[k].p[0], plain.impulses[k].lambda, 1e-12);
    }
  }
}

// Coulomb's law at the end of a plastic impact: it sticks, or it slides on against the friction.
TEST(FrictionImpact, APlasticContactSticksOrSlidesOn) {
  std::mt19937 random(3);
  int sticks = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Scene s = random_scene(1, 2, random);
    s.e.setZero();
    const FrictionOutcome out = resolve(s);
    if (out.impulses.empty()) continue;
    const Vec3 p = out.impulses[0].p;
    const VecX u_t = s.T * out.v;
    EXPECT_NEAR((s.N * out.v)[0], 0, 1e-12);
    if (u_t.norm() < 1e-12) {
      ++sticks;
      continue;
    }
    const double limit = s.mu[0] * p[0];
    EXPECT_NEAR(p.tail<2>().norm(), limit, 1e-12 * limit);
    EXPECT_LE((p.tail<2>() / limit + u_t / u_t.norm()).norm(), 1e-9) << trial;
  }
  EXPECT_GT(sticks, 50);
  EXPECT_LT(sticks, 950);
}

// A disc (x, y, angle) of mass m, radius r, inertia k m r^2 that falls on the floor: with e, its
// rebound is e v_n; in the tangent it stops if k/(1+k) |slip| <= mu (1+e) v_n.
TEST(FrictionImpact, ADiscWithSpinHitsTheFloor) {
  const double m = 2, r = 0.3, k = 0.5, e = 0.6, v_n = 1.5;
  Scene s;
  s.M = vec({m, m, k * m * r * r}).asDiagonal();
  s.N = MatX::Zero(1, 3);
  s.N(0, 1) = 1;
  s.T = MatX::Zero(2, 3);
  s.T.row(0) << 1, 0, r;  // angle grows against the clock: the lowest point moves along x
  s.e = vec({e});
  for (const double mu : {0.05, 0.3, 1.0}) {
    for (const double spin : {-20.0, 3.0, 8.0}) {
      s.v = vec({0.4, -v_n, spin});
      s.mu = vec({mu});
      const double slip = 0.4 + r * spin;
      const double stops = k / (1 + k) * m * slip;  // 1 / (1/m + r^2 / (k m r^2))
      const double limit = mu * (1 + e) * m * v_n;
      const double beta = std::abs(stops) <= limit ? -stops : -std::copysign(limit, slip);
      expect_near(resolve(s).v, vec({0.4 + beta / m, e * v_n, spin + beta / (k * m * r)}), 1e-13);
    }
  }
}

TEST(FrictionImpact, SettlingTogetherObeysCoulombAtEveryContact) {
  // a block on four corners, half-sizes 0.2 x 0.1 x 0.1, thrown on them: coordinates v, w
  ContactBlocks W;
  MatX M = MatX::Identity(6, 6), R(12, 6);
  M.diagonal() << 1, 1, 1, 0.01, 0.02, 0.02;
  for (int i = 0; i < 4; ++i) {
    const double x = i & 1 ? 0.2 : -0.2, y = i & 2 ? 0.1 : -0.1, z = -0.1;
    R.row(3 * i) << 0, 0, 1, y, -x, 0;
    R.row(3 * i + 1) << 1, 0, 0, 0, z, -y;
    R.row(3 * i + 2) << 0, 1, 0, -z, 0, x;
  }
  const MatX D = R * M.inverse() * R.transpose();
  for (int i = 0; i < 4; ++i) {
    W.start.push_back(4 * i);
    for (int j = 0; j < 4; ++j) {
      W.contact.push_back(j);
      W.block.push_back(D.block<3, 3>(3 * j, 3 * i));
    }
    W.own.push_back(D.block<3, 3>(3 * i, 3 * i));
    W.friction.push_back(0.4);
  }
  W.start.push_back(16);
  const VecX v = vec({1, 0.5, -1, 0.2, 0.1, 3});
  std::vector<Vec3> u, p(4, Vec3::Zero());
  for (int i = 0; i < 4; ++i) u.push_back(R.middleRows(3 * i, 3) * v);
  EXPECT_LT(settle(W, 5000, u, p), 5000);
  for (int i = 0; i < 4; ++i) {
    EXPECT_GE(u[i][0], -1e-13);
    EXPECT_NEAR(u[i][0] * p[i][0], 0, 1e-13);
    const Eigen::Vector2d slide = u[i].tail<2>(), beta = p[i].tail<2>();
    EXPECT_LE(beta.norm(), 0.4 * p[i][0] + 1e-13);
    EXPECT_NEAR(beta.dot(slide), -0.4 * p[i][0] * slide.norm(), 1e-12);
  }
}

// A rod, weightless in one motion, that is pressed into the floor along its axis: friction can hold
// any approach, and one impulse stops it. W = [1 b; b b^2] is singular along (1, -1/b).
TEST(FrictionImpact, WhatFrictionCanHoldAgainstAnyApproachIsStopped) {
  for (const double b : {2.0, -2.0, 5.0}) {
    Scene s;
    s.M = MatX::Identity(1, 1);
    s.N = MatX::Constant(1, 1, 1);
    s.T = MatX::Zero(2, 1);
    s.T(0, 0) = b;
    s.v = vec({-1.5});
    s.e = vec({0});
    s.mu = vec({0.8});
    const FrictionOutcome out = resolve(s);
    expect_near(out.v, vec({0}), 1e-14);
    ASSERT_EQ(out.impulses.size(), 1u);
    const Vec3 p = out.impulses[0].p;
    EXPECT_LE(p.tail<2>().norm(), 0.8 * p[0] * (1 + 1e-12));
  }
}

TEST(FrictionImpact, RedundantContactsThatDoNotReboundObeyCoulombTogether) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {  // up to 12 contacts, 36 rates, 8 coordinates
    const int contacts = 2 + trial % 11;
    Scene s = random_scene(contacts, 8, 1, random);
    s.e = VecX::Zero(contacts);
    s.mu = VecX::Constant(contacts, 0.3);
    const FrictionOutcome out = resolve(s);
    EXPECT_LE(energy(s.M, out.v), energy(s.M, s.v));
    const VecX u_n = s.N * out.v, u_t = s.T * out.v;
    EXPECT_GE(u_n.minCoeff(), -1e-8) << trial;
    for (const FrictionImpulse& i : out.impulses) {
      EXPECT_NEAR(u_n[i.contact] * i.p[0], 0, 1e-7) << trial;
      const Eigen::Vector2d slide = u_t.segment<2>(2 * i.contact), beta = i.p.tail<2>();
      EXPECT_LE(beta.norm(), 0.3 * i.p[0] * (1 + 1e-12));
      EXPECT_NEAR(beta.dot(slide), -0.3 * i.p[0] * slide.norm(), 1e-7) << trial;
    }
  }
}

TEST(FrictionImpact, ErrorsNameWhatDoesNotFit) {
  std::mt19937 random(4);
  Scene s = random_scene(2, 1, random);
  s.T = s.N;
  EXPECT_THROW(resolve(s), ModelError);
  s = random_scene(2, 1, random);
  s.mu[1] = -1;
  EXPECT_THROW(resolve(s), ModelError);
}

}  // namespace
}  // namespace saltus
