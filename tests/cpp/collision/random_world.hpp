// Random shapes on random trees, with all their pairs: for tests of the broad phase.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "collision/random_scene.hpp"
#include "saltus/collision/broad_phase.hpp"

namespace saltus::testing_world {

using testing_scene::carrier;
using testing_scene::moved;
using testing_scene::place;
using testing_scene::Random;
using testing_scene::random_coordinates;
using testing_scene::random_shape;
using testing_scene::random_tree;

struct World {
  Tree tree;
  std::vector<PlacedShape> shapes;
  PairTable table;
  std::vector<Pair> pairs;

  void add_all_pairs() {
    table = testing_scene::table_of(shapes);
    pairs = testing_scene::pairs_of(tree, shapes, table);
  }

  BroadPhase broad_phase() const { return {tree, shapes, table}; }

  const std::vector<int>& find(const VecX& q, const VecX& dq, double margin, BroadPhase& bp) const {
    Kinematics kin(tree);
    set_configuration(tree, q, kin);
    find_candidates(tree, shapes, table, kin, dq, margin, bp);
    return bp.candidates;
  }

  /// Least gap of each pair over samples of the chord.
  std::vector<double> least_gaps(const VecX& q, const VecX& dq) const {
    std::vector<double> least(pairs.size(), 1e300);
    Kinematics kin(tree);
    for (int k = 0; k <= 8; ++k) {
      set_configuration(tree, moved(tree, q, k / 8.0, dq), kin);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Gap g = pair_gap(tree, kin, pairs[i]);
        if (!is_silent(tree, kin, pairs[i], g)) least[i] = std::min(least[i], g.phi);
      }
    }
    return least;
  }
};

inline World random_world(Random& random) {
  World world;
  const int joints = 1 + random.index(30);
  // branching with the world among the choices: several trees
  world.tree = random_tree(
      {.joints = joints, .offset = 1, .branching = 0.5, .ball = random.chance(0.5) ? 0.4 : 0},
      random);
  const std::vector<std::string> kinds = {"sphere",  "sphere", "sphere",
                                          "capsule", "box",    "cylinder"};
  for (int k = 0; k < 20; ++k) {
    const Shape shape = random_shape(kinds[random.index(6)], random);
    world.shapes.push_back(
        place(shape, carrier(world.tree, random.index(joints + 1) - 1), random.pose(1)));
  }
  for (int k = random.index(3); k > 0; --k) {
    world.shapes.insert(world.shapes.begin() + random.index(20),
                        place(HalfSpace{}, -1, {random.rotation(), random.vector(5)}));
  }
  world.add_all_pairs();
  return world;
}

}  // namespace saltus::testing_world
