// What a step does many times over must not allocate, with mimic joints either.
#include <gtest/gtest.h>

#include "count_allocations.hpp"
#include "lagrangian/packed_trees.hpp"
#include "saltus/lagrangian/newton_euler.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/lagrangian/shadow.hpp"

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
  lagrangian(none, MassModel{}, VecX(), VecX());
  const long empty = allocations - here;  // no arrays: vectors and matrices without entries
  const test::RandomTree t = test::varied_tree(3);
  const long before_call = allocations;
  const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
  EXPECT_GE(allocations - before_call, empty + 5);  // L_q, L_v, L_qq, L_vq, L_vv at least
  EXPECT_EQ(L.L_q.size(), t.tree.n_v);
}

TEST(Allocation, CounterSeesBlocks) {
  const long before = allocations;
  const Blocks<3> blocks(2);
  EXPECT_EQ(allocations, before + 1);
  EXPECT_EQ(blocks[1].x[2][7], 0);
}

TEST(Allocation, NoneInTheKernels) {
  for (int k = 0; k < 12; ++k) {
    test::PackedEvaluation e(test::packed_tree(k));
    PackedMatrix J(e.t.tree, e.packed);
    PackedProducts products(e.packed);
    SecondPartials rows(e.packed);
    FreeMotion free(e.t.tree, e.packed);
    PackedForces forces(e.packed);
    ShadowTerm shadow(e.t.tree, e.packed);
    VecX x = e.t.v;
    const long before = allocations;
    set_coordinates(e.t.tree, e.packed, e.t.q, e.w);
    set_rates(e.t.tree, e.packed, e.t.v, e.w);
    place(e.packed, e.w);
    move(e.packed, e.w);
    set_accelerations(e.t.tree, e.packed, e.t.v, forces);
    newton_euler(e.packed, e.w, forces);
    first_pass(e.packed, e.w);
    gravity_pass(e.packed, e.w, forces);
    scale_pass(e.packed, 0.1, e.w);
    second_pass(e.packed, e.w);
    multiply_by_rates(e.packed, e.w, products);
    multiply_pairs(e.packed, e.w, rows);
    factorize(e.t.tree, e.packed, e.w, 0.1, J);
    solve(e.t.tree, e.packed, J, x);
    factorize(e.t.tree, e.packed, e.w, 0, J);
    free_motion(e.t.tree, e.packed, e.w, J, free);
    shadow_gradient(e.t.tree, e.packed, e.w, free.a, shadow);
    EXPECT_EQ(allocations, before) << k;
  }
}

}  // namespace
}  // namespace saltus
