// Friction of piles: many contacts, of which most follow from others.
#include <gtest/gtest.h>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using namespace scenes;

const Vec3 half(0.2, 0.15, 0.1);

TEST(FrictionPiles, ATowerOfTenStands) {
  const Model model = boxes_on_slope(10, half, 0, {0, 0.5});
  const State end = run_losing_energy(model, model.state(), 3, 0.01);
  EXPECT_LE(farthest(model, end.q), 1e-9);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FrictionPiles, APyramidStands) {
  const Model model = pyramid({4, 3, 2, 1}, half, {0, 0.5});
  const State end = run_losing_energy(model, model.state(), 2, 0.01);
  EXPECT_LE(farthest(model, end.q), 1e-9);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FrictionPiles, WhatIsDroppedSettles) {
  const double height = 0.01;
  for (const Model& model : {boxes_on_slope(10, half, 0, {0, 0.5}, height),
                             pyramid({4, 3, 2, 1}, half, {0, 0.5}, height)}) {
    const State end = run_losing_energy(model, model.state(), 1, 0.01);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(end.q[7 * i + 2], -height, 1e-10);
    EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(FrictionPiles, ATowerOnASlopeStaysOrSlidesAsAWhole) {
  const double angle = 0.2, a_over_g = std::sin(angle);
  const Vec3 slab(1, 1, 0.1);
  const Model stays = boxes_on_slope(10, slab, angle, {0, std::tan(angle) * 1.05});
  const State still = run_losing_energy(stays, stays.state(), 0.5, 0.01, 1e-10);
  EXPECT_LE(farthest(stays, still.q), 1e-9);
  const double mu = 0.1;
  const Model slides = boxes_on_slope(10, slab, angle, {0, 0.5}, 0, mu);
  const State end = run_losing_energy(slides, slides.state(), 1, 0.01);
  const double a = gravity * (a_over_g - mu * std::cos(angle));
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(end.q[7 * i], a / 2, 1e-9);
  EXPECT_NEAR(slides.velocity(end)[0], a, 1e-9);
}

TEST(FrictionPiles, ATowerWhoseLowestBoxIsHitComesToRest) {
  const Model model = boxes_on_slope(10, half, 0, {0, 0.5});
  const State start = model.state({}, {{"box_0_vx", 0.1}, {"box_0_wz", 0.3}});
  const State end = run_losing_energy(model, start, 1, 0.01);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE(energy(model, end) - energy(model, start), -0.004);
}

TEST(FrictionPiles, TheLowestRowOfAPyramidIsHit) {
  const Model model = pyramid({4, 3, 2, 1}, half, {0, 0.5});
  const State start = model.state({}, {{"box_0_vx", -0.5}});
  const State end = run_losing_energy(model, start, 1, 0.01);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(end.q[0], -1e-3);
}

// What holds a box up is its weight; on a slope friction holds what pulls it down.
TEST(FrictionPiles, TheReportSaysWhatHoldsABox) {
  const double h = 0.01, mu = 0.5, weight = gravity;
  for (const double angle : {0.0, 0.3, 0.7}) {
    const Model model = boxes_on_slope(1, half, angle, {0, mu});
    Stepper stepper(model, {.h = h});
    State state = model.state();
    for (int k = 0; k < 5; ++k) {
      stepper.step(state);
      double normal = 0;
      Vec3 tangential = Vec3::Zero();
      EXPECT_EQ(stepper.report().contacts.size(), angle < 0.5 ? 4u : 2u + 2u);
      for (const ContactImpulse& each : stepper.report().contacts) {
        EXPECT_GE(each.lambda, 0);
        EXPECT_LE(each.p_W.norm(), mu * each.lambda * (1 + 1e-9));
        normal += each.lambda;
        tangential += each.p_W;
      }
      const double holds = angle < 0.5 ? std::sin(angle) : mu * std::cos(angle);
      EXPECT_NEAR(normal, weight * std::cos(angle) * h, 1e-12);
      EXPECT_LE((tangential - Vec3(-holds * weight * h, 0, 0)).norm(), 1e-12);
    }
  }
}

TEST(FrictionPiles, ATowerBearsTheWeightOfAllAbove) {
  const Model model = boxes_on_slope(5, half, 0, {0, 0.5});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state();
  for (int k = 0; k < 3; ++k) stepper.step(state);
  double floor = 0;
  for (const ContactImpulse& each : stepper.report().contacts) {
    if (model.pair_name(each.pair).find("floor") != std::string::npos) floor += each.lambda;
  }
  EXPECT_NEAR(floor, 5 * gravity * 0.01, 1e-11);
}

// Yaw of the lowest box turns the contacts within the arc: forces act where they are at its start,
// rates are felt where they are in its middle and by its end.
TEST(FrictionPiles, ABoxIsTwistedOutFromUnderATower) {
  const Model model = boxes_on_slope(3, half, 0, {0, 0.5});
  const State start = model.state({}, {{"box_0_vx", 1}, {"box_0_wz", 3}});
  const State end = run_losing_energy(model, start, 1, 0.01);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_GT(end.q[0], 0.02);
  // it takes its share of those above along, and turns further than they do
  EXPECT_GT(end.q[5], end.q[11]);
}

TEST(FrictionPiles, BouncesOfATowerComeToRestTogether) {
  const double height = 0.01;
  const Model model = boxes_on_slope(3, half, 0, {0.5, 0.5}, height);
  const State end = run_losing_energy(model, model.state(), 1, 0.01);
  EXPECT_LE(model.velocity(end).cwiseAbs().maxCoeff(), 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(end.q[7 * i + 2], -height, 1e-10);
}

TEST(FrictionPiles, TheReportSaysHowWellTheLawIsMet) {
  const Model model = pyramid({3, 2, 1}, half, {0, 0.5});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state({}, {{"box_0_vx", -0.5}});
  double most = 0;
  for (int k = 0; k < 20; ++k) {
    stepper.step(state);
    most = std::max(most, stepper.report().friction_residual);
  }
  EXPECT_GT(most, 0);  // rounding, which is never quite nothing
  EXPECT_LE(most, 1e-9);
  Stepper smooth(boxes_on_slope(1, half, 0, {0, 0}), {.h = 0.01});
  State rests = smooth.model().state();
  smooth.step(rests);
  EXPECT_EQ(smooth.report().friction_residual, 0);
}

}  // namespace
}  // namespace saltus
