// The paper's law (11c): exactly symplectic, and what it conserves.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;

/// Two unequal pendulums in the plane, 1 mm apart at rest.
Model unequal_pendulums() {
  return cradle({.balls = 2, .gap = 1e-3, .masses = {1, 0.6}, .sways = false});
}

/// d(q, p) after / d(q, p) before one step, by central differences of order 8.
MatX step_derivative(Stepper& stepper, const State& start) {
  const double delta = 2e-3;  // (2e-3)^8 of the eighth derivative against 1e-15 / 2e-3 of rounding
  const double weight[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
  const auto n = start.q.size();
  MatX D = MatX::Zero(2 * n, 2 * n);
  const auto image = [&](int i, double by) {
    State state = start;
    (i < n ? state.q[i] : state.p[i - n]) += by;
    state = stepper.advance(state);
    EXPECT_EQ(stepper.report().impacts.size(), 1u) << "the stencil leaves the step with the impact";
    return (VecX(2 * n) << state.q, state.p).finished();
  };
  for (int i = 0; i < 2 * n; ++i) {
    for (int k = 1; k <= 4; ++k) {
      D.col(i) += weight[k - 1] * (image(i, k * delta) - image(i, -k * delta)) / delta;
    }
  }
  return D;
}

TEST(Stepper, ThePapersLawAndCompensatedAreExactlySymplecticAcrossAnImpact) {
  const Model model = unequal_pendulums();
  const auto defect = [&](ImpactLaw law) {
    Stepper stepper(model, {.h = 0.1, .law = law});
    const State start =
        model.state({{"swing_0", 0.06}, {"swing_1", 0.02}}, {{"swing_0", -1.1}, {"swing_1", 0.2}});
    const MatX D = step_derivative(stepper, start);
    MatX J = MatX::Zero(4, 4);
    J.topRightCorner(2, 2).setIdentity();
    J.bottomLeftCorner(2, 2) = -MatX::Identity(2, 2);
    EXPECT_EQ(stepper.report().impacts[0].law, law);
    return (D.transpose() * J * D - J).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(defect(ImpactLaw::discrete_energy), 1e-9);
  EXPECT_LT(defect(ImpactLaw::compensated), 1e-9);
  EXPECT_GT(defect(ImpactLaw::nodal_energy), 1e-7);  // O(h^2): the measure can tell them apart
  EXPECT_GT(defect(ImpactLaw::shadow_energy), 1e-7);
}

TEST(Stepper, ThePapersLawConservesTheDiscreteEnergyOfTheArcsAroundAnImpact) {
  const Model model = unequal_pendulums();
  const State start = model.state({{"swing_0", 0.06}}, {{"swing_0", -1.1}});
  Stepper stepper(model, {.h = 0.1, .law = ImpactLaw::discrete_energy});
  const State end = stepper.advance(start);
  ASSERT_EQ(stepper.report().impacts.size(), 1u);
  const double t = stepper.report().impacts[0].t;
  // The arc that hits, by itself: a step of length t without collisions has the same E_d.
  const auto E_d = [&](const State& from, const VecX& q_to, double tau) {
    const VecX v = (q_to - from.q) / tau, q = (q_to + from.q) / 2;
    const LagrangianPartials L = model.lagrangian(q, v);
    return v.dot(L.L_v) - L.value;
  };
  Stepper free(model, {.h = t, .collisions = false});
  const State hit = free.advance(start);
  EXPECT_NEAR(model.gaps(hit.q).phi[0], 0, 1e-13);
  EXPECT_NEAR(E_d(hit, end.q, 0.1 - t), E_d(start, hit.q, t), 1e-13);
}

}  // namespace
}  // namespace saltus
