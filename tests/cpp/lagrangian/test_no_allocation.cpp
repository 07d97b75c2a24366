// What a step does many times over must not allocate, with mimic joints either.
#include <gtest/gtest.h>

#include "count_allocations.hpp"
#include "lagrangian/evaluate.hpp"
#include "saltus/lagrangian/arc_matrix.hpp"
#include "saltus/lagrangian/energy.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using test::allocations;

TEST(Allocation, CounterSeesEigenAndTheLibrary) {
  const long before = allocations;
  const VecX x = VecX::Ones(10);
  const long here = allocations;
  EXPECT_GT(here, before);
  EXPECT_EQ(x.sum(), 10);
  const Tree none;
  lagrangian(none, {}, VecX(), VecX());
  const long empty = allocations - here;  // no arrays: vectors and matrices without entries
  const test::RandomTree t = test::varied_tree(3);
  const long before_call = allocations;
  const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
  EXPECT_GE(allocations - before_call, empty + 5);  // L_q, L_v, L_qq, L_vq, L_vv at least
  EXPECT_EQ(L.L_q.size(), t.tree.coordinates);
}

TEST(Allocation, NoneInTheRecursions) {
  for (const double mimic : {0.0, 0.3}) {
    test::Random random(2);
    const test::RandomTree t = random_tree(random, {.joints = 30, .branch = 0.2, .mimic = mimic});
    ASSERT_EQ(t.tree.one_to_one, mimic == 0);
    test::Evaluation at = evaluate(t);
    ArcMatrix J(t.tree);
    SecondPartialsTimes times_x;
    VecX by_joint = VecX::Zero(t.tree.joints()), x = t.v;
    multiply_second_partials(t.tree, at.kin, at.comp, by_joint, times_x);  // sizes its arrays

    const long before = allocations;
    set_configuration(t.tree, t.q, at.kin);
    set_velocity(t.tree, t.v, at.kin);
    first_pass(t.tree, t.mass, at.kin, at.comp);
    second_pass(t.tree, t.mass, at.kin, at.comp);
    to_joints(t.tree, t.v, by_joint);
    multiply_second_partials(t.tree, at.kin, at.comp, by_joint, times_x);
    to_coordinates(t.tree, times_x.L_vv_x, x);
    const bool regular = factorize(t.tree, at.kin, at.comp, 0.01, J);
    solve(t.tree, J, x);
    EXPECT_EQ(allocations, before) << "mimic " << mimic;
    EXPECT_TRUE(regular);
  }
}

}  // namespace
}  // namespace saltus
