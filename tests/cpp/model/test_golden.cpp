// Partials of two systems against 25 digits of an independent evaluation.
#include "golden.hpp"

#include <gtest/gtest.h>

#include "numeric.hpp"

namespace saltus {
namespace {

using test::relative_error;

TEST(Golden, SystemsAreWhatTheFileSays) {
  const std::vector<test::Golden> systems = test::golden_systems();
  ASSERT_EQ(systems.size(), 2u);
  EXPECT_EQ(systems[0].model->name, "chain3_mixed");
  EXPECT_EQ(systems[0].model.n_q(), 3);
  EXPECT_EQ(systems[0].model->tree.joint[1].kind, Joint::Kind::prismatic);
  EXPECT_EQ(systems[1].model.n_q(), 6);
  EXPECT_EQ(systems[1].model->coordinates[3].name, "b1");
  for (const test::Golden& system : systems) {
    EXPECT_EQ(system.model->mass.gravity, Vec3(0, 0, -9.8));
    EXPECT_EQ(system.from_rest.nodes.size(), 11u);
    EXPECT_EQ(system.from_state.nodes.back().step, 200);
    EXPECT_EQ(system.from_rest.start.p, VecX(VecX::Zero(system.model.n_q())));
  }
}

// The file's inputs are decimals, so a value keeps about 1e-16 times its condition; six joints and
// sums of terms that cancel leave 1e-15 or so.
TEST(Golden, PartialsAgreeToThirteenDigits) {
  constexpr double tolerance = 1e-13;
  for (const test::Golden& system : test::golden_systems()) {
    const LagrangianPartials L = system.model.lagrangian(system.q, system.v);
    EXPECT_NEAR(L.value, system.L.value, tolerance * std::abs(system.L.value));
    EXPECT_LT(relative_error(L.L_q, system.L.L_q), tolerance);
    EXPECT_LT(relative_error(L.L_v, system.L.L_v), tolerance);
    EXPECT_LT(relative_error(L.L_qq, system.L.L_qq), tolerance);
    EXPECT_LT(relative_error(L.L_vq, system.L.L_vq), tolerance);
    EXPECT_LT(relative_error(L.L_vv, system.L.L_vv), tolerance);
    EXPECT_LT(relative_error(system.model.mass_matrix(system.q), system.L.L_vv), tolerance);
  }
}

TEST(Golden, StateAndVelocityAreInverse) {
  for (const test::Golden& system : test::golden_systems()) {
    const State state = system.model.state(system.q, system.v);
    EXPECT_LT(relative_error(state.p, system.L.L_v), 1e-13);
    EXPECT_LT(relative_error(state.p, system.from_state.start.p), 1e-13);
    EXPECT_EQ(state.q, system.from_state.start.q);
    EXPECT_LT(relative_error(system.model.velocity(state), system.v), 1e-12);  // condition of M
  }
}

}  // namespace
}  // namespace saltus
