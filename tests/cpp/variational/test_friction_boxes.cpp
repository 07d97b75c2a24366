// Friction of many contacts: boxes on slopes, on each other, and thrown on the floor.
#include <gtest/gtest.h>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using namespace scenes;

const Vec3 half(0.2, 0.15, 0.1);

TEST(FrictionBoxes, ABoxBelowTheAngleOfFrictionStays) {
  const double angle = 0.5;
  const Model model = boxes_on_slope(1, half, angle, {0, std::tan(angle) * 1.01});
  const State end = run_losing_energy(model, model.state(), 10, 0.01);
  EXPECT_LE(farthest(model, end.q), 1e-12);
}

TEST(FrictionBoxes, ABoxAboveTheAngleOfFrictionSlides) {
  const double angle = 0.5, mu = 0.3;
  const Model model = boxes_on_slope(1, half, angle, {0, mu});
  const State end = run_losing_energy(model, model.state(), 1, 0.01);
  const double a = gravity * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR(end.q[0], a / 2, 1e-12);
  EXPECT_LE(model.difference(model.neutral(), end.q).tail(5).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FrictionBoxes, ABoxTipsOverBeforeItSlides) {
  const Vec3 tall(0.1, 0.1, 0.3);  // tips where tan(angle) > 1/3
  const Model model = boxes_on_slope(1, tall, 0.4, {0, 2});
  const State end = run_losing_energy(model, model.state(), 0.5, 0.005, 1e-4);
  EXPECT_GT(moved(model, end.q, "box_0_wy"), 0.05);
}

TEST(FrictionBoxes, ABoxThatSlidesAndTurnsStopsAsAWhole) {
  const Model model = boxes_on_slope(1, half, 0, {0, 0.4});
  const State start = model.state({}, {{"box_0_vx", 1.5}, {"box_0_vy", 0.5}, {"box_0_wz", 5}});
  const State end = run_losing_energy(model, start, 1.5, 0.01);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(end.q[0], 0.2);
  EXPECT_GT(moved(model, end.q, "box_0_wz"), 0.2);
  EXPECT_LE(std::abs(end.q[2]), 1e-12);
  const State later = run_losing_energy(model, end, 5, 0.01);
  EXPECT_LE((later.q - end.q).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FrictionBoxes, AStackOfThreeStays) {
  const Model flat = boxes_on_slope(3, half, 0, {0, 0.5});
  const State still = run_losing_energy(flat, flat.state(), 2, 0.01);
  EXPECT_LE(farthest(flat, still.q), 1e-12);
  const Model tilted = boxes_on_slope(3, half, 0.2, {0, 0.5});
  const State leans = run_losing_energy(tilted, tilted.state(), 2, 0.01);
  EXPECT_LE(farthest(tilted, leans.q), 1e-12);
}

TEST(FrictionBoxes, ABoxThrownOnTheFloorComesToRest) {
  const Model model = boxes_on_slope(1, half, 0, {0.3, 0.4});
  VecX q = model.neutral(), v(6);
  q[2] = 0.1;
  q.tail<4>() = Quaternion(rotation_from_rpy(0.2, 0.1, 0)).coeffs();
  v << 1.5, 0, -1, 1, 0, 3;
  const State start = model.state(q, v);
  const State end = run_losing_energy(model, start, 3, 0.005, 1e-4);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(end.q[2], 0, 1e-10);
}

// Bodies turn: energy is in a band of order h^2, as it is in flight.
TEST(FrictionBoxes, ABallRollsOnABox) {
  ModelBuilder b("ball on box");
  const Vec3 base(0.3, 0.3, 0.05);
  b.add_body(
      {.name = "box", .shape = Box{base}, .mass = 4, .X = {Mat3::Identity(), Vec3(0, 0, 0.05)}});
  b.add_body(
      {.name = "ball", .shape = Sphere{0.1}, .mass = 1, .X = {Mat3::Identity(), Vec3(0, 0, 0.2)}});
  b.add_half_space("floor", Vec3::UnitZ()).set_default_contact({0, 0.5});
  const Model model = b.build();
  // the ball is pushed along, with a spin about the vertical that friction at a point does not feel
  const State start = model.state({}, {{"ball_vx", 0.3}, {"ball_vy", 0.1}, {"ball_wz", 2}});
  const State end = run_losing_energy(model, start, 0.5, 0.005, 1e-7);
  const VecX v = model.velocity(end);
  EXPECT_LE(v.head(6).cwiseAbs().maxCoeff(), 1e-12);  // the box is heavy enough not to slide
  EXPECT_NEAR(v[6], 5. / 7 * 0.3, 1e-3);
  EXPECT_NEAR(v[7], 5. / 7 * 0.1, 1e-3);
}

}  // namespace
}  // namespace saltus
