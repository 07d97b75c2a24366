// One impulse after another, without friction: M, N and v at random, against what cascade.hpp says.
#include <gtest/gtest.h>

#include <cmath>

#include "random_contacts.hpp"
#include "saltus/error.hpp"
#include "saltus/variational/cascade.hpp"

namespace saltus {
namespace {

constexpr int sizes[] = {1, 2, 3, 4, 6, 9, 14, 22, 34, 60};
constexpr ImpactOrder orders[] = {ImpactOrder::fastest, ImpactOrder::index};

/// Of |v|_M sqrt(G_ii): resolve_impact computes v anew every few impulses, and each rounds.
constexpr double rounding = 1e-11;

VecX greatest_rates(const NormalContacts& c) {
  return c.G().diagonal().cwiseSqrt() * std::sqrt(2 * c.energy(c.v));
}

/// u is what the order makes of contact i: it approaches, and no other one comes before it.
void expect_its_turn(ImpactOrder order, const VecX& u, int i, const VecX& scale) {
  const double tolerance = rounding * scale[i];
  EXPECT_LT(u[i], tolerance);
  if (order == ImpactOrder::index) {
    for (int j = 0; j < i; ++j) EXPECT_GE(u[j], -rounding * scale[j]) << j << " comes before " << i;
  } else {
    EXPECT_LE(u[i] / scale[i], u.cwiseQuotient(scale).minCoeff() + rounding);
  }
}

/// Replays the impulses on v: turn, size, energy of each, and what they come to.
void expect_cascade(const NormalContacts& c, const VecX& e, ImpactOrder order) {
  const ImpactOutcome out = resolve_impact(c.M, c.N, c.v, e, {.order = order});
  const MatX columns = c.M.inverse() * c.N.transpose();
  const VecX G_ii = c.G().diagonal(), scale = greatest_rates(c);
  VecX v = c.v;
  double lost = 0;
  for (const Impulse& impulse : out.impulses) {
    const int i = impulse.pair;
    const VecX u = c.N * v;
    expect_its_turn(order, u, i, scale);
    EXPECT_GT(impulse.lambda, 0);
    EXPECT_NEAR(impulse.lambda * G_ii[i], -(1 + e[i]) * u[i], rounding * scale[i]);
    lost += (1 - e[i] * e[i]) * u[i] * u[i] / (2 * G_ii[i]);
    v += impulse.lambda * columns.col(i);
  }
  const double before = c.energy(c.v), after = c.energy(out.v);
  EXPECT_LE(c.energy(out.v - v), rounding * rounding * before);  // momentum: only along normals
  EXPECT_NEAR(after, before - lost, rounding * before);
  EXPECT_LE(after, before * (1 + rounding));
  EXPECT_GE((c.N * out.v).cwiseQuotient(scale).minCoeff(), -rounding);  // all separate
}

TEST(Cascade, ElasticImpulsesEndSeparateAndKeepTheEnergy) {
  std::mt19937 random(1);
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 6; ++trial) {
      const RandomContacts of{contacts, 1 + trial + contacts / 4, 0, 0, false, true};
      const NormalContacts c = random_normals(of, random);
      for (const ImpactOrder order : orders) expect_cascade(c, VecX::Ones(contacts), order);
    }
  }
}

TEST(Cascade, LightBesideHeavyBodies) {
  std::mt19937 random(2);
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 4; ++trial) {  // masses 10^-1.5 to 10^1.5, and 10^-3 to 10^3
      const RandomContacts of{contacts, 2 + contacts / 2, 1.5 + trial % 2 * 1.5, 0, false, true};
      const NormalContacts c = random_normals(of, random);
      for (const ImpactOrder order : orders) expect_cascade(c, VecX::Ones(contacts), order);
    }
  }
}

/// Normals that are there twice, and such that lie between two others.
TEST(Cascade, RedundantContacts) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const int contacts = 3 + trial % 6;
    NormalContacts c = random_normals({contacts, 3, 0, 0, false, true}, random);
    MatX more(contacts + 2, c.N.cols());
    more << c.N, 2 * c.N.row(0), c.N.row(1) + c.N.row(2);
    c.N = more;
    for (const ImpactOrder order : orders) expect_cascade(c, VecX::Ones(contacts + 2), order);
  }
}

/// Each impulse loses (1 - e^2) u^2 / 2G, each contact by its own e.
TEST(Cascade, RestitutionLosesThePartOfEachContact) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit;
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 4; ++trial) {
      const RandomContacts of{contacts, 2 + contacts / 2, trial % 2 * 1.0, 0, false, true};
      const NormalContacts c = random_normals(of, random);
      // with less than 0.5 infinitely many impulses may follow each other, down to the rounding
      const VecX e = VecX::NullaryExpr(contacts, [&] { return 0.5 + 0.5 * unit(random); });
      for (const ImpactOrder order : orders) expect_cascade(c, e, order);
    }
  }
}

/// Between two that face each other there is no way out; without rebound there is no need of one.
TEST(Cascade, JammedContactsSaySoUnlessTheyDoNotRebound) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    NormalContacts c = random_normals({2 + trial % 5 * 2, 2, 0, 0, true, false}, random);
    const Eigen::Index m = c.N.rows();
    for (const ImpactOrder order : orders) {
      EXPECT_THROW(resolve_impact(c.M, c.N, c.v, VecX(VecX::Ones(m)), {order, 1000}), JammedError);
      const ImpactOutcome rests = resolve_impact(c.M, c.N, c.v, VecX(VecX::Zero(m)), {order, 1000});
      EXPECT_LE(c.energy(rests.v), c.energy(c.v));
      // a projection's rates: what contact_multipliers() promises
      EXPECT_LE((c.N * rests.v).cwiseQuotient(greatest_rates(c)).cwiseAbs().maxCoeff(), 1e-10);
    }
  }
}

/// Contacts that do not feel each other: one impulse each, and the rate after is -e u to the bit.
TEST(Cascade, ContactsApartCollideOnceEach) {
  const VecX G = (VecX(4) << 0.3, 0.7, 1.9, 11).finished();
  const VecX e = (VecX(4) << 1, 0.3, 0.7, 0).finished();
  for (const ImpactOrder order : orders) {
    VecX u = (VecX(4) << -0.1, -1, 0.5, -3).finished();
    std::vector<Impulse> impulses;
    ASSERT_TRUE(cascade(MatX(G.asDiagonal()), u, VecX::Zero(4), e, {.order = order}, impulses));
    EXPECT_EQ(impulses.size(), 3u);
    EXPECT_EQ(u, (VecX(4) << 0.1, 0.3 * 1, 0.5, 0).finished());
  }
}

TEST(Cascade, TiesGoToTheLowestIndex) {
  const MatX G = (MatX(3, 3) << 2, -1, 0, -1, 2, -1, 0, -1, 2).finished();
  VecX u = (VecX(3) << 1, -1, -1).finished();
  std::vector<Impulse> impulses;
  ASSERT_TRUE(cascade(G, u, VecX::Zero(3), VecX::Ones(3), {}, impulses));
  EXPECT_EQ(impulses[0].pair, 1);
}

TEST(Cascade, MaxImpulsesAreTheMostAndRestIsNoApproach) {
  const MatX G = (MatX(2, 2) << 2, -1, -1, 2).finished();  // three balls in a row: three impulses
  for (int most = 1; most <= 3; ++most) {
    VecX u = (VecX(2) << -1, -1).finished();
    std::vector<Impulse> impulses;
    EXPECT_EQ(cascade(G, u, VecX::Zero(2), VecX::Ones(2), {.max_impulses = most}, impulses),
              most == 3);
    EXPECT_EQ(impulses.size(), static_cast<std::size_t>(most));
  }
  VecX u = (VecX(2) << -1, -1).finished();
  std::vector<Impulse> impulses;
  EXPECT_TRUE(cascade(G, u, VecX::Ones(2), VecX::Ones(2), {}, impulses));
  EXPECT_TRUE(impulses.empty());
}

}  // namespace
}  // namespace saltus
