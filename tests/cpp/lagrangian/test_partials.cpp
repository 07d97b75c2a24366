// L against a naive evaluation from 4x4 matrices, its partials against numeric derivatives.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "lagrangian/evaluate.hpp"
#include "naive.hpp"
#include "numeric.hpp"
#include "plain/energy.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using namespace plain;
using test::RandomTree;
using test::relative_error;
using test::varied_tree;

// A step of 0.01 leaves 2.1 eps / h = 5e-14 of rounding and, with mimic multipliers up to 2 on
// several joints of a branch (frequencies up to 10 or so), (10 h)^8 10 / 630 = 2e-10 of truncation
// at the very most; without mimic joints 1e-16. L's own rounding stands before the 1/h: several
// joints, hence the 10.
constexpr double step = 0.01;
double tolerance(const Tree& tree) { return tree.one_to_one ? 1e-12 : 1e-9; }

MatX numeric(const RandomTree& t, VecX LagrangianPartials::* partial, bool by_velocity) {
  MatX out(t.q.size(), t.q.size());
  for (int j = 0; j < t.q.size(); ++j) {
    out.col(j) = test::derivative(
        [&](double h) {
          VecX q = t.q, v = t.v;
          (by_velocity ? v : q)[j] += h;
          return VecX(lagrangian(t.tree, t.mass, q, v).*partial);
        },
        step);
  }
  return out;
}

TEST(Partials, ValueIsThatOfFourByFourMatrices) {
  for (int k = 0; k < 400; ++k) {
    const RandomTree t = varied_tree(k);
    const double L = lagrangian(t.tree, t.mass, t.q, t.v).value;
    const double naive = test::naive_lagrangian(t.tree, t.mass, t.q, t.v);
    const double still = test::naive_lagrangian(t.tree, t.mass, t.q, VecX::Zero(t.q.size()));
    // rounding of ten joints; V and T may cancel in L
    EXPECT_NEAR(L, naive, 1e-13 * (std::abs(still) + std::abs(naive - still))) << k;
  }
}

TEST(Partials, FirstPartialsAreDerivativesOfTheNaiveValue) {
  for (int k = 0; k < 300; ++k) {
    const RandomTree t = varied_tree(k);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    const auto naive = [&](const VecX& q, const VecX& v) {
      return test::naive_lagrangian(t.tree, t.mass, q, v);
    };
    VecX L_q(t.q.size()), L_v(t.q.size());
    for (int i = 0; i < t.q.size(); ++i) {
      const VecX e = VecX::Unit(t.q.size(), i);
      L_q[i] = test::derivative([&](double h) { return naive(t.q + h * e, t.v); }, step);
      L_v[i] = test::derivative([&](double h) { return naive(t.q, t.v + h * e); }, step);
    }
    const double scale = std::abs(L.value);  // what the rounding of a difference is relative to
    EXPECT_LT(relative_error(L.L_q, L_q, scale), tolerance(t.tree)) << k;
    EXPECT_LT(relative_error(L.L_v, L_v, scale), tolerance(t.tree)) << k;
  }
}

TEST(Partials, SecondPartialsAreDerivativesOfTheFirst) {
  for (int k = 0; k < 300; ++k) {
    const RandomTree t = varied_tree(k);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    const double q_scale = L.L_q.cwiseAbs().maxCoeff(), v_scale = L.L_v.cwiseAbs().maxCoeff();
    const MatX L_qq = numeric(t, &LagrangianPartials::L_q, false);
    const MatX L_vq = numeric(t, &LagrangianPartials::L_v, false);
    const MatX L_qv = numeric(t, &LagrangianPartials::L_q, true);
    const MatX L_vv = numeric(t, &LagrangianPartials::L_v, true);
    EXPECT_LT(relative_error(L.L_qq, L_qq, q_scale), tolerance(t.tree)) << k;
    EXPECT_LT(relative_error(L.L_vq, L_vq, v_scale), tolerance(t.tree)) << k;
    EXPECT_LT(relative_error(L.L_vq.transpose(), L_qv, q_scale), tolerance(t.tree)) << k;
    EXPECT_LT(relative_error(L.L_vv, L_vv, v_scale), tolerance(t.tree)) << k;
  }
}

TEST(Partials, AreSymmetricToTheLastBit) {
  for (int k = 0; k < 100; ++k) {
    const RandomTree t = varied_tree(k);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    EXPECT_EQ(L.L_qq, MatX(L.L_qq.transpose()));
    EXPECT_EQ(L.L_vv, MatX(L.L_vv.transpose()));
    EXPECT_EQ(L.L_v.size(), t.tree.n_v);
    EXPECT_EQ(L.L_q.size(), t.tree.n_v);
  }
}

TEST(Partials, OfDifferentBranchesVanish) {
  test::Random random(3);
  RandomTree t = random_tree(random, {.joints = 9, .branch = 0.7, .new_tree = 0.2});
  const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
  int apart = 0;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      if (t.tree.is_ancestor(i, j) || t.tree.is_ancestor(j, i)) continue;
      ++apart;
      EXPECT_EQ(L.L_vv(i, j), 0);
      EXPECT_EQ(L.L_vq(i, j), 0);
      EXPECT_EQ(L.L_qq(i, j), 0);
    }
  }
  EXPECT_GT(apart, 10);  // or the test tells nothing
}

TEST(Momenta, AreLvToTheLastBitAndTheSlopeOfTheNaiveValue) {
  for (int k = 0; k < 100; ++k) {
    const RandomTree t = varied_tree(k);
    const VecX p = momenta(t.tree, pack(t.tree, t.mass), t.q, t.v);
    EXPECT_EQ(p, lagrangian(t.tree, t.mass, t.q, t.v).L_v) << k;
    VecX slope(t.q.size());
    for (int i = 0; i < t.q.size(); ++i) {
      const VecX e = VecX::Unit(t.q.size(), i);
      slope[i] = test::derivative(
          [&](double h) { return test::naive_lagrangian(t.tree, t.mass, t.q, t.v + h * e); }, step);
    }
    const double scale = std::abs(test::naive_lagrangian(t.tree, t.mass, t.q, t.v));
    EXPECT_LT(relative_error(p, slope, scale), tolerance(t.tree)) << k;
  }
}

TEST(MassMatrix, IsPositiveDefiniteAndLvv) {
  for (int k = 0; k < 200; ++k) {
    const RandomTree t = varied_tree(k);
    const MatX M = mass_matrix(t.tree, t.mass, t.q);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    EXPECT_LT(relative_error(M, L.L_vv), 1e-14) << k;  // rounding
    EXPECT_EQ(Eigen::LLT<MatX>(M).info(), Eigen::Success) << k;
    // L is quadratic in v: L_v = M v, T = v.M v / 2
    EXPECT_LT(relative_error(VecX(M * t.v), L.L_v), 1e-13) << k;
  }
}

// The same system seen from other axes and another place is the same system.
TEST(Partials, DoNotDependOnTheWorldFrame) {
  test::Random random(5);
  for (int k = 0; k < 50; ++k) {
    const RandomTree t = varied_tree(k);
    const Pose X = {random.rotation(), random.vec3(10)};
    RandomTree moved = t;
    moved.mass.gravity = X.R * t.mass.gravity;
    double raised = 0;
    for (int i = 0; i < t.tree.joints(); ++i) {
      if (t.tree.parent[i] < 0) moved.tree.X_PJ[i] = X * t.tree.X_PJ[i];
      raised += t.mass.body[i].mass * moved.mass.gravity.dot(X.p);
    }
    const LagrangianPartials a = lagrangian(t.tree, t.mass, t.q, t.v);
    const LagrangianPartials b = lagrangian(moved.tree, moved.mass, t.q, t.v);
    // rounding of ten joints and one more rotation
    EXPECT_NEAR(a.value + raised, b.value, 1e-13 * (std::abs(raised) + std::abs(a.value) + 100));
    EXPECT_LT(relative_error(a.L_q, b.L_q, 1), 1e-13);
    EXPECT_LT(relative_error(a.L_v, b.L_v, 1), 1e-13);
    EXPECT_LT(relative_error(a.L_qq, b.L_qq, 1), 1e-13);
    EXPECT_LT(relative_error(a.L_vq, b.L_vq, 1), 1e-13);
    EXPECT_LT(relative_error(a.L_vv, b.L_vv, 1), 1e-13);
  }
}

// About the world's origin, inertias of a tree 1e6 m away would have lost 12 digits.
TEST(Partials, KeepEveryBitFarFromTheOrigin) {
  for (int k = 0; k < 50; ++k) {
    const RandomTree t = varied_tree(k);
    RandomTree far = t;
    for (int i = 0; i < t.tree.joints(); ++i) {
      if (t.tree.parent[i] < 0) far.tree.X_PJ[i].p += Vec3(1e6, -2e6, 3e6);
    }
    const LagrangianPartials a = lagrangian(t.tree, t.mass, t.q, t.v);
    const LagrangianPartials b = lagrangian(far.tree, far.mass, t.q, t.v);
    EXPECT_EQ(a.L_q, b.L_q);
    EXPECT_EQ(a.L_v, b.L_v);
    EXPECT_EQ(a.L_qq, b.L_qq);
    EXPECT_EQ(a.L_vq, b.L_vq);
    EXPECT_EQ(a.L_vv, b.L_vv);
  }
}

TEST(PotentialEnergy, IsMinusLAtRest) {
  for (int k = 0; k < 50; ++k) {
    const RandomTree t = varied_tree(k);
    const test::Evaluation at = evaluate(t);
    const double V = potential_energy(t.tree, t.mass, at.kin);
    const double naive = -test::naive_lagrangian(t.tree, t.mass, t.q, VecX::Zero(t.q.size()));
    EXPECT_NEAR(V, naive, 1e-13 * (100 + std::abs(naive)));
  }
}

}  // namespace
}  // namespace saltus
