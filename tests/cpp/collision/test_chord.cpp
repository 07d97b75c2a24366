// The certified advance against dense sampling: no hit is missed, none is late, none is invented.
#include "saltus/collision/chord.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "collision/random_scene.hpp"

namespace saltus {
namespace {

using testing_scene::make_pair_of;
using testing_scene::moved;
using testing_scene::place;
using testing_scene::Random;
using testing_scene::random_scene;
using testing_scene::Scene;
using Outcome = ChordHit::Outcome;

/// phi - floor along a chord, the slow way.
struct Chord {
  const Scene& scene;
  VecX q, dq;
  double floor;
  Kinematics kin{scene.tree};

  double operator()(double s) {
    set_configuration(scene.tree, moved(scene.tree, q, s, dq), kin);
    return pair_gap(scene.tree, kin, scene.pair).phi - floor;
  }
  ChordHit hit() const { return first_hit_on_chord(scene.tree, scene.pair, q, dq, floor); }
  double bound() const { return gap_change_bound(scene.tree, scene.pair, q, dq); }
};

/// First s <= 1 where the chord is below 0, from samples and bisection; 2 if there is none.
double first_root(Chord& chord, int samples) {
  for (int k = 1; k <= samples; ++k) {
    double high = static_cast<double>(k) / samples, low = high - 1.0 / samples;
    if (chord(high) > 0) continue;
    for (int j = 0; j < 50; ++j) {
      const double middle = (low + high) / 2;
      (chord(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  return 2;
}

using Names = std::pair<std::string, std::string>;
/// Both orders of a pair of kinds: what moves before what is at rest.
Scene random_pair(const Names& kinds, int joints, Random& random) {
  const bool exchanged = kinds.second != "half_space" && random.chance(0.5);
  return random_scene(exchanged ? kinds.second : kinds.first,
                      exchanged ? kinds.first : kinds.second,
                      {.joints = joints, .offset = 0.6, .ball = random.chance(0.5) ? 0.5 : 0},
                      random);
}

class RandomChords : public ::testing::TestWithParam<Names> {};

TEST_P(RandomChords, FirstHitIsNeitherMissedNorLateNorInvented) {
  Random random(21);
  int hits = 0, near_misses = 0, chords = 0;
  while (chords < 300) {
    const Scene scene = random_pair(GetParam(), 1 + random.index(6), random);
    const double size = random.chance(0.2) ? 0.1 : 4;
    Chord chord{scene, scene.q, random.numbers(scene.tree.n_v, size),
                random.uniform(-0.02, 0.02)};
    const double start = chord(0);
    if (start <= 0) continue;
    ++chords;
    const ChordHit hit = chord.hit();
    const double root = first_root(chord, 200);
    ASSERT_NE(hit.outcome, Outcome::not_converged);
    if (hit.outcome == Outcome::clear) {
      EXPECT_EQ(root, 2);
      if (start < chord.bound()) ++near_misses;
      continue;
    }
    ++hits;
    EXPECT_LE(hit.s, root + 1e-12);         // bisection ends at 1e-17, phi's rounding is 1e-15
    EXPECT_NEAR(chord(hit.s), 0, 1e-13);    // the promise is phi's rounding
    EXPECT_LE(chord(hit.s + 1e-7), 1e-13);  // it does fall
  }
  EXPECT_GT(hits, 20);
  EXPECT_GT(near_misses, 10);
}

TEST_P(RandomChords, GapChangesByNoMoreThanItsBound) {
  Random random(22);
  for (int k = 0; k < 200; ++k) {
    const Scene scene = random_pair(GetParam(), 1 + random.index(6), random);
    Chord chord{scene, scene.q, random.numbers(scene.tree.n_v, 2), 0};
    const double start = chord(0), bound = chord.bound();
    for (int j = 1; j <= 50; ++j) EXPECT_LE(std::abs(chord(j / 50.0) - start), bound);
  }
}

// Where bodies overlap there is no promise but to end, and to call no departure a hit.
TEST_P(RandomChords, StartsFromOverlap) {
  Random random(23);
  int overlaps = 0, grazes = 0;
  for (int k = 0; k < 1000; ++k) {
    const Scene scene = random_pair(GetParam(), 1 + random.index(3), random);
    Chord chord{scene, scene.q, random.numbers(scene.tree.n_v, 0.5), 0};
    if (chord(0) > -1e-6) continue;
    ++overlaps;
    const ChordHit hit = chord.hit();
    const double slope = (chord(1e-6) - chord(0)) / 1e-6;
    grazes += hit.outcome == Outcome::not_converged;  // back at a hundredth of its corners' speed
    if (hit.outcome == Outcome::not_converged) continue;
    EXPECT_TRUE(std::abs(slope) < 1e-4 || (hit.s == 0) == (slope < 0));  // the difference's error
  }
  EXPECT_GT(overlaps, 50);
  EXPECT_LE(grazes, 1);
}

INSTANTIATE_TEST_SUITE_P(Table, RandomChords, ::testing::ValuesIn(gap_table()),
                         [](const ::testing::TestParamInfo<Names>& names) {
                           return names.param.first + "_" + names.param.second;
                         });

Scene slide_along_x(double radius, const Shape& target) {
  Tree tree;
  add_joint(tree, -1, {Joint::Kind::prismatic, 0}, {rotation_z_to(Vec3::UnitX()), Vec3::Zero()},
            {0, 1, 0});
  const std::vector<PlacedShape> shapes = {place(Sphere{radius}, 0, {}), place(target, -1, {})};
  return {tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(1)};
}

TEST(FastBody, IsCaughtByAThinPlate) {
  const Scene scene = slide_along_x(1e-3, Box{Vec3(5e-4, 1, 1)});
  Chord chord{scene, VecX::Constant(1, -70), VecX::Constant(1, 1000), 0};
  const ChordHit hit = chord.hit();
  ASSERT_EQ(hit.outcome, Outcome::hit);
  EXPECT_NEAR(hit.s, (70 - 1.5e-3) / 1000, 1e-15);  // eps * 70 m / 1000 m
}

TEST(FastBody, IsCaughtByASmallBall) {
  const Scene scene = slide_along_x(1e-3, Sphere{1e-3});
  Chord chord{scene, VecX::Constant(1, -70), VecX::Constant(1, 1000), 0};
  const ChordHit hit = chord.hit();
  ASSERT_EQ(hit.outcome, Outcome::hit);
  EXPECT_NEAR(hit.s, (70 - 2e-3) / 1000, 1e-15);
}

TEST(FastBody, IsCaughtWhereItTurnsManyTimes) {
  // a hammer of length 1 on a wheel; a peg of radius 1e-3 at a right angle; 20 turns in the chord
  Tree tree;
  add_joint(tree, -1, {}, {}, {0, 1, 0});
  const std::vector<PlacedShape> shapes = {
      place(Sphere{1e-3}, 0, {Mat3::Identity(), Vec3::UnitX()}),
      place(Capsule{1e-3, 1}, -1, {Mat3::Identity(), Vec3::UnitY()})};
  const Scene scene{tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(1)};
  Chord chord{scene, VecX::Zero(1), VecX::Constant(1, 40 * std::numbers::pi), 0};
  const ChordHit hit = chord.hit();
  ASSERT_EQ(hit.outcome, Outcome::hit);
  const double angle = std::numbers::pi / 2 - 2 * std::asin(1e-3);
  EXPECT_NEAR(hit.s, angle / (40 * std::numbers::pi), 1e-15);
}

// Seen from a plate that turns, a body that passes in a straight line is bent towards it by
// 2 x turn x speed: neither moves fast across the gap at first.
TEST(TurningTarget, MeetsABodyThatFliesPast) {
  Tree tree;
  add_joint(tree, -1, {Joint::Kind::prismatic, 0},
            {rotation_z_to(Vec3::UnitX()), 0.5 * Vec3::UnitY()}, {0, 1, 0});
  add_joint(tree, -1, {}, {}, {1, 1, 0});
  const std::vector<PlacedShape> shapes = {place(Sphere{0.01}, 0, {}),
                                           place(Box{Vec3(60, 0.01, 1)}, 1, {})};
  const Scene scene{tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(2)};
  Chord chord{scene, VecX::Zero(2), Eigen::Vector2d(100, 0.5), 0};
  const double root = first_root(chord, 100);
  EXPECT_NEAR(root, 0.1, 0.01);  // 0.5 - 50 s^2 = 0.02
  const ChordHit hit = chord.hit();
  EXPECT_EQ(hit.outcome, Outcome::hit);
  EXPECT_NEAR(hit.s, root, 1e-14);  // phi's rounding of 1e-12 (100 m) at a slope of 10
}

// A small cube turns below a large ball at rest: its face tilts into the ball, whose centre is far.
TEST(TurningTarget, MeetsALargeBall) {
  Tree tree;
  add_joint(tree, -1, {}, {rotation_z_to(Vec3::UnitY()), Vec3::Zero()}, {0, 1, 0});
  const double distance = 10.1 + 3e-4;
  const std::vector<PlacedShape> shapes = {
      place(Sphere{10}, -1, {Mat3::Identity(), distance * Vec3::UnitZ()}),
      place(Box{Vec3::Constant(0.1)}, 0, {})};
  const Scene scene{tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(1)};
  const ChordHit hit = Chord{scene, VecX::Zero(1), VecX::Ones(1), 0}.hit();
  EXPECT_EQ(hit.outcome, Outcome::hit);
  EXPECT_NEAR(hit.s, std::acos(10.1 / distance), 1e-12);  // phi's rounding 4e-14 at a slope of 0.08
}

/// A pendulum of length 1 about y at height `pivot` over the floor, radius 0.1; 0 is straight down.
Scene over_floor(double pivot) {
  Tree tree;
  const Mat3 y_axis = rotation_z_to(-Vec3::UnitY());
  add_joint(tree, -1, {}, {y_axis, Vec3(0, 0, pivot)}, {0, 1, 0});
  const Pose bob{Mat3::Identity(), y_axis.transpose() * Vec3(0, 0, -1)};
  const std::vector<PlacedShape> shapes = {place(Sphere{0.1}, 0, bob), place(HalfSpace{}, -1, {})};
  return {tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(1)};
}

TEST(Grazing, IsDecidedByTheSignOfTheLeastGap) {
  for (const double depth : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Scene hits = over_floor(1.1 - depth), passes = over_floor(1.1 + depth);
    const VecX q = VecX::Constant(1, -1.0), dq = VecX::Constant(1, 2.5);
    const ChordHit hit = Chord{hits, q, dq, 0}.hit();
    ASSERT_EQ(hit.outcome, Outcome::hit) << depth;
    // cos(angle) = 1 - depth; the rounding of phi, 16 eps x 3 m, over its slope 2.5 sqrt(2 depth)
    EXPECT_NEAR(hit.s, (1 - std::acos(1 - depth)) / 2.5, 3e-15 / std::sqrt(depth));
    EXPECT_EQ((Chord{passes, q, dq, 0}.hit().outcome), Outcome::clear) << depth;
  }
}

TEST(TouchingStart, IsLookedAtFromItsDepartureOn) {
  // up from the floor, over the top, and down on the other side
  const Scene scene = over_floor(0.6);  // touches at cos(angle) = 0.5
  const double pi = std::numbers::pi;
  const VecX q = VecX::Constant(1, pi / 3);
  const ChordHit round = Chord{scene, q, VecX::Constant(1, 2 * pi), 0}.hit();
  ASSERT_EQ(round.outcome, Outcome::hit);
  EXPECT_NEAR(round.s, 2.0 / 3, 1e-15);
  EXPECT_EQ((Chord{scene, q, VecX::Constant(1, pi), 0}.hit().outcome), Outcome::clear);
  const ChordHit down = Chord{scene, q, VecX::Constant(1, -0.1), 0}.hit();
  EXPECT_EQ(down.outcome, Outcome::hit);
  EXPECT_EQ(down.s, 0);
  const ChordHit rest = Chord{scene, q, VecX::Zero(1), 0}.hit();
  EXPECT_EQ(rest.outcome, Outcome::hit);
  EXPECT_EQ(rest.s, 0);
}

TEST(TouchingStart, DepartsHoweverSlowly) {
  const Scene scene = over_floor(0.6);
  for (const double speed : {1.0, 1e-3, 1e-6, 1e-12, 1e-100}) {
    Chord chord{scene, VecX::Constant(1, std::numbers::pi / 3), VecX::Constant(1, speed), 0};
    EXPECT_EQ(chord.hit().outcome, Outcome::clear) << speed;
  }
}

/// Two pendulums of length 1 side by side that touch where their angles are equal, but for `gap`.
Scene neighbours(double gap) {
  Tree tree;
  const Mat3 y_axis = rotation_z_to(-Vec3::UnitY());
  for (int i = 0; i < 2; ++i) {
    add_joint(tree, -1, {}, {y_axis, Vec3(i * (0.1 + gap), 0, 0)}, {i, 1, 0});
  }
  const Pose bob{Mat3::Identity(), y_axis.transpose() * Vec3(0, 0, -1)};
  const std::vector<PlacedShape> shapes = {place(Sphere{0.05}, 1, bob),
                                           place(Sphere{0.05}, 0, bob)};
  return {tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(2)};
}

TEST(Neighbours, SwingTogetherWithoutAHit) {
  // a step of a cradle moves by 0.03; nearer than 1e-8 of its cube is not promised
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Scene scene = neighbours(gap);
    Chord chord{scene, VecX::Constant(2, 0.3), VecX::Constant(2, -0.03), 0};
    EXPECT_EQ(chord.hit().outcome, Outcome::clear) << gap;
  }
  const Scene touching = neighbours(0);
  Chord chord{touching, VecX::Constant(2, 0.3), VecX::Constant(2, -0.03), -5e-12};
  EXPECT_EQ(chord.hit().outcome, Outcome::clear);
}

TEST(Neighbours, AtRestInTouchAreAHitAtOnce) {
  const Scene scene = neighbours(0);
  const ChordHit hit = Chord{scene, VecX::Zero(2), VecX::Zero(2), 0}.hit();
  EXPECT_EQ(hit.outcome, Outcome::hit);
  EXPECT_EQ(hit.s, 0);
}

TEST(Outcomes, NotANumberIsNotConverged) {
  const Scene scene = neighbours(0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity}) {
    const VecX good = VecX::Zero(2), wrong = VecX::Constant(2, bad);
    EXPECT_EQ((Chord{scene, good, wrong, 0}.hit().outcome), Outcome::not_converged);
    EXPECT_EQ((Chord{scene, wrong, good, 0}.hit().outcome), Outcome::not_converged);
  }
}

TEST(Outcomes, WithoutJointsBetweenTheBodiesNothingCloses) {
  Scene scene = over_floor(2);
  scene.shapes[1] = place(Sphere{0.1}, 0, {});
  scene.pair = make_pair_of(scene.tree, scene.shapes, 0, 1);
  Chord chord{scene, VecX::Zero(1), VecX::Ones(1), 0};
  EXPECT_EQ(chord.bound(), 0);
  EXPECT_EQ(chord.hit().outcome, Outcome::clear);
}

TEST(Bound, IsTightForOnePendulum) {
  const Scene scene = over_floor(2);
  Chord chord{scene, VecX::Zero(1), VecX::Constant(1, 0.5), 0};
  EXPECT_NEAR(chord.bound(), 0.5, 1e-11);  // angle x length, with its slack of 1e-12
}

}  // namespace
}  // namespace saltus
