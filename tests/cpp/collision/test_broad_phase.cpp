// The broad phase against every pair's own gap: nothing that can touch is dropped.
#include "saltus/collision/broad_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/random_scene.hpp"
#include "collision/random_world.hpp"
#include "saltus/collision/chord.hpp"

namespace saltus {
namespace {

using testing_scene::moved;
using testing_scene::place;
using testing_scene::Random;
using testing_scene::random_coordinates;
using testing_world::random_world;
using testing_world::World;

TEST(BroadPhase, DropsNoPairThatCanTouch) {
  Random random(31);
  std::size_t dropped = 0, all = 0;
  for (int w = 0; w < 60; ++w) {
    const World world = random_world(random);
    BroadPhase bp = world.broad_phase();
    VecX q = random_coordinates(world.tree, 3, random);
    for (int step = 0; step < 4; ++step) {  // small steps and a leap
      const bool leap = step == 2;
      const VecX dq = random.numbers(world.tree.n_v, leap ? 2 : 0.05);
      const double margin = step % 2 == 0 ? 0 : 0.1;
      const std::vector<int>& found = world.find(q, dq, margin, bp);
      const std::vector<double> least = world.least_gaps(q, dq);
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (int i = 0; i < static_cast<int>(least.size()); ++i) {
        const bool kept = std::binary_search(found.begin(), found.end(), i);
        EXPECT_TRUE(kept || least[i] > margin) << "pair " << i << " comes to " << least[i];
        if (leap) continue;
        ++all;
        dropped += !kept;
      }
      q = moved(world.tree, q, 1, dq);
    }
  }
  EXPECT_GT(dropped, all / 2);  // and it is of use
}

// Where the certified advance finds a hit, the pair must have been a candidate: the chain of the
// two in the stepper.
TEST(BroadPhase, KeepsEveryHitOfAChord) {
  Random random(32);
  int hits = 0;
  for (int w = 0; w < 100; ++w) {
    const World world = random_world(random);
    BroadPhase bp = world.broad_phase();
    const VecX q = random_coordinates(world.tree, 3, random);
    const VecX dq = random.numbers(world.tree.n_v, 0.5);
    const std::vector<int>& found = world.find(q, dq, 0, bp);
    for (int i = 0; i < static_cast<int>(world.pairs.size()); ++i) {
      const ChordHit hit = first_hit_on_chord(world.tree, world.pairs[i], q, dq, 0);
      if (hit.outcome != ChordHit::Outcome::hit) continue;
      ++hits;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i));
    }
  }
  EXPECT_GT(hits, 300);
}

/// n free balls of radius 0.5 in a row that touch their neighbours, each on a slide across.
World row_of_balls(int n, const Vec3& along, const Vec3& start) {
  World world;
  for (int i = 0; i < n; ++i) {
    add_joint(world.tree, -1, {Joint::Kind::prismatic, 0}, {Mat3::Identity(), start + i * along},
              {i, 1, 0});
    world.shapes.push_back(place(Sphere{0.5}, i, {}));
  }
  world.add_all_pairs();
  return world;
}

TEST(BroadPhase, FindsJustTheNeighboursInARow) {
  const int n = 60;
  const std::vector<Vec3> starts = {Vec3::Zero(), Vec3(1000, -3000, 2000)};
  for (const Vec3& start : starts) {
    for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0.6, -0.8)}) {
      const World world = row_of_balls(n, along, start);
      BroadPhase bp = world.broad_phase();
      const VecX still = VecX::Zero(n);
      // exactly touching, without any margin
      ASSERT_EQ(world.find(still, still, 0, bp).size(), n - 1);
      for (int i = 0; i < n - 1; ++i) {
        const Pair& pair = world.pairs[bp.candidates[i]];
        EXPECT_EQ(std::abs(pair.b - pair.a), 1);
      }
    }
  }
}

TEST(BroadPhase, HoldsHalfSpacesAgainstTheirPartners) {
  World world = row_of_balls(10, 3 * Vec3::UnitZ(), Vec3(0, 0, 0.5));
  world.shapes.push_back(place(HalfSpace{}, -1, {}));
  world.table = {world.shapes, {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {{0, 0}}, {}}};
  ASSERT_EQ(world.table.size(), 10);
  BroadPhase bp = world.broad_phase();
  VecX q = VecX::Zero(10), dq = VecX::Zero(10);
  EXPECT_EQ(world.find(q, dq, 0, bp), std::vector<int>({0}));
  dq[4] = -12;  // falls 12 m to the floor
  EXPECT_EQ(world.find(q, dq, 0, bp), std::vector<int>({0, 4}));
  EXPECT_EQ(world.find(q, 0 * dq, 3, bp), std::vector<int>({0, 1}));
}

TEST(BroadPhase, FollowsAScrewAlongItsAxis) {
  World world;
  add_joint(world.tree, -1, {Joint::Kind::helical, 3}, {Mat3::Identity(), 10 * Vec3::UnitZ()},
            {0, 1, 0});
  world.shapes = {place(Sphere{0.5}, 0, {}), place(HalfSpace{}, -1, {})};
  world.add_all_pairs();
  BroadPhase bp = world.broad_phase();
  EXPECT_EQ(world.find(VecX::Zero(1), VecX::Constant(1, -3.2), 0, bp).size(), 1u);
  EXPECT_EQ(world.find(VecX::Zero(1), VecX::Constant(1, -3.1), 0, bp).size(), 0u);
}

TEST(BroadPhase, LeavesOutShapesInNoPair) {
  World world = row_of_balls(4, Vec3::UnitX(), Vec3::Zero());
  world.table = {world.shapes, {{0, 1, 1, 0}, {{0, 1}, {0, 0}}, {}}};
  BroadPhase bp = world.broad_phase();
  EXPECT_EQ(world.find(VecX::Zero(4), VecX::Zero(4), 0, bp), std::vector<int>({0}));
  EXPECT_EQ(bp.bounded.size(), 2u);
}

TEST(BroadPhase, FindsTheSameInACubeAsAllPairs) {
  Random random(34);
  const int n = 300;
  World world;
  for (int i = 0; i < n; ++i) {
    add_joint(world.tree, -1, {Joint::Kind::prismatic, 0}, {random.rotation(), random.vector(4)},
              {i, 1, 0});
    world.shapes.push_back(place(Sphere{random.chance(0.05) ? 3 : 0.3}, i, {}));
  }
  world.add_all_pairs();
  BroadPhase bp = world.broad_phase();
  VecX q = VecX::Zero(n);
  for (int step = 0; step < 5; ++step) {
    const VecX dq = random.numbers(n, 0.2);
    std::vector<int> all;
    Kinematics kin(world.tree);
    set_configuration(world.tree, q, kin);
    for (int k = 0; k < world.table.size(); ++k) {
      const PairTable::Key key = world.table.key(k);
      const double far = (kin.X_WJ(world.tree, key.a).p - kin.X_WJ(world.tree, key.b).p).norm();
      const double radii = std::get<Sphere>(world.shapes[key.a].shape).radius +
                           std::get<Sphere>(world.shapes[key.b].shape).radius;
      if (far <= radii + std::abs(dq[key.a]) + std::abs(dq[key.b])) all.push_back(k);
    }
    EXPECT_EQ(world.find(q, dq, 0, bp), all);
    q += dq;
  }
}

TEST(BroadPhase, OfNothingFindsNothing) {
  World world;
  BroadPhase bp = world.broad_phase();
  EXPECT_TRUE(world.find(VecX(), VecX(), 1, bp).empty());
}

TEST(BroadPhase, KeepsAllPairsOfAMotionThatIsNotFinite) {
  const World world = row_of_balls(30, 3 * Vec3::UnitX(), Vec3::Zero());
  BroadPhase bp = world.broad_phase();
  const VecX q = VecX::Zero(30);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(world.find(q, VecX::Constant(30, bad), 0, bp).size(), world.pairs.size());
    EXPECT_EQ(world.find(VecX::Constant(30, bad), q, 0, bp).size(), world.pairs.size());
  }
  EXPECT_TRUE(world.find(q, q, 0, bp).empty());
}

// Near pairs that were gathered earlier serve on: the candidates are those of a first call.
TEST(BroadPhase, FindsTheSameWhateverCameBefore) {
  Random random(33);
  for (int w = 0; w < 20; ++w) {
    const World world = random_world(random);
    const int n = world.tree.n_v;
    BroadPhase bp = world.broad_phase();
    VecX q = random_coordinates(world.tree, 3, random);
    for (int leap = 0; leap < 4; ++leap) {
      const VecX dq = random.numbers(n, 0.003);
      for (int k = 0; k < 12; ++k) {  // a drift, wider and narrower sweeps and margins
        const double margin = k % 5 == 0 ? 0.1 : 0, wide = k % 4 == 0 ? 3 : 1;
        BroadPhase fresh = world.broad_phase();
        EXPECT_EQ(world.find(q, wide * dq, margin, bp), world.find(q, wide * dq, margin, fresh));
        q = moved(world.tree, q, 1, dq);
      }
      q = moved(world.tree, q, 1, random.numbers(n, 1));
    }
  }
}

TEST(BroadPhase, GathersOnceInManyCallsOfASteadyMotion) {
  const int n = 50, calls = 100;
  const World world = row_of_balls(n, 2 * Vec3::UnitX(), Vec3::Zero());
  BroadPhase bp = world.broad_phase();
  Random random(35);
  const VecX dq = random.numbers(n, 0.02);
  int gathers = 0;
  for (int k = 0; k < calls; ++k) {
    world.find(k * dq, dq, 0, bp);
    gathers += bp.age == 0;
  }
  EXPECT_LE(gathers, calls / 12 + 3);  // a dozen calls each, but for the first
  EXPECT_GE(gathers, calls / 13);      // they move farther than any skin
}

}  // namespace
}  // namespace saltus
