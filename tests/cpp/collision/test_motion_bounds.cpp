// How far shapes move along a chord, which clearances rest on.
#include <gtest/gtest.h>

#include <cmath>

#include "collision/random_world.hpp"

namespace saltus {
namespace {

using testing_scene::moved;
using testing_scene::Random;
using testing_scene::random_coordinates;
using testing_world::random_world;
using testing_world::World;

/// No gap changes by more than its shapes move.
TEST(MotionBounds, NoGapChangesByMoreThanItsShapesMove) {
  Random random(7);
  for (int k = 0; k < 30; ++k) {
    const World world = random_world(random);
    BroadPhase bp = world.broad_phase();
    const VecX q = random_coordinates(world.tree, 3, random);
    const VecX dq = random.numbers(world.tree.n_v, 0.1);
    Kinematics kin(world.tree), other(world.tree);
    set_configuration(world.tree, q, kin);
    find_candidates(world.tree, world.shapes, world.table, kin, dq, 0, bp);
    for (const double s : {0.3, 1.0}) {
      set_configuration(world.tree, moved(world.tree, q, s, dq), other);
      for (const Pair& pair : world.pairs) {
        if (pair.kind == PairKind::crossing) continue;  // theirs is no distance
        const double change =
            pair_gap(world.tree, other, pair).phi - pair_gap(world.tree, kin, pair).phi;
        EXPECT_LE(std::abs(change), bp.motion[pair.a] + bp.motion[pair.b] + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace saltus
