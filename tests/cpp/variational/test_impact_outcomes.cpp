// All outcomes of one impact: every order of impulses, searched.
#include <gtest/gtest.h>

#include <algorithm>

#include "kit/contact_problems.hpp"
#include "saltus/error.hpp"
#include "saltus/variational/certificate.hpp"
#include "saltus/variational/outcomes.hpp"

namespace saltus {
namespace {

ImpactOutcomes outcomes(const MatX& N, const VecX& v, double e = 1,
                        const OutcomesOptions& options = {}) {
  return impact_outcomes(MatX::Identity(v.size(), v.size()), N, v, e, options);
}

/// v with these gap rates.
VecX with_rates(const MatX& N, const VecX& u) { return N.colPivHouseholderQr().solve(u); }

TEST(Outcomes, BernoullisProblemHasTwoThatMirrorEachOther) {
  VecX v = VecX::Zero(6);
  v[0] = 2;
  const ImpactOutcomes all = outcomes(bernoulli(), v);
  ASSERT_EQ(all.outcomes.size(), 2u);
  const double y = std::sqrt(3.) / 4;  // .433013
  // lower target first: it takes everything along the normal, (1.5, -.866025)
  expect_near(all.outcomes[0].v.head<2>(), vec({-.25, y}), 1e-15);
  expect_near(all.outcomes[1].v.head<2>(), vec({-.25, -y}), 1e-15);
  EXPECT_EQ(all.outcomes[0].impulses.size(), 2u);
  const double apart = (all.outcomes[0].v - all.outcomes[1].v).norm();
  EXPECT_NEAR(all.spread, apart, 1e-15);
  EXPECT_NEAR(all.relative_spread, apart / 2, 1e-15);
  EXPECT_EQ(all.states, 5);
}

TEST(Outcomes, EqualBallsInLineMeetEveryPermutationAndEndSorted) {
  long factorial = 1;
  for (int balls = 2; balls <= 7; ++balls) {
    factorial *= balls;
    const VecX v = VecX::LinSpaced(balls, 1, -.7);
    const ImpactOutcomes all = outcomes(line(balls), v);
    ASSERT_EQ(all.outcomes.size(), 1u);
    expect_near(all.outcomes[0].v, v.reverse(), 1e-14);
    EXPECT_EQ(all.outcomes[0].impulses.size(), static_cast<std::size_t>(balls * (balls - 1) / 2));
    EXPECT_EQ(all.states, factorial);
    EXPECT_EQ(all.spread, 0);
  }
}

TEST(Outcomes, FiniteGroupsMeetEachOfTheirElementsOnce) {
  const std::vector<std::pair<std::string, long>> orders{
      {"A3", 24},  {"B3", 48},   {"H3", 120},  {"A4", 120},   {"B4", 384},
      {"D4", 192}, {"F4", 1152}, {"D5", 1920}, {"H4", 14400}, {"E6", 51840}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> rate(-1, -.1);
  for (const Diagram& diagram : finite_diagrams()) {
    const auto order = std::find_if(orders.begin(), orders.end(),
                                    [&](const auto& each) { return each.first == diagram.type; });
    if (order == orders.end()) continue;
    const MatX N = normals(gram(diagram));
    VecX u(diagram.rank);
    for (double& x : u) x = rate(random);
    const ImpactOutcomes all = outcomes(N, with_rates(N, u));
    ASSERT_EQ(all.outcomes.size(), 1u) << diagram.type;
    EXPECT_EQ(all.outcomes[0].impulses.size(), static_cast<std::size_t>(diagram.impulses));
    EXPECT_EQ(all.states, order->second) << diagram.type;
  }
}

TEST(Outcomes, RestitutionOfThreeBalls) {
  const ImpactOutcomes all = outcomes(line(3), vec({1, 0, -1}), .5);
  ASSERT_EQ(all.outcomes.size(), 2u);
  expect_near(all.outcomes[0].v, vec({-.359375, .046875, .3125}), 1e-15);
  expect_near(all.outcomes[1].v, vec({-.3125, -.046875, .359375}), 1e-15);
  EXPECT_EQ(outcomes(line(3), vec({1, 0, -1}), 0).outcomes.size(), 1u);
  expect_near(outcomes(line(3), vec({1, 0, 0}), 0).outcomes[0].v, VecX::Constant(3, 1. / 3), 1e-15);
}

TEST(Outcomes, NothingApproaches) {
  const ImpactOutcomes all = outcomes(line(3), vec({0, 0, 1}));
  ASSERT_EQ(all.outcomes.size(), 1u);
  EXPECT_EQ(all.outcomes[0].v, vec({0, 0, 1}));
  EXPECT_TRUE(all.outcomes[0].impulses.empty());
  EXPECT_EQ(outcomes(MatX(0, 2), vec({1, 2})).outcomes.size(), 1u);
}

template <class Error>
std::string message(const MatX& N, const VecX& v, const OutcomesOptions& options = {}) {
  try {
    outcomes(N, v, 1, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Outcomes, JammedBodiesAndBoundsAreTold) {
  const MatX walls = (MatX(2, 1) << 1, -1).finished();
  EXPECT_EQ(message<JammedError>(walls, vec({1})),
            "an order of impulses leads back, by 2 impulses, to a velocity that it has come from: "
            "bodies jammed between others");
  // inside a tetrahedron that is not regular: never the same velocity twice
  MatX tetrahedron(4, 3);
  tetrahedron << 1, .1, .2, -.3, 1, .1, -.2, -.4, 1, -.6, -.5, -1.1;
  EXPECT_EQ(message<JammedError>(tetrahedron, vec({1, .37, -.2}), {.max_states = 500}),
            "no velocity opens all 4 gaps: bodies jammed between others; 500 velocities were met "
            "and there may be no end");
  const VecX falling = VecX::LinSpaced(6, 1, 0);
  EXPECT_EQ(message<ModelError>(line(6), falling, {.max_states = 100}),
            "the orders of impulses on 5 contacts lead to more than max_states = 100 velocities: "
            "raise max_states, or ask classify_impact");
  VecX v = VecX::Zero(6);
  v[0] = 2;
  EXPECT_NE(message<ModelError>(bernoulli(), v, {.max_outcomes = 1}).find("1 outcomes"),
            std::string::npos);
  EXPECT_NE(message<ModelError>(bernoulli(), v, {.tolerance = 0}).find("[1e-12, 1e-3]"),
            std::string::npos);
}

TEST(Outcomes, ALongCascadeIsNoDeepRecursion) {
  const MatX N = (MatX(2, 2) << 1, 0, -1, 1).finished();  // wall | small | big, as Galperin's
  const MatX M = vec({1, 1e8}).asDiagonal();
  const ImpactOutcomes all = impact_outcomes(M, N, vec({0, -1}));
  ASSERT_EQ(all.outcomes.size(), 1u);
  EXPECT_EQ(all.outcomes[0].impulses.size(), 31415u);
}

TEST(Outcomes, OneForAllVelocitiesExactlyWhereTheCertificateSaysUnique) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> decade(-1, 1), part(.2, 3);
  int unique = 0, dependent = 0;
  for (int trial = 0; trial < 60; ++trial) {
    MatX N;
    MatX M;
    if (trial % 3 == 0) {
      N = wedge(trial % 2 == 0 ? std::numbers::pi / (2 + trial % 7) : part(random));
      M = MatX::Identity(2, 2);
    } else {
      const int balls = 3 + trial % 2;
      VecX mass = VecX::Ones(balls);
      if (trial % 3 == 1)
        mass = mass.unaryExpr([&](double) { return std::pow(10, decade(random)); });
      N = line(balls);
      M = mass.asDiagonal();
    }
    const ImpactCertificate certificate = classify_impact(M, N);
    const bool is_unique = certificate.kind == ImpactKind::unique;
    (is_unique ? unique : dependent) += 1;
    std::size_t most = 0;
    for (int k = 0; k < 100; ++k) {
      const VecX u = -random_vector(static_cast<int>(N.rows()), random).cwiseAbs();
      const ImpactOutcomes all = impact_outcomes(M, N, with_rates(N, u));
      most = std::max(most, all.outcomes.size());
      for (const ImpactOutcome& each : all.outcomes) {
        if (certificate.impulses) {
          EXPECT_LE(each.impulses.size(), static_cast<std::size_t>(*certificate.impulses));
        }
      }
    }
    EXPECT_EQ(most == 1, is_unique) << trial;
  }
  EXPECT_GE(unique, 20);
  EXPECT_GE(dependent, 20);
}

}  // namespace
}  // namespace saltus
