// Products with the Hessian of L against the dense partials, and solves with J^T.
#include "saltus/lagrangian/packed_hessian.hpp"

#include <gtest/gtest.h>

#include "lagrangian/ball_arc.hpp"
#include "lagrangian/packed_trees.hpp"
#include "lagrangian/sprung_trees.hpp"
#include "numeric.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using test::BallArc;
using test::RandomTree;
using test::relative_error;

/// Every second one with springs, curves and functions.
RandomTree tree_of(int k) {
  RandomTree t = k % 3 == 0 ? test::packed_tree(k / 3) : test::varied_ball_tree(k);
  if (k % 2 == 0) test::add_potentials(static_cast<std::uint64_t>(k), k % 4 == 0, t);
  return t;
}

// 1e-13: rounding of sums along nine joints and more, relative to the largest entry.
TEST(HessianProduct, IsThatOfTheDensePartials) {
  for (int k = 0; k < 90; ++k) {
    const RandomTree t = tree_of(k);
    BallArc arc(t, TreeSolver::automatic);
    arc.momenta(t.v, 0);
    second_pass(arc.packed, arc.w);
    const LagrangianPartials L = lagrangian(t.tree, arc.packed, t.q, t.v);
    test::Random random(static_cast<std::uint64_t>(k));
    const VecX x = random.vector(t.tree.n_v), y = random.vector(t.tree.n_v);
    HessianProduct product(t.tree);
    take_generators(t.tree, arc.packed, arc.w, product);
    multiply_by_hessian(t.tree, arc.packed, arc.w, x, y, product);
    const double size = L.L_vv.norm() + L.L_vq.norm() + L.L_qq.norm();
    EXPECT_LT(relative_error(product.by_v, VecX(L.L_vv * y + L.L_vq * x), size), 1e-13) << k;
    EXPECT_LT(relative_error(product.by_q, VecX(L.L_vq.transpose() * y + L.L_qq * x), size), 1e-13)
        << k;
    multiply_by_transposed(t.tree, arc.packed, arc.w, x, y, product);
    EXPECT_LT(relative_error(product.by_v, VecX(L.L_vv * y + L.L_vq * x), size), 1e-13) << k;
    EXPECT_LT(
        relative_error(product.by_q, VecX(L.L_vq.transpose() * y + L.L_qq.transpose() * x), size),
        1e-13)
        << k;
  }
}

/// y.(J^-1 x) = (J^-T y).x, with every solver.
TEST(SolveTransposed, IsTheTransposeOfSolve) {
  for (const TreeSolver solver : {TreeSolver::automatic, TreeSolver::lu, TreeSolver::sweep}) {
    for (int k = 0; k < 90; ++k) {
      const RandomTree t = tree_of(k);
      BallArc arc(t, solver);
      test::Random random(static_cast<std::uint64_t>(k));
      const VecX x = random.vector(t.tree.n_v), y = random.vector(t.tree.n_v);
      for (const double tau : {0.0, 0.01, 0.1}) {
        arc.momenta(t.v, tau);
        second_pass(arc.packed, arc.w);
        if (!factorize(t.tree, arc.packed, arc.w, tau, arc.J)) continue;  // mimics may cancel
        VecX solved = x, back = y;
        solve_scaled(t.tree, arc.packed, arc.J, solved);
        solve_transposed(t.tree, arc.packed, arc.J, back);
        // rounding, times the condition of J
        const double size = y.norm() * solved.norm() + x.norm() * back.norm();
        EXPECT_LT(std::abs(y.dot(solved) - back.dot(x)), 1e-11 * size) << k << " tau " << tau;
        VecX again = x;
        solve_scaled(t.tree, arc.packed, arc.J, again);
        EXPECT_EQ(again, solved) << "the factors are as they were";
      }
    }
  }
}

}  // namespace
}  // namespace saltus
