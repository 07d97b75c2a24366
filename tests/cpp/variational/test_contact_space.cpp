// Whatever the contacts: an impact ends open, keeps its energy and pushes only, or the bodies jam.
#include <gtest/gtest.h>

#include "kit/contact_problems.hpp"
#include "saltus/error.hpp"
#include "saltus/variational/cascade.hpp"
#include "saltus/variational/certificate.hpp"

namespace saltus {
namespace {

struct Problem {
  MatX M, N;
  VecX v;
  double interior;
};

/// Masses over six decades, 2 to 12 contacts, some with normals that are equal, opposite or nearly.
Problem random_problem(int trial, std::mt19937& random) {
  std::uniform_real_distribution<double> decade(-3, 3);
  const int n = 2 + trial % 11, m = 2 + (trial / 11) % 11;
  VecX mass(n);
  for (double& x : mass) x = std::pow(10, decade(random));
  Problem p{mass.asDiagonal(), random_matrix(m, n, random), random_vector(n, random), 0};
  switch (trial % 7) {
    case 0:
      p.N.row(1) = 3 * p.N.row(0);
      break;
    case 1:
      p.N.row(1) = -p.N.row(0);
      break;
    case 2:
      p.N.row(1) = p.N.row(0) + 1e-3 * p.N.row(1);
      break;
    case 3:
      p.N.row(1) = -p.N.row(0) + 1e-1 * p.N.row(1);
      break;
    default:
      break;
  }
  p.interior = classify_impact(p.M, p.N).interior;
  return p;
}

/// @return false where the impulses do not end
bool holds(const Problem& p, ImpactOrder order, double e, int max_impulses) {
  ImpactOutcome out;
  try {
    out = resolve_impact(p.M, p.N, p.v, e, {.order = order, .max_impulses = max_impulses});
  } catch (const JammedError&) {
    return false;
  }
  const double before = kinetic_norm(p.M, p.v), after = kinetic_norm(p.M, out.v);
  if (e == 1) {
    EXPECT_NEAR(after, before, 1e-12 * before);  // 4502 impulses round to 3e-13
  } else {
    EXPECT_LE(after, before * (1 + 1e-12));
  }
  const VecX root =
      (p.N * p.M.diagonal().cwiseInverse().asDiagonal() * p.N.transpose()).diagonal().cwiseSqrt();
  EXPECT_GE((p.N * out.v).cwiseQuotient(root).minCoeff(), -1e-10 * before);
  VecX gained = p.M * (out.v - p.v);
  double pushed = 0;
  for (const Impulse& impulse : out.impulses) {
    EXPECT_GT(impulse.lambda, 0);
    gained -= impulse.lambda * p.N.row(impulse.pair).transpose();
    pushed += impulse.lambda * p.N.row(impulse.pair).norm();
  }
  EXPECT_LE(gained.norm(), 1e-13 * (pushed + (p.M * p.v).norm()));
  return true;
}

TEST(ContactSpace, RandomImpactsEndOrTheirConeHasNoInteriorOrIsNarrow) {
  std::mt19937 random(8);
  int ended = 0, jammed = 0, narrow = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Problem p = random_problem(trial, random);
    for (const ImpactOrder order :
         {ImpactOrder::fastest, ImpactOrder::index, ImpactOrder::symmetric}) {
      const bool together = order == ImpactOrder::symmetric;  // a round costs a QP
      if (holds(p, order, 1, together ? 300 : 5000)) {
        ++ended;
      } else if (p.interior == 0) {
        ++jammed;
      } else {  // a cone that is open a little takes thousands of impulses, as Galperin's does
        EXPECT_LT(p.interior, .01) << trial;
        ++narrow;
      }
    }
  }
  EXPECT_GT(ended, 1000);
  EXPECT_GT(jammed, 300);
  EXPECT_LT(narrow, 150);
  RecordProperty("ended", ended);
  RecordProperty("jammed", jammed);
  RecordProperty("narrow", narrow);
}

TEST(ContactSpace, RestitutionLosesEnergyAndPlasticImpactsAlwaysEnd) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 300; ++trial) {
    const Problem p = random_problem(trial, random);
    EXPECT_TRUE(holds(p, ImpactOrder::fastest, 0, 1)) << trial;
    if (p.interior > .05) {
      EXPECT_TRUE(holds(p, ImpactOrder::fastest, .5, 5000)) << trial;
    }
  }
}

TEST(ContactSpace, InfinitelyManyImpulsesBelowOneRestitution) {
  // [1, 0, -1] for e < 7 - 4 sqrt(3) = .0717968: each impulse leaves a part of the rate, so that a
  // rest that is a thousandth as large takes more impulses, and above it does not
  const auto impulses = [](double e, double rest) {
    const MatX G = (MatX(2, 2) << 2, -1, -1, 2).finished();
    VecX u = vec({-1, -1});
    std::vector<Impulse> out;
    EXPECT_TRUE(cascade(G, u, VecX::Constant(2, rest), VecX::Constant(2, e), {}, out));
    return out.size();
  };
  const double limit = 7 - 4 * std::sqrt(3.);
  for (const double e : {.01, .05, limit - 1e-3}) {
    EXPECT_GE(impulses(e, 1e-12), impulses(e, 1e-9) + 3);
    EXPECT_GE(impulses(e, 1e-300), 300u);
  }
  for (const double e : {.08, .1, .5, .9}) {
    EXPECT_EQ(impulses(e, 1e-12), impulses(e, 1e-300));
  }
}

TEST(ContactSpace, ImpulsesAreNeverMoreThanTheCertificateSays) {
  std::mt19937 random(10);
  for (const Diagram& diagram : finite_diagrams()) {
    const MatX N = normals(gram(diagram)), M = MatX::Identity(diagram.rank, diagram.rank);
    const auto most = static_cast<std::size_t>(*classify_impact(M, N).impulses);
    for (int trial = 0; trial < 50; ++trial) {
      const VecX v = random_vector(diagram.rank, random);
      const ImpactOutcome fastest = resolve_impact(M, N, v);
      const ImpactOutcome index = resolve_impact(M, N, v, 1, {.order = ImpactOrder::index});
      expect_near(fastest.v, index.v, 1e-12);
      EXPECT_EQ(fastest.impulses.size(), index.impulses.size());
      EXPECT_LE(fastest.impulses.size(), most) << diagram.type;
    }
  }
}

TEST(ContactSpace, ABilliardInACircleKeepsItsAngularMomentum) {
  // a point bounces inside the unit circle: each hit is an impact with one contact, -x / |x|
  VecX x = vec({.3, -.2}), v = vec({.6, .8});
  const double momentum = x[0] * v[1] - x[1] * v[0];
  for (int hit = 0; hit < 10000; ++hit) {
    const double b = x.dot(v), t = -b + std::sqrt(b * b + 1 - x.squaredNorm());
    x += t * v;
    x.normalize();
    v = resolve_impact(MatX::Identity(2, 2), MatX(-x.transpose()), v).v;
    v.normalize();
    EXPECT_NEAR(x[0] * v[1] - x[1] * v[0], momentum, 1e-11);
  }
}

}  // namespace
}  // namespace saltus
