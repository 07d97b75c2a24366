// What the stepper calls in every step must not allocate.
#include <gtest/gtest.h>

#include "collision/gap_scene.hpp"
#include "count_allocations.hpp"
#include "saltus/collision/broad_phase.hpp"
#include "saltus/collision/chord.hpp"

namespace saltus {
namespace {

using test::allocations;
using testing_scene::place;
using testing_scene::Random;

TEST(Allocation, CounterCounts) {
  const long before = allocations;
  const std::vector<int> some(10);
  EXPECT_GT(allocations, before);
  const long here = allocations;
  struct alignas(64) Lanes {
    double x[8];
  };
  const std::vector<Lanes> aligned(2);
  EXPECT_GT(allocations, here);
}

TEST(Allocation, NoneInAStep) {
  Random random(41);
  const int n = 12;
  const Tree tree = testing_scene::random_tree({.joints = n}, random);
  std::vector<PlacedShape> shapes;
  for (int i = 0; i < n; ++i) shapes.push_back(place(Sphere{0.4}, i, random.pose(0.2)));
  shapes.push_back(place(HalfSpace{}, -1, {}));
  shapes.push_back(place(Box{Vec3(0.2, 0.3, 0.4)}, 2, random.pose(0.2)));
  const PairTable table = testing_scene::table_of(shapes);
  const std::vector<Pair> pairs = testing_scene::pairs_of(tree, shapes, table);
  Kinematics kin(tree);
  BroadPhase bp(tree, shapes, table);
  const VecX q = random.numbers(tree.n_v, 1), dq = random.numbers(tree.n_v, 1);
  VecX phi_q = VecX::Zero(q.size());
  MatX phi_qq = MatX::Zero(q.size(), q.size());

  const long before = allocations;
  set_configuration(tree, q, kin);
  find_candidates(tree, shapes, table, kin, dq, 0, bp);
  int hits = 0;
  for (const int i : bp.candidates) {
    hits += first_hit_on_chord(tree, pairs[i], q, dq, 0).outcome == ChordHit::Outcome::hit;
    const Gap g = pair_gap(tree, kin, pairs[i]);
    add_gap_gradient(tree, kin, pairs[i], g, phi_q);
    add_gap_hessian(tree, kin, pairs[i], g, phi_qq);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 0);
}

TEST(Allocation, NoneInAnyGap) {
  for (const auto& names : gap_table()) {
    Random random(42);
    for (int k = 0; k < 100; ++k) {
      const testing_scene::Placed x = testing_scene::random_placed(names, random);
      const long before = allocations;
      const Gap g = x.gap();
      EXPECT_EQ(allocations, before) << names.first << " " << names.second;
      EXPECT_TRUE(std::isfinite(g.phi));
    }
  }
}

}  // namespace
}  // namespace saltus
