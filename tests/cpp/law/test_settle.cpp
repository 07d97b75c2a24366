// Contacts that come to rest together, against the law's own conditions.
#include <gtest/gtest.h>

#include "random_contacts.hpp"
#include "variational/law/friction_scratch.hpp"
#include "variational/law/pile.hpp"

namespace saltus {
namespace {

/// How far rates and impulses are from Coulomb's law, condition by condition. Contacts are scaled
/// so that a unit impulse changes a rate by 1 at most, and the whole by the largest of them.
double miss(const ContactsAtOnce& c, const std::vector<Vec3>& p) {
  const VecX rates = c.R * velocity_after(c, p);
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double scale = 1 / std::sqrt(c.W.own[i].diagonal().maxCoeff());
    const Vec3 u = scale * rates.segment<3>(3 * static_cast<Eigen::Index>(i)), q = p[i] / scale;
    const double mu = c.W.friction[i], speed = u.tail<2>().norm(), push = q.tail<2>().norm();
    size = std::max({size, u.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff()});
    worst = std::max({worst, -q[0], -u[0], push - mu * q[0], std::min(u[0], q[0])});
    // friction is at its limit, or nothing slides; it acts against what slides
    worst = std::max(worst, std::min(speed, mu * q[0] - push));
    const double along = u.tail<2>().dot(q.tail<2>());
    if (speed > 0 && mu * q[0] > 0) worst = std::max(worst, std::min(speed, along / speed + push));
  }
  return size > 0 ? worst / size : 0;
}

struct Result {
  Settled said;
  double missed, gain;
};

Result settle_from_nothing(ContactsAtOnce c) {
  PileScratch scratch;
  std::vector<Vec3> u = c.u, p(u.size(), Vec3::Zero());
  Result out{};
  out.said = settle_for_sure(c.W, scratch, u, p);
  out.missed = miss(c, p);
  const double before = kinetic_energy(c, c.v);
  out.gain = (kinetic_energy(c, velocity_after(c, p)) - before) / before;
  return out;
}

constexpr int sizes[] = {1, 2, 3, 4, 6, 9, 14, 22, 34, 60};

/// Without friction there is always an answer, however redundant, jammed or unlike.
TEST(Settle, WithoutFrictionAlways) {
  std::mt19937 random(1);
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 12; ++trial) {
      const RandomContacts of{contacts, 1 + trial % 4, trial % 3 * 1.5, 0, trial % 2 == 1};
      const Result r = settle_from_nothing(random_contacts(of, random));
      EXPECT_LE(r.said.residual, 1e-12) << contacts << " " << trial;
      EXPECT_LE(r.missed, 1e-9) << contacts << " "
                                << trial;  // masses are 1e3 apart: less its digits
      EXPECT_LE(r.gain, 1e-12);
    }
  }
}

/// With friction there may be none, and finding one is no theorem: all of these have one, found.
TEST(Settle, WithFrictionUpToTwo) {
  std::mt19937 random(2);
  for (const int contacts : sizes) {
    for (int trial = 0; trial < 24; ++trial) {
      const RandomContacts of{contacts, 1 + trial % 4, trial % 3 * 1.0, 1 + trial % 2 * 1.0,
                              trial % 4 == 3};
      const Result r = settle_from_nothing(random_contacts(of, random));
      EXPECT_LE(r.said.excess, small_residual) << contacts << " " << trial;
      // what it says, in other words: a residual of 1e-9 by unlike masses (1e2)
      EXPECT_LE(r.missed, 1e-7) << contacts << " " << trial;
      EXPECT_LE(r.gain, 1e-7);
    }
  }
}

/// Newton's matrix by the coordinates of bodies, in an order of its own, finds what that of W
/// finds: without friction the rates are unique, with it the law says.
TEST(Settle, ByBodiesAsByContacts) {
  std::mt19937 random(4);
  for (const int contacts : {9, 14, 22, 34, 60}) {
    for (int trial = 0; trial < 16; ++trial) {
      const double friction = trial % 2 * 0.7;
      const RandomContacts of{contacts, 1 + trial % 4, trial % 3 * 1.0, friction, trial % 4 == 3};
      ContactsAtOnce c = random_contacts(of, random);
      PileScratch scratch;
      std::vector<Vec3> u = c.u, p(c.u.size(), Vec3::Zero());
      settle_for_sure(c.W, scratch, u, p);
      add_factors(c);
      std::vector<Vec3> v = c.u, q(c.u.size(), Vec3::Zero());
      const Settled said = settle_for_sure(c.W, scratch, v, q);
      EXPECT_LE(said.excess, small_residual) << contacts << " " << trial;
      EXPECT_LE(miss(c, q), 1e-7) << contacts << " " << trial;
      for (std::size_t i = 0; friction == 0 && i < u.size(); ++i) {
        // both to a residual of 1e-9, by unlike masses (1e2)
        EXPECT_NEAR(u[i][0], v[i][0], 1e-7) << contacts << " " << trial << " " << i;
      }
    }
  }
}

/// Heaps: many contacts on few bodies, each of them redundant. Newton's method alone, which a step
/// begins with, settled 80 % of these where its rounds grew stiff too fast.
TEST(Settle, HeapsWithFriction) {
  std::mt19937 random(5);
  for (const int contacts : {40, 80, 120}) {
    for (const int bodies : {4, 8, 16}) {
      int unsettled = 0;
      for (int trial = 0; trial < 12; ++trial) {
        const RandomContacts of{contacts, bodies, trial % 3 * 0.5, 0.6, trial % 2 == 1};
        ContactsAtOnce c = random_contacts(of, random);
        add_factors(c);
        PileScratch scratch;
        std::vector<Vec3> u = c.u, p(c.u.size(), Vec3::Zero());
        if (!(settle_pile(c.W, scratch, u, p).excess <= small_residual)) ++unsettled;
      }
      EXPECT_LE(unsettled, 1) << contacts << " contacts on " << bodies;
    }
  }
}

/// Errors name the contact that is farthest from the law, wherever it is in the list.
TEST(Settle, TheMostLawlessIsNamed) {
  std::mt19937 random(3);
  for (int worst = 0; worst < 5; ++worst) {
    const ContactsAtOnce c = random_contacts({5, 3, 0, 0.5, false}, random);
    FrictionScratch x(true);
    x.W = c.W;
    x.u = c.u;
    x.p.assign(5, Vec3::Zero());
    settle_for_sure(x.W, x.pile, x.u, x.p);
    x.u[static_cast<std::size_t>(worst)][0] = -1;  // approaches, as if it had not been pushed
    EXPECT_EQ(most_lawless(x.W, x.u, x.p), worst);
  }
}

}  // namespace
}  // namespace saltus
