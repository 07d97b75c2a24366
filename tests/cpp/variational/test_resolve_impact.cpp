// Impulses at one instant against the answers that are known: the paper's section II, and the
// closed forms of theory.
#include <gtest/gtest.h>

#include <algorithm>

#include "kit/contact_problems.hpp"

namespace saltus {
namespace {

ImpactOutcome in_line(const VecX& masses, const VecX& v, double restitution = 1,
                      const CascadeOptions& options = {}) {
  return resolve_impact(MatX(masses.asDiagonal()), line(static_cast<int>(v.size())), v, restitution,
                        options);
}

struct LineCase {
  VecX v, after;
  int impulses;
};

TEST(ResolveImpact, EqualBallsInLineAsInThePaper) {
  const std::vector<LineCase> cases{{vec({1, 0, 0}), vec({0, 0, 1}), 2},
                                    {vec({1, 1, 0}), vec({0, 1, 1}), 2},
                                    {vec({1, 0, -1}), vec({-1, 0, 1}), 3},
                                    {vec({1, 0, 0, 0, 0}), vec({0, 0, 0, 0, 1}), 4},
                                    {vec({1, 1, 0, 0, 0}), vec({0, 0, 0, 1, 1}), 6},
                                    {vec({1, 1, 1, 0, 0}), vec({0, 0, 1, 1, 1}), 6}};
  for (const LineCase& c : cases) {
    const ImpactOutcome out = in_line(VecX::Ones(c.v.size()), c.v);
    expect_near(out.v, c.after, 1e-15);  // sums and differences of a few numbers of size 1
    EXPECT_EQ(out.impulses.size(), static_cast<std::size_t>(c.impulses));
  }
}

int inversions(const VecX& v) {
  int count = 0;
  for (int i = 0; i < v.size(); ++i) {
    for (int j = i + 1; j < v.size(); ++j) count += v[i] > v[j];
  }
  return count;
}

TEST(ResolveImpact, EqualBallsComeOutSortedInAnyOrder) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> speed(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const int balls = 2 + trial % 7;
    VecX v(balls);
    for (double& x : v) x = speed(random);
    VecX sorted = v;
    std::sort(sorted.begin(), sorted.end());
    for (const ImpactOrder order : {ImpactOrder::fastest, ImpactOrder::index}) {
      const ImpactOutcome out = in_line(VecX::Ones(balls), v, 1, {.order = order});
      expect_near(out.v, sorted, 1e-14);  // at most 28 impulses, each rounding by 1e-16
      EXPECT_EQ(out.impulses.size(), static_cast<std::size_t>(inversions(v)));
      for (const Impulse& impulse : out.impulses) EXPECT_GT(impulse.lambda, 0);
    }
  }
}

TEST(ResolveImpact, RandomImpactsConserveEnergyAndEndOpen) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 3 + trial % 6, contacts = 1 + trial % 3;  // fewer contacts than coordinates:
    MatX A(n, n), N(contacts, n);                           // the cone has an interior
    for (double& x : A.reshaped()) x = normal(random);
    for (double& x : N.reshaped()) x = normal(random);
    const MatX M = A * A.transpose() + MatX::Identity(n, n);
    VecX v(n);
    for (double& x : v) x = normal(random);
    const ImpactOutcome out = resolve_impact(M, N, v);
    const double before = v.dot(M * v), after = out.v.dot(M * out.v);
    EXPECT_NEAR(after, before, 1e-12 * before);  // rounding of a dozen impulses, M's condition 1e2
    EXPECT_GE((N * out.v).minCoeff(), -1e-10 * std::sqrt(before));
    // p+ - p- lies in the cone of the normals
    VecX p = M * (out.v - v);
    for (const Impulse& impulse : out.impulses) {
      EXPECT_GE(impulse.lambda, 0);
      p -= impulse.lambda * N.row(impulse.pair).transpose();
    }
    EXPECT_LE(p.norm(), 1e-11 * (M * v).norm());
  }
}

TEST(ResolveImpact, UnequalMassesWhereTheWedgeAngleIsPiOverM) {
  struct Case {
    int m;
    VecX after;
    int impulses;
  };
  const std::vector<Case> cases{{4, vec({-.1715728753, .8284271247, .8284271247}), 3},
                                {5, vec({0, 0, 1}), 4},
                                {6, vec({-.0717967697, .9282032303, .9282032303}), 5}};
  for (const Case& c : cases) {
    const double alpha = 1 / std::cos(std::numbers::pi / c.m) - 1;
    const ImpactOutcome out = in_line(vec({1, alpha, 1}), vec({1, 0, 0}));
    expect_near(out.v, c.after, 1e-10);  // the figures have ten digits
    EXPECT_EQ(out.impulses.size(), static_cast<std::size_t>(c.impulses));
  }
  expect_near(in_line(vec({1, .5, 1}), vec({1, 0, 0})).v, vec({-5. / 27, 16. / 27, 24. / 27}),
              1e-15);
}

TEST(ResolveImpact, GalperinsBilliardCountsTheDigitsOfPi) {
  const MatX N = (MatX(2, 2) << 1, 0, -1, 1).finished();  // wall | small | big
  const int digits[] = {3, 31, 314, 3141, 31415};
  for (int k = 0; k < 5; ++k) {
    const MatX M = vec({1, std::pow(100., k)}).asDiagonal();
    const ImpactOutcome out = resolve_impact(M, N, vec({0, -1}));
    EXPECT_EQ(out.impulses.size(), static_cast<std::size_t>(digits[k]));
    EXPECT_NEAR(kinetic_norm(M, out.v), kinetic_norm(M, vec({0, -1})), 1e-12 * std::sqrt(M(1, 1)));
  }
}

TEST(ResolveImpact, CoxeterGroupsTakeTheirLongestElement) {
  for (const Diagram& diagram : finite_diagrams()) {
    const MatX G = gram(diagram);
    for (const ImpactOrder order : {ImpactOrder::fastest, ImpactOrder::index}) {
      VecX u = -VecX::LinSpaced(diagram.rank, 1, 1.7);  // from minus the interior of the cone
      std::vector<Impulse> impulses;
      ASSERT_TRUE(cascade(G, u, VecX::Constant(diagram.rank, 1e-12), VecX::Ones(diagram.rank),
                          {.order = order}, impulses));
      EXPECT_EQ(impulses.size(), static_cast<std::size_t>(diagram.impulses)) << diagram.type;
      EXPECT_GT(u.minCoeff(), 0) << diagram.type;
    }
  }
}

TEST(ResolveImpact, BernoullisProblemGoesByTheOrder) {
  const MatX N = bernoulli();
  VecX v = VecX::Zero(6);
  v[0] = 2;
  const ImpactOutcome out = resolve_impact(MatX::Identity(6, 6), N, v);
  EXPECT_NEAR(out.v[0], -.25, 1e-15);
  EXPECT_NEAR(std::abs(out.v[1]), .433013, 1e-6);  // six digits known
  const MatX mirrored = N.colwise().reverse();
  EXPECT_NEAR(resolve_impact(MatX::Identity(6, 6), mirrored, v).v[1], -out.v[1], 1e-15);
}

TEST(ResolveImpact, Restitution) {
  const auto out = in_line(VecX::Ones(3), vec({1, 0, -1}), .5);
  expect_near(out.v, vec({-.359375, .046875, .3125}), 1e-15);
  EXPECT_EQ(out.impulses.size(), 3u);
  expect_near(in_line(VecX::Ones(3), vec({1, 0, -1}), .9).v, vec({-.854875, .002375, .8525}),
              1e-15);
}

TEST(ResolveImpact, RestitutionOfEachContact) {
  // the first contact loses what is normal to it, the second keeps everything
  const VecX e = vec({0, 1});
  const ImpactOutcome out = resolve_impact(MatX::Identity(3, 3), line(3), vec({1, 0, -1}), e);
  // [1, 0, -1] -> [.5, .5, -1] -> [.5, -1, .5] -> [-.25, -.25, .5]
  expect_near(out.v, vec({-.25, -.25, .5}), 1e-15);
  EXPECT_EQ(out.impulses.size(), 3u);
}

TEST(ResolveImpact, ARateAfterItsImpulseIsExact) {
  const MatX G = (MatX(2, 2) << .3, .1, .1, .7).finished();
  VecX u = vec({-.1, 5});
  std::vector<Impulse> impulses;
  ASSERT_TRUE(cascade(G, u, VecX::Zero(2), vec({.7, .2}), {}, impulses));
  EXPECT_EQ(u[0], .7 * .1);
}

TEST(ResolveImpact, BadProblemsAreNamed) {
  const MatX M = MatX::Identity(2, 2), N = line(2);
  const VecX v = vec({1, 0});
  const auto message = [](auto&& call) -> std::string {
    try {
      call();
    } catch (const ModelError& e) {
      return e.what();
    }
    return "";
  };
  const double nan = std::nan("");
  EXPECT_NE(message([&] { resolve_impact(MatX::Identity(3, 3), N, v); }).find("(3, 3)"),
            std::string::npos);
  EXPECT_NE(message([&] { resolve_impact(M, line(3), v); }).find("a row a contact"),
            std::string::npos);
  EXPECT_NE(message([&] { resolve_impact(M, N, vec({nan, 0})); }).find("not finite"),
            std::string::npos);
  EXPECT_NE(message([&] { resolve_impact(-M, N, v); }).find("positive definite"),
            std::string::npos);
  EXPECT_NE(message([&] {
              resolve_impact((MatX(2, 2) << 1, .1, 0, 1).finished(), N, v);
            }).find("not symmetric"),
            std::string::npos);
  EXPECT_NE(message([&] { resolve_impact(M, MatX::Zero(1, 2), v); }).find("row 0"),
            std::string::npos);
  EXPECT_NE(message([&] { resolve_impact(M, N, v, 1.5); }).find("1.5 of contact 0"),
            std::string::npos);
  EXPECT_NE(message([&] { resolve_impact(M, N, v, vec({1, 1})); }).find("2 entries; N has 1 row"),
            std::string::npos);
}

TEST(ResolveImpact, ABallJammedBetweenWallsIsAnErrorNotALoop) {
  const MatX N = (MatX(2, 1) << 1, -1).finished();
  try {
    resolve_impact(MatX::Identity(1, 1), N, vec({1}), 1, {.max_impulses = 1000});
    FAIL() << "expected JammedError";
  } catch (const JammedError& e) {
    EXPECT_EQ(e.iterations, 1000);
    EXPECT_STREQ(e.what(),
                 "the impact does not end within 1000 impulses: bodies jammed between others, no "
                 "velocity opens all 2 gaps");
  }
  try {  // Galperin's: 31415 impulses
    resolve_impact(MatX(vec({1, 1e8}).asDiagonal()), (MatX(2, 2) << 1, 0, -1, 1).finished(),
                   vec({0, -1}), 1, {.max_impulses = 1000});
    FAIL() << "expected JammedError";
  } catch (const JammedError& e) {
    EXPECT_NE(std::string(e.what()).find("no more than 5e-05 of |v|"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace saltus
