// Contacts that hit together (ImpactOrder::symmetric) and come to rest together (all e = 0),
// against the conditions of generalized_reflections.hpp: M, N and v at random, no scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "random_contacts.hpp"
#include "saltus/error.hpp"
#include "saltus/variational/cascade.hpp"

namespace saltus {
namespace {

constexpr int sizes[] = {1, 2, 3, 4, 6, 9, 14, 22, 34, 60};

/// So many that no more than some four contacts share a degree of freedom: of 9600 problems with up
/// to ten, contact_multipliers() gave up 120 of 22 contacts and more.
int bodies_for(int contacts, int trial) { return 1 + trial % 4 + contacts / 10; }

constexpr double promised = 1e-10;  ///< of the largest rate: contact_multipliers()

/// Impulses of one round, and the rates before and after it.
struct Round {
  VecX before, p, after;
  bool ended = false;
};

/// max_impulses = 1 ends after the first round.
Round first_round(const MatX& G, const VecX& u, const VecX& e) {
  Round out{u, VecX::Zero(u.size()), u, false};
  std::vector<Impulse> impulses;
  const CascadeOptions options{ImpactOrder::symmetric, 1};
  out.ended = cascade(G, out.after, VecX::Zero(u.size()), e, options, impulses);
  for (const Impulse& each : impulses) out.p[each.pair] += each.lambda;
  return out;
}

/// With G scaled to ones, so that rates and impulses have one size.
NormalContacts scaled(NormalContacts c) {
  const VecX root = c.G().diagonal().cwiseSqrt();
  c.N = root.cwiseInverse().asDiagonal() * c.N;
  return c;
}

/// lambda = p / (1 + e) takes the approaching contacts to the face of their cone that is nearest.
void expect_reflection(const MatX& G, const Round& r, double e) {
  const VecX lambda = r.p / (1 + e), w = r.before + G * lambda;
  const double size = std::max(r.before.cwiseAbs().maxCoeff(), lambda.cwiseAbs().maxCoeff());
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    EXPECT_GE(lambda[i], 0);
    if (!(r.before[i] < 0)) {
      EXPECT_EQ(lambda[i], 0);  // it does not approach
    } else {
      EXPECT_GE(w[i], -promised * size);
    }
    if (lambda[i] > 0) {
      EXPECT_NEAR(w[i], 0, promised * size);
    }
  }
  EXPECT_LE((r.after - r.before - G * r.p).cwiseAbs().maxCoeff(), promised * size);
}

TEST(Together, ARoundReflectsAllThatApproachInTheNearestFace) {
  std::mt19937 random(1);
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 12; ++trial) {
      const RandomContacts of{contacts, bodies_for(contacts, trial), trial % 3 * 1.0, 0,
                              trial % 4 == 3};
      const NormalContacts c = scaled(random_normals(of, random));
      const double e = trial % 2 == 0 ? 1 : 0.6;
      const MatX G = c.G();
      expect_reflection(G, first_round(G, c.N * c.v, VecX::Constant(contacts, e)), e);
    }
  }
}

/// Unlike contacts: each loses the part 1 - e_i^2 of the energy lambda_i |u_i| / 2 that went into
/// it.
TEST(Together, UnlikeContactsShareARestitutionByEnergy) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit;
  for (const int contacts : {1, 2, 3, 4, 6, 9, 14}) {
    for (int trial = 0; trial < 12; ++trial) {
      const NormalContacts c = scaled(random_normals({contacts, 1, 0.5, 0}, random));
      const MatX G = c.G();  // one body: all feel each other
      const VecX e = VecX::NullaryExpr(contacts, [&] { return unit(random); });
      const Round r = first_round(G, c.N * c.v, e);
      if (r.p.isZero(0)) continue;
      Eigen::Index most = 0;
      r.p.maxCoeff(&most);
      const double shared = -(G * r.p)[most] / r.before[most] - 1;
      const VecX lambda = r.p / (1 + shared), in = -lambda.cwiseProduct(r.before);
      EXPECT_NEAR(shared * shared, e.cwiseAbs2().dot(in) / in.sum(), 1e-9);  // a quotient of rates
      expect_reflection(G, r, shared);
      const double change = r.before.dot(r.p) + r.p.dot(G * r.p) / 2;
      const double lost = (1 - e.array().square()).matrix().dot(in) / 2;
      EXPECT_NEAR(change, -lost, 1e-9 * in.sum());
    }
  }
}

TEST(Together, RoundsEndSeparateAndKeepTheEnergy) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit;
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 6; ++trial) {
      const RandomContacts of{contacts, 2 + contacts / 3, trial % 3 * 1.0, 0, false, true};
      const NormalContacts c = random_normals(of, random);
      const VecX scale = c.G().diagonal().cwiseSqrt() * std::sqrt(2 * c.energy(c.v));
      const CascadeOptions symmetric{ImpactOrder::symmetric, 100000};
      for (const bool elastic : {true, false}) {
        const VecX e =
            VecX::NullaryExpr(contacts, [&] { return elastic ? 1.0 : 0.5 + 0.5 * unit(random); });
        const ImpactOutcome out = resolve_impact(c.M, c.N, c.v, e, symmetric);
        EXPECT_GE((c.N * out.v).cwiseQuotient(scale).minCoeff(), -promised);
        EXPECT_LE(c.energy(out.v), c.energy(c.v) * (1 + 1e-12));  // rounding of some 100 rounds
        if (elastic) {
          EXPECT_GE(c.energy(out.v), c.energy(c.v) * (1 - 1e-12));
        }
        VecX p = c.M * (out.v - c.v);
        for (const Impulse& each : out.impulses) {
          EXPECT_GT(each.lambda, 0);
          p -= each.lambda * c.N.row(each.pair).transpose();
        }
        EXPECT_LE(p.norm(), 1e-11 * (c.M * c.v).norm());  // likewise
      }
    }
  }
}

/// The list has no say: contacts in another order come to the same velocity.
TEST(Together, TheOrderOfTheListDoesNotMatter) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const int contacts = 2 + trial % 8;
    const NormalContacts c = random_normals({contacts, 4, 0, 0, false, true}, random);
    std::vector<int> shuffled(static_cast<std::size_t>(contacts));
    std::iota(shuffled.begin(), shuffled.end(), 0);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    const MatX N = c.N(shuffled, Eigen::all);
    const CascadeOptions symmetric{ImpactOrder::symmetric, 1000};
    const VecX a = resolve_impact(c.M, c.N, c.v, 1, symmetric).v;
    const VecX b = resolve_impact(c.M, N, c.v, 1, symmetric).v;
    EXPECT_LE(c.energy(a - b), promised * promised * c.energy(c.v)) << trial;
  }
}

/// Contacts that do not feel each other are rounds of their own: as each half by itself.
TEST(Together, ContactsApartDoNotShare) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    const int m = 2 + trial % 4;
    const MatX A = random_normals({m, 2, 0, 0}, random).G();
    const MatX B = random_normals({m, 2, 0, 0}, random).G();
    MatX G = MatX::Zero(2 * m, 2 * m);
    G.topLeftCorner(m, m) = A;
    G.bottomRightCorner(m, m) = B;
    VecX u(2 * m), e(2 * m);
    u << -A.rowwise().sum(), -B.rowwise().sum();  // in the range of G
    e << VecX::Ones(m), VecX::Constant(m, 0.5);
    const Round both = first_round(G, u, e), a = first_round(A, u.head(m), e.head(m)),
                b = first_round(B, u.tail(m), e.tail(m));
    EXPECT_EQ(both.after.head(m), a.after) << trial;
    EXPECT_EQ(both.after.tail(m), b.after) << trial;
  }
}

/// e = 0: 0 <= lambda, N v+ >= 0, one of both 0. All contacts take part, jammed or not.
TEST(Together, WithoutReboundItIsTheProjection) {
  std::mt19937 random(6);
  for (const int contacts : sizes) {
    if (contacts == 1) continue;  // a contact by itself is a cascade of one impulse
    for (int trial = 0; trial < 12; ++trial) {
      const RandomContacts of{contacts, bodies_for(contacts, trial), trial % 3 * 1.0, 0,
                              trial % 2 == 1};
      const NormalContacts c = scaled(random_normals(of, random));
      const MatX G = c.G();
      const Round r = first_round(G, c.N * c.v, VecX::Zero(contacts));
      EXPECT_TRUE(r.ended);
      const VecX w = r.before + G * r.p;
      const double size = std::max(r.before.cwiseAbs().maxCoeff(), r.p.maxCoeff());
      EXPECT_GE(r.p.minCoeff(), 0);
      EXPECT_GE(w.minCoeff(), -promised * size) << contacts << " " << trial;
      EXPECT_LE(w.cwiseProduct(r.p).cwiseAbs().maxCoeff(), promised * size * size);
    }
  }
}

}  // namespace
}  // namespace saltus
