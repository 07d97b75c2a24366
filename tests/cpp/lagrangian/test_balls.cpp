// Balls: partials and what they make, against numeric derivatives along q (+) x.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "lagrangian/ball_arc.hpp"
#include "numeric.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/lagrangian/shadow.hpp"

namespace saltus {
namespace {

using test::BallArc;
using test::moved;
using test::RandomTree;
using test::relative_error;
using test::varied_ball_tree;

// As in test_partials.cpp: rounding over the step, and mimic multipliers' truncation.
constexpr double step = 0.01;
double tolerance(const Tree& tree) { return tree.one_to_one ? 2e-12 : 1e-9; }

/// L from the motion of poses, which knows no twist: velocities are numeric.
double naive_lagrangian(const RandomTree& t, const VecX& q, const VecX& v) {
  Kinematics kin(t.tree), at(t.tree);
  set_configuration(t.tree, q, kin);
  double L = 0;
  for (int i = 0; i < t.tree.joints(); ++i) {
    const BodyInertia& body = t.mass.body[i];
    if (body.mass == 0) continue;
    const auto pose = [&](double h) {
      set_configuration(t.tree, moved(t.tree, q, h * v), at);
      const Pose X = at.X_WJ(t.tree, i);
      Eigen::Matrix<double, 3, 4> out;
      out << X.R, X * body.c_J;
      return out;
    };
    const auto rate = test::derivative(pose, step);
    const Pose X = kin.X_WJ(t.tree, i);
    const Mat3 W = rate.leftCols<3>() * X.R.transpose();
    const Vec3 w(W(2, 1), W(0, 2), W(1, 0));
    L += 0.5 * body.mass * rate.col(3).squaredNorm() +
         0.5 * w.dot(X.R * body.I_J * X.R.transpose() * w) +
         body.mass * t.mass.gravity.dot(X * body.c_J);
  }
  return L;
}

/// d f(q (+) h e_j, v) / dh, columns j.
template <class F>
MatX by_q(const RandomTree& t, const F& f) {
  return test::jacobian([&](const VecX& x) { return VecX(f(moved(t.tree, t.q, x), t.v)); },
                        VecX::Zero(t.tree.n_v));
}
template <class F>
MatX by_v(const RandomTree& t, const F& f) {
  return test::jacobian([&](const VecX& v) { return VecX(f(t.q, v)); }, t.v);
}

TEST(BallPartials, ValueIsThatOfMovingPoses) {
  for (int k = 0; k < 60; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const double L = lagrangian(t.tree, t.mass, t.q, t.v).value;
    // numeric velocities: 1e-12 of the kinetic energy, which is up to 50 times L
    EXPECT_NEAR(L, naive_lagrangian(t, t.q, t.v), tolerance(t.tree) * (100 + 50 * std::abs(L)))
        << k;
  }
}

TEST(BallPartials, AreDerivativesAlongVelocities) {
  for (int k = 0; k < 120; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const auto at = [&](const VecX& q, const VecX& v) { return lagrangian(t.tree, t.mass, q, v); };
    const LagrangianPartials L = at(t.q, t.v);
    const auto value = [&](const VecX& q, const VecX& v) {
      return VecX::Constant(1, at(q, v).value);
    };
    const auto L_q = [&](const VecX& q, const VecX& v) { return at(q, v).L_q; };
    const auto L_v = [&](const VecX& q, const VecX& v) { return at(q, v).L_v; };
    const double size = std::abs(L.value), most = tolerance(t.tree);
    const double q_size = L.L_q.cwiseAbs().maxCoeff(), v_size = L.L_v.cwiseAbs().maxCoeff();
    EXPECT_LT(relative_error(L.L_q, VecX(by_q(t, value).transpose()), size), most) << k;
    EXPECT_LT(relative_error(L.L_v, VecX(by_v(t, value).transpose()), size), most) << k;
    EXPECT_LT(relative_error(L.L_qq, by_q(t, L_q), q_size), most) << k;
    EXPECT_LT(relative_error(L.L_vq, by_q(t, L_v), v_size), most) << k;
    EXPECT_LT(relative_error(L.L_vq.transpose(), by_v(t, L_q), q_size), most) << k;
    EXPECT_LT(relative_error(L.L_vv, by_v(t, L_v), v_size), most) << k;
  }
}

TEST(BallProducts, AgreeWithDenseOnes) {
  for (int k = 0; k < 80; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    BallArc at(t, TreeSolver::automatic);
    ASSERT_TRUE(at.factorize(t.v, 0));
    multiply_by_rates(at.packed, at.w, at.products);
    VecX product(t.tree.n_v);
    const double size = (L.L_vv.norm() + L.L_qq.norm() + L.L_vq.norm()) * t.v.norm();
    const auto expect = [&](int which, const MatX& matrix) {
      gather(t.tree, at.packed, at.products.by_joint, which, product);
      EXPECT_LT((product - matrix * t.v).norm(), 1e-14 * size) << k << " " << which;
    };
    expect(0, L.L_vq);
    expect(1, L.L_vq.transpose());
    expect(2, L.L_qq);
  }
}

// kappa is -d^2 L / ds^2 along the free motion: q'' = a, v' = a (shadow.hpp), here on geodesics.
TEST(BallShadow, FreeMotionAndKappa) {
  for (int k = 0; k < 80; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
    VecX force = L.L_q - L.L_vq * t.v;
    for (const Ball& ball : t.tree.balls) {
      const Vec3 w = t.v.segment<3>(ball.velocity), L_w = L.L_v.segment<3>(ball.velocity);
      force.segment<3>(ball.velocity) += w.cross(L_w);
    }
    const VecX a = L.L_vv.llt().solve(force);
    BallArc at(t, TreeSolver::automatic);
    FreeMotion free(t.tree, at.packed);
    ASSERT_TRUE(at.factorize(t.v, 0));
    free_motion(t.tree, at.packed, at.w, at.J, free);
    EXPECT_LT((free.a - a).norm(), 1e-10 * a.norm()) << k;  // condition of M: 1e6 at most
    const double kappa = a.dot(force) - t.v.dot(L.L_qq * t.v);
    EXPECT_NEAR(free.kappa, kappa, 1e-10 * (std::abs(a.dot(force)) + std::abs(kappa))) << k;
  }
}

TEST(Balls, MomentaAloneAreLvToTheLastBit) {
  for (int k = 0; k < 100; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const VecX p = momenta(t.tree, pack(t.tree, t.mass), t.q, t.v);
    EXPECT_EQ(p, lagrangian(t.tree, t.mass, t.q, t.v).L_v) << k;
  }
}

}  // namespace
}  // namespace saltus
