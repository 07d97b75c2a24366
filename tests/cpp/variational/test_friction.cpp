// Friction of one contact: what a ball that slides, rolls, spins and bounces is known to do.
#include <gtest/gtest.h>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using namespace scenes;

/// A floor that falls towards +x by `angle`, as the direction up from it.
Vec3 slope(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

/// A ball of radius 0.1 that does not turn: a block, at rest on the slope.
State at_rest(const Model& model, double angle, double speed = 0) {
  const Vec3 at = 0.1 * slope(angle);
  return model.state({{"x", at.x()}, {"z", at.z()}},
                     {{"x", speed * std::cos(angle)}, {"z", -speed * std::sin(angle)}});
}

double way(const State& state, double angle) {
  return state.q[0] * std::cos(angle) - state.q[1] * std::sin(angle);
}

TEST(Friction, ABlockSlidesDownASlopeAsTheClosedFormSays) {
  const double angle = 0.6, mu = 0.3;
  const Model model = rolling_ball(0.1, {0, mu}, slope(angle), false);
  const State end = run_losing_energy(model, at_rest(model, angle), 1, 0.01);
  const double a = gravity * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR(way(end, angle), a / 2, 1e-12);  // a parabola: exact under the midpoint rule
  EXPECT_NEAR(model.velocity(end).norm(), a, 1e-12);
}

TEST(Friction, ABlockBelowTheAngleOfFrictionStays) {
  const double angle = 0.4;
  const Model model = rolling_ball(0.1, {0, std::tan(angle) * 1.001}, slope(angle), false);
  const State start = at_rest(model, angle);
  const State end = run_losing_energy(model, start, 10, 0.01);
  EXPECT_LE((end.q - start.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE(end.p.cwiseAbs().maxCoeff(), 1e-12);
}

// It stops within a step, of which up to h^2 mu g / 8 of its way is not told apart.
TEST(Friction, ABlockThatSlidesStopsAndStays) {
  const double angle = 0.2, mu = 0.5, v0 = 2;
  const Model model = rolling_ball(0.1, {0, mu}, slope(angle), false);
  const double a = gravity * (mu * std::cos(angle) - std::sin(angle));
  for (const double h : {0.02, 0.01, 0.0025}) {
    const State start = at_rest(model, angle, v0);
    const State stopped = run_losing_energy(model, start, 1, h);
    EXPECT_NEAR(way(stopped, angle), v0 * v0 / (2 * a), h * h * a / 8 + 1e-12);
    const State later = run_losing_energy(model, stopped, 10, h);
    EXPECT_LE((later.q - stopped.q).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// Friction takes from the speed what it gives to the spin: m v + I w / r is conserved exactly.
TEST(Friction, ABallThatSlidesEndsRollingAtFiveSevenths) {
  const double r = 0.1, mu = 0.2, v0 = 2;
  const Model model = rolling_ball(r, {0, mu});
  const State start = model.state({{"z", r}}, {{"x", v0}});
  const double t_roll = 2 * v0 / (7 * mu * gravity), x_roll = 12 * v0 * v0 / (49 * mu * gravity);
  double before = 0;
  for (const double h : {0.01, 0.0025}) {
    const State end = run_losing_energy(model, start, 1, h);
    const VecX v = model.velocity(end);
    EXPECT_NEAR(v[0], 5 * v0 / 7, 1e-12);
    EXPECT_NEAR(v[2] * r, 5 * v0 / 7, 1e-12);
    const double late = end.q[0] - (x_roll + (1 - t_roll) * 5 * v0 / 7);
    EXPECT_LE(std::abs(late), h * h * mu * gravity) << h;  // which step it rolls in: order 2
    before = energy(model, end);
    const State later = run_losing_energy(model, end, 10, h);
    EXPECT_NEAR(energy(model, later), before, 1e-11);  // rolls without loss
  }
}

TEST(Friction, ABallRollsDownASlope) {
  const double r = 0.1, angle = 0.3;
  const Model model = rolling_ball(r, {0, 1}, slope(angle));
  const State end = run_losing_energy(model, at_rest(model, angle), 1, 0.01);
  EXPECT_NEAR(way(end, angle), 5. / 7 * gravity * std::sin(angle) / 2, 1e-12);
  EXPECT_NEAR(end.q[2] * r, way(end, angle), 1e-12);
  EXPECT_NEAR(energy(model, end), energy(model, at_rest(model, angle)), 1e-11);
}

// Solid sphere: it sticks if 2/7 r w <= mu (1 + e) v_n, and gets 2/7 r w; else mu (1 + e) v_n.
TEST(Friction, ASpinningBallThatIsDroppedGetsTheSpeedOfTheClosedForm) {
  const double r = 0.1, e = 0.5, v_n = 1.5;
  for (const double mu : {0.05, 0.8}) {
    const Model model = rolling_ball(r, {e, mu});
    for (const double w : {-20.0, 2.0, 20.0}) {
      const State start = model.state({{"z", r}}, {{"z", -v_n}, {"turn", w}});
      Stepper stepper(model, {.h = 1e-3});
      const State after = stepper.advance(start);
      const StepReport& report = stepper.report();
      ASSERT_EQ(report.impulses.size(), 1u);
      EXPECT_NEAR(report.impulses[0].lambda, (1 + e) * v_n, 1e-12);
      const double sticks = 2. / 7 * r * w, slides = mu * (1 + e) * v_n;
      const double v = std::abs(sticks) <= slides ? sticks : std::copysign(slides, w);
      EXPECT_NEAR(model.velocity(after)[0], v, 1e-13);
      EXPECT_LE((report.impulses[0].p_W - Vec3(v, 0, 0)).norm(), 1e-13);
    }
  }
}

TEST(Friction, ABallBouncesToRollingWithoutGainingEnergy) {
  const Model model = rolling_ball(0.1, {0.6, 0.3});
  const State start = model.state({{"z", 0.6}}, {{"x", 1}, {"turn", -40}});
  const State end = run_losing_energy(model, start, 4, 0.01, 1e-6);
  const VecX v = model.velocity(end);
  EXPECT_NEAR(end.q[1], 0.1, 1e-12);
  EXPECT_NEAR(v[0], 0.1 * v[2], 1e-12);
  EXPECT_NEAR(v[0], 5. / 7 * (1 - 40 * 0.1 * 2 / 5), 1e-12);  // it comes back
}

TEST(Friction, WithoutFrictionIsAsBeforeToTheLastBit) {
  const Model plain = rolling_ball(0.1, {0.6, 0}), rough = rolling_ball(0.1, {0.6, 0.3});
  State a = plain.state({{"z", 0.4}}, {{"x", 1}}), b = a;
  State c = a;
  Stepper one(plain, {.h = 0.01}), two(rough, {.h = 0.01});
  for (int k = 0; k < 20; ++k) {  // until the first touch nothing differs
    one.step(a);
    two.step(b);
    if (!two.report().impacts.empty()) break;
    EXPECT_TRUE(a == b);
  }
  EXPECT_FALSE(a == c);
}

}  // namespace
}  // namespace saltus
