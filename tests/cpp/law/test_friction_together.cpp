// Contacts with friction that hit together (ImpactOrder::symmetric): impulses in their cones, none
// approaches after, no energy gained, and mirror images stay mirror images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random_contacts.hpp"
#include "saltus/variational/friction.hpp"

namespace saltus {
namespace {

constexpr CascadeOptions together{ImpactOrder::symmetric, 3000};

struct Outcome {
  bool ended = false;
  std::vector<Vec3> u;
  std::vector<FrictionImpulse> impulses;
};

Outcome resolve(const ContactBlocks& W, const std::vector<Vec3>& u) {
  Outcome out{false, u, {}};
  std::vector<Vec3> scratch;
  out.ended = collide(W, together, out.u, scratch, out.impulses);
  return out;
}

/// sum p.(u- + u+) / 2, u of the sum of all impulses.
double work(const std::vector<Vec3>& before, const Outcome& out) {
  std::vector<Vec3> p(before.size(), Vec3::Zero());
  for (const FrictionImpulse& each : out.impulses) p[each.contact] += each.p;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += p[i].dot(before[i] + out.u[i]) / 2;
  return sum;
}

TEST(FrictionTogether, ObeysConesAndGainsNoEnergy) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 240; ++trial) {
    RandomContacts of;
    of.contacts = 1 + trial % 12;
    of.bodies = 1 + trial % 3 + of.contacts / 6;
    of.friction = 1;
    ContactsAtOnce c = random_contacts(of, random);
    const double es[] = {0, 0.3, 0.9, 1};
    for (std::size_t i = 0; i < c.u.size(); ++i) {
      c.W.restitution[i] = es[(trial / 12 + (trial % 2 == 0 ? i : 0)) % 4];
      c.W.rest[i] = 1e-10;
    }
    const Outcome out = resolve(c.W, c.u);
    // what is jammed between others may rebound without end where it loses nothing
    const auto& e = c.W.restitution;
    const bool loses = std::any_of(e.begin(), e.end(), [](double each) { return each < 1; });
    EXPECT_TRUE(out.ended || !loses) << trial;
    EXPECT_LE(work(c.u, out), 1e-11 * kinetic_energy(c, c.v)) << trial;
    for (const FrictionImpulse& each : out.impulses) {
      const double mu = c.W.friction[each.contact];
      EXPECT_GE(each.p[0], 0);
      EXPECT_LE(each.p.tail<2>().norm(), mu * each.p[0] * (1 + 1e-12));
    }
    if (!out.ended) continue;
    for (const Vec3& u : out.u) EXPECT_GE(u[0], -1e-9) << trial;
  }
}

/// Two contacts of one body, each the other's image in y -> -y.
TEST(FrictionTogether, KeepsAMirror) {
  for (const double e : {0.0, 0.4, 0.8, 1.0}) {
    for (const double mu : {0.1, 0.5, 2.0}) {
      MatX R = MatX::Zero(6, 6);  // a body of unit mass and moments, points (0.3, -+1, -0.5)
      for (int i = 0; i < 2; ++i) {
        Mat3 axes;  // n up, tangents along x and y
        axes << Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY();
        add_body_rows(axes, Vec3(0.3, i == 0 ? -1 : 1, -0.5), 1, R.middleRows(3 * i, 3));
      }
      ContactBlocks W = contact_blocks(R * R.transpose());
      W.friction.assign(2, mu);
      W.restitution.assign(2, e);
      VecX v = VecX::Zero(6);
      v << 0.7, 0, -1, 0, 0.4, 0;  // of the mirror
      const VecX rates = R * v;
      const Outcome out = resolve(W, {rates.head<3>(), rates.tail<3>()});
      ASSERT_TRUE(out.ended);
      EXPECT_NEAR(out.u[0][0], out.u[1][0], 1e-13);
      EXPECT_NEAR(out.u[0][1], out.u[1][1], 1e-13);
      EXPECT_NEAR(out.u[0][2], -out.u[1][2], 1e-13);
    }
  }
}

}  // namespace
}  // namespace saltus
