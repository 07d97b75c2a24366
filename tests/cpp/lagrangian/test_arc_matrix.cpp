// J(tau) factored along the tree against dense matrices; products with second partials.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "lagrangian/evaluate.hpp"
#include "numeric.hpp"
#include "plain/arc_matrix.hpp"
#include "plain/energy.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using namespace plain;
using test::Random;
using test::RandomTree;
using test::relative_error;
using test::varied_tree;

// Times of zero, of a usual step, and of a step so long that the parts with tau rule.
constexpr double times[] = {0, 0.01, 0.3};

/// theory, section 3, from the dense partials.
MatX arc_matrix(const LagrangianPartials& L, double tau) {
  return L.L_vv + tau / 2 * (L.L_vq - L.L_vq.transpose()) - tau * tau / 4 * L.L_qq;
}

TEST(ArcMatrix, DenseIsTheSumOfPartials) {
  for (int k = 0; k < 200; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    for (const double tau : times) {
      const int n = t.tree.n_v;
      MatX J = MatX::Ones(n, n);  // add_dense adds
      add_dense(t.tree, at.kin, at.comp, tau, J);
      // rounding of sums of products of two 6-vectors
      EXPECT_LT(relative_error(MatX(J - MatX::Ones(n, n)), arc_matrix(L, tau), 1), 1e-14) << k;
    }
  }
}

// x of the sweep and x of a dense LU differ by the rounding of both, 1e-16 times the condition of J
// and a factor that grows with n.
TEST(ArcMatrix, SolveAgreesWithDenseLU) {
  for (int k = 0; k < 300; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    ArcMatrix J(t.tree);
    Random random(static_cast<std::uint64_t>(k));
    for (const double tau : times) {
      const MatX dense = arc_matrix(L, tau);
      const Eigen::FullPivLU<MatX> lu(dense);
      const double condition = 1 / lu.rcond();
      if (condition > 1e4) continue;
      const VecX r = random.vector(t.tree.n_v);
      VecX x = r;
      ASSERT_TRUE(factorize(t.tree, at.kin, at.comp, tau, J));
      solve(t.tree, J, x);
      EXPECT_LT(relative_error(x, VecX(lu.solve(r))), 1e-12) << k << " tau " << tau;
    }
  }
}

// Backward error: whatever the condition, J x = r holds to rounding.
TEST(ArcMatrix, SolveLeavesNoResidual) {
  for (int k = 0; k < 300; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    ArcMatrix J(t.tree);
    const VecX r = Random(static_cast<std::uint64_t>(k)).vector(t.tree.n_v);
    for (const double tau : {0.0, 0.01}) {
      const MatX dense = arc_matrix(L, tau);
      VecX x = r;
      ASSERT_TRUE(factorize(t.tree, at.kin, at.comp, tau, J));
      solve(t.tree, J, x);
      EXPECT_LT((dense * x - r).norm(), 1e-13 * dense.norm() * x.norm()) << k << " tau " << tau;
    }
  }
}

// Whatever was factored before, in either of the two sweeps, and after a failure.
TEST(ArcMatrix, CanBeUsedAgain) {
  for (int k = 0; k < 30; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    const VecX r = Random(1).vector(t.tree.n_v);
    ArcMatrix used(t.tree);
    RandomTree bad = t;
    bad.q.setConstant(std::numeric_limits<double>::quiet_NaN());
    const test::Evaluation at_bad = evaluate(bad);
    factorize(t.tree, at_bad.kin, at_bad.comp, 0.3, used);
    for (const double tau : {0.0, 0.3, 0.0, 0.01, 0.3, 0.0}) {
      ArcMatrix fresh(t.tree);
      VecX x = r, y = r;
      ASSERT_TRUE(factorize(t.tree, at.kin, at.comp, tau, used));
      ASSERT_TRUE(factorize(t.tree, at.kin, at.comp, tau, fresh));
      solve(t.tree, used, x);
      solve(t.tree, fresh, y);
      EXPECT_EQ(x, y) << k << " tau " << tau;
    }
  }
}

// M depends on q alone: no velocity and no second pass is needed, and none is read.
TEST(ArcMatrix, MassPassIsEnoughForTheMassMatrix) {
  for (int k = 0; k < 100; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    test::Evaluation mass_only{Kinematics(t.tree), Composite(t.tree)};
    set_configuration(t.tree, t.q, mass_only.kin);
    mass_pass(t.tree, t.mass, mass_only.kin, mass_only.comp);
    for (int i = 0; i < t.tree.joints(); ++i) {  // rounding
      EXPECT_LT(relative_error(mass_only.comp.joint[i].U, at.comp.joint[i].U), 1e-14);
    }
    ArcMatrix M(t.tree);
    ASSERT_TRUE(factorize(t.tree, mass_only.kin, mass_only.comp, 0, M));
    const VecX r = Random(static_cast<std::uint64_t>(k)).vector(t.tree.n_v);
    const MatX dense = mass_matrix(t.tree, t.mass, t.q);
    VecX x = r;
    solve(t.tree, M, x);
    EXPECT_LT((dense * x - r).norm(), 1e-13 * dense.norm() * x.norm()) << k;  // backward error
  }
}

// build() names the joint by it.
TEST(ArcMatrix, TellsWhichPivotVanishes) {
  RandomTree t;
  for (int k = 0; k < 3; ++k) {  // two slides on one line below a third that is square to it
    const Mat3 R = k == 1 ? rotation_z_to(Vec3::UnitX()) : Mat3(Mat3::Identity());
    add_joint(t.tree, k - 1, {Joint::Kind::prismatic, 0}, {R, Vec3::Zero()}, {k, 1, 0});
    t.mass.body.push_back({k == 1 ? 0.0 : 1.0, Vec3::Zero(), Mat3::Identity()});
  }
  t.q = t.v = VecX::Zero(3);
  const test::Evaluation at = evaluate(t);
  for (const double tau : {0.0, 0.01}) {
    ArcMatrix J(t.tree);
    EXPECT_FALSE(factorize(t.tree, at.kin, at.comp, tau, J));
    EXPECT_EQ(J.joint[2].inverse_D, 1);
    EXPECT_FALSE(std::isfinite(J.joint[1].inverse_D));
  }
}

TEST(ArcMatrix, DeepTreesKeepTheirDigits) {
  Random random(4);
  RandomTree t = random_tree(random, {.joints = 300, .branch = 0.1});
  t.v *= 0.1;  // speeds add up along the tree
  const test::Evaluation at = test::evaluate(t);
  const MatX dense = arc_matrix(lagrangian(t.tree, t.mass, t.q, t.v), 0.001);
  ArcMatrix J(t.tree);
  const VecX r = random.vector(t.tree.n_v);
  VecX x = r;
  ASSERT_TRUE(factorize(t.tree, at.kin, at.comp, 0.001, J));
  solve(t.tree, J, x);
  EXPECT_LT((dense * x - r).norm(), 1e-12 * dense.norm() * x.norm());  // rounding of 300 joints
}

TEST(ArcMatrix, SingularAndNaNAreTold) {
  for (const double mimic : {0.0, 0.5}) {
    Random random(6);
    RandomTree t = random_tree(random, {.joints = 6, .branch = 0, .mimic = mimic});
    EXPECT_EQ(t.tree.one_to_one, mimic == 0);
    ArcMatrix J(t.tree);
    RandomTree nan = t;
    nan.v[0] = std::numeric_limits<double>::quiet_NaN();
    const test::Evaluation at_nan = test::evaluate(nan);
    EXPECT_FALSE(factorize(t.tree, at_nan.kin, at_nan.comp, 0.01, J));
    RandomTree infinite = t;
    infinite.mass.body[0].I_J *= std::numeric_limits<double>::infinity();
    const test::Evaluation at_infinite = test::evaluate(infinite);
    EXPECT_FALSE(factorize(t.tree, at_infinite.kin, at_infinite.comp, 0, J));
    RandomTree massless = t;
    for (BodyInertia& body : massless.mass.body) body = {};
    const test::Evaluation at_massless = test::evaluate(massless);
    EXPECT_FALSE(factorize(t.tree, at_massless.kin, at_massless.comp, 0, J));
    const test::Evaluation at = test::evaluate(t);
    EXPECT_TRUE(factorize(t.tree, at.kin, at.comp, 0, J));
  }
}

TEST(SecondPartialsTimes, AgreeWithDenseProducts) {
  SecondPartialsTimes times_x;  // reused: sizes must adapt
  for (int k = 0; k < 200; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    const VecX x = Random(static_cast<std::uint64_t>(k)).vector(t.tree.n_v);
    VecX by_joint(t.tree.joints()), folded(t.tree.n_v);
    to_joints(t.tree, x, by_joint);
    multiply_second_partials(t.tree, at.kin, at.comp, by_joint, times_x);
    const double scale = L.L_vv.norm() + L.L_qq.norm() + L.L_vq.norm();
    const auto expect = [&](const VecX& product, const MatX& matrix) {
      to_coordinates(t.tree, product, folded);
      // rounding, of sums that cancel at times
      EXPECT_LT(relative_error(folded, VecX(matrix * x), scale), 1e-14) << k << matrix;
    };
    expect(times_x.L_vv_x, L.L_vv);
    expect(times_x.L_vq_x, L.L_vq);
    expect(times_x.L_qv_x, L.L_vq.transpose());
    expect(times_x.L_qq_x, L.L_qq);
  }
}

}  // namespace
}  // namespace saltus
