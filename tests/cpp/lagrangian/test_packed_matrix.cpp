// Factors of J against dense matrices and the plain sweep, for both solvers.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lagrangian/packed_trees.hpp"
#include "plain/arc_matrix.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using namespace plain;
using test::PackedEvaluation;

constexpr int trees = 60;
constexpr TreeSolver solvers[] = {TreeSolver::automatic, TreeSolver::lu, TreeSolver::sweep};

MatX dense_of(const PackedEvaluation& e, double tau) {
  MatX J = MatX::Zero(e.t.tree.n_v, e.t.tree.n_v);
  add_dense(e.t.tree, e.plain.kin, e.plain.comp, tau, J);
  return J;
}

// Backward error: |J x - b| against |J||x|, a few eps a joint on the path.
TEST(PackedMatrix, SolvesAsADenseMatrixDoes) {
  for (int k = 0; k < trees; ++k) {
    for (const TreeSolver solver : solvers) {
      const PackedEvaluation e(test::packed_tree(k), solver);
      PackedMatrix J(e.t.tree, e.packed);
      test::Random random(static_cast<std::uint64_t>(k));
      for (const double tau : {0.0, 0.01, 0.1}) {
        if (!e.t.tree.one_to_one && dense_of(e, tau).fullPivLu().rcond() < 1e-10) continue;
        const VecX b = random.vector(e.t.tree.n_v);
        ASSERT_TRUE(factorize(e.t.tree, e.packed, e.w, tau, J)) << k;
        VecX x = b;
        solve(e.t.tree, e.packed, J, x);
        const MatX dense = dense_of(e, tau);
        EXPECT_LE((dense * x - b).norm(), 1e-12 * dense.norm() * x.norm())
            << "tree " << k << " tau " << tau;
      }
    }
  }
}

TEST(PackedMatrix, MassPassAloneGivesTheMassMatrix) {
  for (int k = 0; k < trees; ++k) {
    for (const TreeSolver solver : solvers) {
      PackedEvaluation e(test::packed_tree(k), solver);
      const MatX M = dense_of(e, 0);
      if (M.fullPivLu().rcond() < 1e-10) continue;  // mimic joints may cancel
      Packed w(e.packed);
      set_coordinates(e.t.tree, e.packed, e.t.q, w);
      place(e.packed, w);
      mass_pass(e.packed, w);
      PackedMatrix factors(e.t.tree, e.packed);
      ASSERT_TRUE(factorize(e.t.tree, e.packed, w, 0, factors)) << k;
      VecX x = M * e.t.v;
      solve(e.t.tree, e.packed, factors, x);
      EXPECT_LE((M * (x - e.t.v)).norm(), 1e-12 * M.norm() * e.t.v.norm()) << k;
      EXPECT_LE((mass_matrix(e.t.tree, e.packed, e.t.q) - M).norm(), 1e-13 * M.norm()) << k;
    }
  }
}

TEST(PackedMatrix, RowsAreTheSecondPartials) {
  for (int k = 0; k < trees; ++k) {
    const PackedEvaluation e(test::packed_tree(k));
    SecondPartials rows(e.packed);
    multiply_pairs(e.packed, e.w, rows);
    const LagrangianPartials L = lagrangian(e.t.tree, e.packed, e.t.q, e.t.v);
    MatX M = MatX::Zero(L.L_vv.rows(), L.L_vv.cols()), J = M;
    add_dense(e.t.tree, e.plain.kin, e.plain.comp, 0, M);
    add_dense(e.t.tree, e.plain.kin, e.plain.comp, 0.2, J);
    const double scale = L.L_vv.norm() + L.L_vq.norm() + L.L_qq.norm();
    EXPECT_LE((L.L_vv - M).norm(), 1e-13 * scale) << k;
    const MatX sum = L.L_vv + 0.1 * (L.L_vq - L.L_vq.transpose()) - 0.01 * L.L_qq;
    EXPECT_LE((sum - J).norm(), 1e-13 * scale) << k;
    int pairs = 0;
    for_each_pair(e.packed, [&](int j, int i, long) {
      EXPECT_TRUE(e.t.tree.is_ancestor(i, j));
      ++pairs;
    });
    int expected = 0;
    for (int j = 0; j < e.t.tree.joints(); ++j) {
      for (int i = j; i >= 0; i = e.t.tree.parent[i]) ++expected;
    }
    EXPECT_EQ(pairs, expected);
  }
}

// M^-1 of a row that is zero but on one tree is zero but there.
TEST(PackedMatrix, OneTreeIsSolvedAsAllAre) {
  for (int k = 0; k < trees; ++k) {
    for (const TreeSolver solver : solvers) {
      const PackedEvaluation e(test::packed_tree(k), solver);
      if (!e.t.tree.one_to_one) continue;
      PackedMatrix J(e.t.tree, e.packed);
      ASSERT_TRUE(factorize(e.t.tree, e.packed, e.w, 0.01, J));
      for (int tree = 0; tree < static_cast<int>(e.packed.trees.size()); ++tree) {
        const PackedPlace place = e.packed.trees[tree];
        const PackedGroup& g = e.packed.groups[place.group];
        VecX all = VecX::Zero(e.t.tree.n_v), one(g.positions);
        for (int i = 0; i < g.positions; ++i) {
          one[i] = 1 + i;
          all[e.packed.joint[g.slot(i) + place.lane]] = one[i];
        }
        solve(e.t.tree, e.packed, J, all);
        solve_tree(e.packed, tree, J, one.data());
        double rest = all.cwiseAbs().sum();
        for (int i = 0; i < g.positions; ++i) {
          const double expected = all[e.packed.joint[g.slot(i) + place.lane]];
          EXPECT_NEAR(one[i], expected, 1e-10 * all.norm()) << k;  // their condition times eps
          rest -= std::abs(expected);
        }
        EXPECT_NEAR(rest, 0, 1e-13 * all.cwiseAbs().sum()) << k;
      }
    }
  }
}

// A joint that moves no mass has no pivot; the others' lanes must not hide it.
TEST(PackedMatrix, AVanishingPivotIsTold) {
  test::Random random(6);
  for (const TreeSolver solver : solvers) {
    for (const int copies : {1, 3}) {
      test::RandomTree t =
          test::copies_of(random_tree(random, {.joints = 4, .branch = 0}), copies, random);
      t.mass.body.back() = {};
      const PackedEvaluation e(t, solver);
      PackedMatrix J(e.t.tree, e.packed);
      EXPECT_FALSE(factorize(e.t.tree, e.packed, e.w, 0, J));
      const double inverse = *at(J.inverse, e.packed.slot[t.tree.joints() - 1]);
      EXPECT_FALSE(std::isfinite(inverse));
    }
  }
}

}  // namespace
}  // namespace saltus
