// Impacts of bodies that turn: symplectic steps, momenta, energies under every law that takes
// balls.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/scenes.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

/// A free body with an arm on a ball joint; a sphere off the body's centre meets the floor.
Model lopsided() {
  ModelBuilder b("lopsided");
  BodyInertia body = solid_box(1.0, Vec3(0.1, 0.2, 0.15)),
              arm = solid_box(0.4, Vec3(0.05, 0.05, 0.2));
  arm.c_J = Vec3(0, 0, 0.25);
  b.add_link({"body", body}).add_link({"arm", arm});
  b.add_joint({.name = "free", .type = JointType::floating, .parent = "world", .child = "body"});
  b.add_joint({.name = "hip",
               .type = JointType::spherical,
               .parent = "body",
               .child = "arm",
               .X_PJ = {Mat3::Identity(), Vec3(0, 0.1, 0.1)}});
  b.add_shape("body", Sphere{0.1}, {Mat3::Identity(), Vec3(0.15, 0.1, -0.1)});
  b.add_half_space("floor", Vec3::UnitZ());
  return b.build();
}

/// A state whose next step of 0.02 s has one impact, well inside.
State before_impact(const Model& model, double h) {
  VecX q = model.neutral(), v(9);
  q.segment<4>(3) = Quaternion(rotation_from_rpy(0.4, -0.3, 1.1)).coeffs();
  v << 0.3, -0.2, -1.5, 1, 2, -1, 0.5, -1.5, 1;
  q[2] = 1;
  const Gaps gaps = model.gaps(q);
  q[2] -= gaps.phi[0];
  const double u = gaps.phi_q.row(0).dot(v);
  q[2] += -u * 0.4 * h;  // it closes after 0.4 of the step
  return model.state(q, v);
}

/// The form that steps keep, on (eta, dp): one-degree joints [0 -1; 1 0], balls [-[p] -1; 1 0].
MatX form(const Model& model, const VecX& p) {
  const int n = model.n_v();
  MatX O = MatX::Zero(2 * n, 2 * n);
  O.topRightCorner(n, n) = -MatX::Identity(n, n);
  O.bottomLeftCorner(n, n) = MatX::Identity(n, n);
  for (const Ball& ball : model->tree.balls) {
    const int k = ball.velocity;
    O.block<3, 3>(k, k) = -cross_matrix(p.segment<3>(k));
  }
  return O;
}

/// (eta, dp) after by (eta, dp) before one step, by central differences of order 8.
MatX step_derivative(Stepper& stepper, const State& start, const State& end) {
  const Model& model = stepper.model();
  const int n = model.n_v();
  MatX D(2 * n, 2 * n);
  for (int i = 0; i < 2 * n; ++i) {
    D.col(i) = test::derivative(
        [&](double by) {
          State state = start;
          if (i < n) {
            state.q = model.integrate(start.q, VecX(by * VecX::Unit(n, i)));
          } else {
            state.p[i - n] += by;
          }
          state = stepper.advance(state);
          EXPECT_EQ(stepper.report().impacts.size(), 1u) << "the stencil leaves the impact's step";
          VecX out(2 * n);
          out << model.difference(end.q, state.q), state.p - end.p;
          return out;
        },
        4e-4);  // (4e-4)^8 of the eighth derivative against 1e-15 / 4e-4 of rounding
  }
  return D;
}

double symplectic_defect(ImpactLaw law, double h) {
  const Model model = lopsided();
  Stepper stepper(model, {.h = h, .law = law});
  const State start = before_impact(model, h);
  const State end = stepper.advance(start);
  EXPECT_EQ(stepper.report().impacts.size(), 1u);
  EXPECT_FALSE(stepper.report().impacts[0].fallback);
  const MatX D = step_derivative(stepper, start, end);
  return (D.transpose() * form(model, end.p) * D - form(model, start.p)).cwiseAbs().maxCoeff();
}

TEST(BallImpacts, ThePapersLawIsExactlySymplectic) {
  EXPECT_LT(symplectic_defect(ImpactLaw::discrete_energy, 0.02), 1e-9);
  // what is of order h^2 only, as it should be, tells that the test can fail
  EXPECT_GT(symplectic_defect(ImpactLaw::nodal_energy, 0.02), 1e-6);
}

// Energy over many impacts, by law: bounded, and smaller with the step as the law says.
TEST(BallImpacts, EnergyStaysOverManyImpacts) {
  const Model model = lopsided();
  for (const ImpactLaw law :
       {ImpactLaw::nodal_energy, ImpactLaw::shadow_energy, ImpactLaw::discrete_energy}) {
    const double h = 0.002;
    State state = before_impact(model, h);
    const double H = model.kinetic_energy(state) + model.potential_energy(state.q);
    const double px = state.p[0], py = state.p[1];
    Stepper stepper(model, {.h = h, .law = law});
    int impacts = 0;
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
      stepper.step(state);
      impacts += static_cast<int>(stepper.report().impacts.size());
      const double now = model.kinetic_energy(state) + model.potential_energy(state.q);
      worst = std::max(worst, std::abs(now - H));
    }
    EXPECT_GT(impacts, 5);
    EXPECT_LT(worst, (law == ImpactLaw::discrete_energy ? 0.1 : 0.02) * std::abs(H))
        << law_name(law);
    EXPECT_NEAR(state.p[0], px, 1e-12);  // the floor has no friction
    EXPECT_NEAR(state.p[1], py, 1e-12);
  }
}

// A box on its corners through all attitudes: energy, horizontal momentum, and the angular momentum
// about the vertical through its centre.
TEST(BallImpacts, ABouncingBoxKeepsWhatAFloorCannotChange) {
  ModelBuilder b("box");
  b.add_body({.name = "box", .shape = Box{Vec3(0.1, 0.2, 0.3)}, .mass = 1});
  const Model model = b.add_half_space("floor", Vec3::UnitZ()).build();
  VecX q = model.neutral(), v(6);
  q[2] = 1;
  q.tail<4>() = Quaternion(rotation_from_rpy(0.3, 0.5, 0.2)).coeffs();
  v << 0.4, 0.1, 0, 0.5, 4, 0.3;
  State state = model.state(q, v);
  const State start = state;
  const double H = model.kinetic_energy(state) + model.potential_energy(state.q);
  Stepper stepper(model, {.h = 0.005});
  int impacts = 0;
  for (int k = 0; k < 1000; ++k) {
    stepper.step(state);
    impacts += static_cast<int>(stepper.report().impacts.size());
    const double now = model.kinetic_energy(state) + model.potential_energy(state.q);
    ASSERT_NEAR(now, H, 1e-2 * H) << k;  // a band of (h w)^2, with w up to 10 rad/s
  }
  EXPECT_GT(impacts, 8);
  EXPECT_NEAR(state.p[0], start.p[0], 1e-13);
  EXPECT_NEAR(state.p[1], start.p[1], 1e-13);
  EXPECT_NEAR(state.p[5], start.p[5], 1e-12);
}

}  // namespace
}  // namespace saltus
