// Grazing, jammed, overlapping, open and closed within rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/ask.hpp"
#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::discs;
using scenes::energy;
using test::message_of;

// A ball that slides along a floor and sinks towards it ever more slowly: it rebounds, or what is
// left of its approach is below rest and it stays; energy and path are kept in either case.
TEST(HardCases, ABallThatGrazesAFloor) {
  ModelBuilder b;
  b.set_gravity(Vec3::Zero());
  scenes::add_slider(b, 0.1);
  b.add_half_space("floor", Vec3::UnitZ());
  const Model model = b.build();
  for (int digits = 1; digits <= 14; ++digits) {
    const double speed = std::pow(10, -digits);
    // hits in the middle of the fifth step
    State state = model.state({{"z", 0.1 + 0.045 * speed}}, {{"x", 1}, {"z", -speed}});
    Stepper stepper(model, {.h = 0.01});
    for (int k = 0; k < 20; ++k) stepper.step(state);
    EXPECT_NEAR(state.q[0], 0.2, 1e-12) << digits;
    // rest begins where it touches, 1e-11 deep, and may sink by as much before it is held
    EXPECT_GE(state.q[1], 0.1 - 2.1e-11) << digits;
    EXPECT_NEAR(energy(model, state), 0.5 * (1 + speed * speed), 1e-12) << digits;
    if (digits <= 9) {  // above the rest threshold, 1e-10 of the speeds
      EXPECT_NEAR(state.p[1], speed, 1e-12) << digits;
    }
  }
}

// One disc passes another and touches it with ever less of its edge: g' = 0 in the limit.
TEST(HardCases, ADiscThatGrazesADisc) {
  for (int digits = 1; digits <= 14; ++digits) {
    const double overlap = std::pow(10, -digits);
    const Model model = discs({Vec3(-2, 1 - overlap, 0), Vec3(0, 0, 0)}, {1, 1});
    State state = model.state({}, {{"x_0", 1}});
    Stepper stepper(model, {.h = 0.01});
    int impacts = 0;
    for (int k = 0; k < 400; ++k) {
      stepper.step(state);
      impacts += static_cast<int>(stepper.report().impacts.size());
    }
    EXPECT_LE(impacts, 1) << digits;
    EXPECT_EQ(impacts, digits <= 9 ? 1 : impacts) << digits;
    EXPECT_NEAR(energy(model, state), 0.5, 1e-12) << digits;
    EXPECT_NEAR(state.p[0] + state.p[2], 1, 1e-12) << digits;
    EXPECT_NEAR(state.p[1] + state.p[3], 0, 1e-12) << digits;
    // the normal's angle is asin(1 - overlap) off the path, and impulses go along it
    const double sine = 1 - overlap, cosine = std::sqrt(1 - sine * sine);
    EXPECT_NEAR(state.p[2], cosine * cosine, 1e-7) << digits;
  }
}

TEST(HardCases, ThreeDiscsInATriangle) {
  const double height = std::sqrt(0.75);
  const Model model = discs({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, height, 0)}, {1, 1, 1});
  // all run to the middle of the triangle
  std::map<std::string, double> v;
  for (int i = 0; i < 3; ++i) {
    const double angle = (210 + 120 * i) * std::acos(-1.) / 180;
    v["x_" + std::to_string(i)] = -std::cos(angle);
    v["y_" + std::to_string(i)] = -std::sin(angle);
  }
  const State start = model.state({}, v);
  for (const ImpactOrder order :
       {ImpactOrder::fastest, ImpactOrder::index, ImpactOrder::symmetric}) {
    Stepper stepper(model, {.h = 0.01, .order = order});
    const State end = stepper.advance(start);
    ASSERT_EQ(stepper.report().impacts.size(), 1u);
    EXPECT_NEAR(energy(model, end), 1.5, 1e-12);
    EXPECT_GE(model.gaps(end.q).phi.minCoeff(), -1e-12);
    if (order == ImpactOrder::symmetric) {
      EXPECT_LT((end.p + start.p).norm(), 1e-12);
    }
  }
}

TEST(HardCases, ABallJammedBetweenTwoWallsIsNamed) {
  ModelBuilder b;
  scenes::add_bead(b, "x", Vec3::Zero(), Vec3::UnitX(), 1, 0.1);
  b.add_half_space("left", Vec3::UnitX(), -0.1).add_half_space("right", -Vec3::UnitX(), -0.1);
  const Model model = b.build();
  Stepper stepper(model, {.h = 0.01});
  State state = model.state({}, {{"x", 1}});
  const State before = state;
  const std::string text = message_of<JammedError>([&] { stepper.step(state); });
  for (const char* part : {"x ~ left", "x ~ right", "jammed"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  EXPECT_TRUE(state == before);
  state = model.state();  // at rest it is no impact
  for (int k = 0; k < 10; ++k) stepper.step(state);
  EXPECT_EQ(state.q[0], 0);
}

// Both walls touch to rounding, and open and close by 1e-12 where the ball moves at all.
TEST(HardCases, ContactsWithin1e12OfOpen) {
  ModelBuilder b;
  scenes::add_bead(b, "z", Vec3::Zero(), Vec3::UnitZ(), 1, 0.1);
  b.add_half_space("floor", Vec3::UnitZ(), -0.1 - 1e-12);
  b.add_half_space("ceiling", -Vec3::UnitZ(), -0.1);
  const Model model = b.build();
  Stepper stepper(model, {.h = 0.01});
  State state = model.state();
  for (int k = 0; k < 1000; ++k) {
    stepper.step(state);
    ASSERT_NEAR(state.q[0], 0, 1e-11);
    ASSERT_NEAR(state.p[0], 0, 0.01 * 9.81);
    ASSERT_TRUE(stepper.report().impacts.empty());
  }
}

TEST(HardCases, OverlappingStartsAreNamedAndResolved) {
  const Model model = discs({Vec3(0, 0, 0), Vec3(0.9, 0, 0), Vec3(1.7, 0.1, 0)}, {1, 1, 4});
  Stepper stepper(model, {.h = 0.01});
  const State start = model.state();
  const std::string text = message_of([&] { stepper.advance(start); });
  for (const char* part : {"disc_0 ~ disc_1 by 0.1 m", "disc_1 ~ disc_2 by", "resolve_overlap"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  const VecX q = resolve_overlap(model, start.q);
  EXPECT_GE(model.gaps(q).phi.minCoeff(), -1e-10);
  EXPECT_NO_THROW(stepper.advance(model.state(q, VecX::Zero(6))));
  // the heavy one moved least, and the common centre of mass stayed
  EXPECT_LT(q.tail(2).norm(), q.segment(2, 2).norm() + q.head(2).norm());
  EXPECT_NEAR(q[0] + q[2] + 4 * q[4], 0, 1e-9);
  EXPECT_EQ(resolve_overlap(model, q), q);
}

TEST(HardCases, AnOverlapWithoutAWayOutIsNamed) {
  ModelBuilder b;
  scenes::add_bead(b, "x", Vec3::Zero(), Vec3::UnitX(), 1, 0.1);
  b.add_half_space("left", Vec3::UnitX(), -0.09).add_half_space("right", -Vec3::UnitX(), -0.09);
  const Model model = b.build();
  const std::string text = message_of([&] { resolve_overlap(model, VecX::Zero(1)); });
  EXPECT_NE(text.find("x ~ left by 0.01"), std::string::npos) << text;
  EXPECT_THROW(resolve_overlap(model, VecX::Zero(2)), ModelError);
  EXPECT_THROW(resolve_overlap(model, VecX::Constant(1, NAN)), ModelError);
}

}  // namespace
}  // namespace saltus
