// Balls: partials, arcs and their matrix, each against numeric derivatives along q (+) x.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "ball_trees.hpp"
#include "numeric.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/lagrangian/shadow.hpp"

namespace saltus {
namespace {

using test::moved;
using test::Random;
using test::RandomTree;
using test::relative_error;
using test::varied_ball_tree;

constexpr double times[] = {0, 0.01, 0.3};

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
    EXPECT_NEAR(L, naive_lagrangian(t, t.q, t.v), tolerance(t.tree) * (100 + 50 * std::abs(L))) << k;
  }
}

TEST(BallPartials, AreDerivativesAlongVelocities) {
  for (int k = 0; k < 120; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const auto at = [&](const VecX& q, const VecX& v) { return lagrangian(t.tree, t.mass, q, v); };
    const LagrangianPartials L = at(t.q, t.v);
    const auto value = [&](const VecX& q, const VecX& v) { return VecX::Constant(1, at(q, v).value); };
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

/// p_start, L_v' and L_q' of an arc.
struct ArcMomenta {
  VecX start, end;
};

/// Everything that an arc is made of, in lanes.
struct BallArc {
  BallArc(const RandomTree& tree, TreeSolver solver)
      : t(tree), packed(pack(t.tree, t.mass, solver)), w(packed), J(t.tree, packed), products(packed) {}

  ArcMomenta momenta(const VecX& v, double tau) {
    VecX mid(t.tree.n_q), L_v(t.tree.n_v), L_q(t.tree.n_v);
    integrate(t.tree, t.q, tau / 2, v, mid);
    set_coordinates(t.tree, packed, mid, w);
    set_rates(t.tree, packed, v, w);
    place(packed, w);
    move(packed, w);
    first_pass(packed, w);
    arc_pass(packed, tau, w);
    gather(t.tree, packed, w.arc, 0, L_v);
    gather(t.tree, packed, w.arc, 1, L_q);
    return {L_v - tau / 2 * L_q, L_v + tau / 2 * L_q};
  }
  bool factorize(const VecX& v, double tau) {
    momenta(v, tau);
    second_pass(packed, w);
    return saltus::factorize(t.tree, packed, w, tau, J);
  }

  RandomTree t;
  PackedTree packed;
  Packed w;
  PackedMatrix J;
  PackedProducts products;
};

/// L_d(q0, q1, tau) = tau L(q0 (+) D/2, D/tau), D = q1 (-) q0.
double discrete_lagrangian(const RandomTree& t, const VecX& q0, const VecX& q1, double tau) {
  VecX D(t.tree.n_v), mid(t.tree.n_q);
  difference(t.tree, q0, q1, D);
  integrate(t.tree, q0, 0.5, D, mid);
  return tau * lagrangian(t.tree, t.mass, mid, D / tau).value;
}

// p_start = -D1 L_d and p_end = D2 L_d, which are what makes the steps variational.
TEST(BallArc, MomentaAreSlopesOfTheDiscreteLagrangian) {
  for (int k = 0; k < 60; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const double tau = 0.2;
    BallArc arc(t, TreeSolver::automatic);
    const ArcMomenta p = arc.momenta(t.v, tau);
    VecX q1(t.tree.n_q);
    integrate(t.tree, t.q, tau, t.v, q1);
    const VecX zero = VecX::Zero(t.tree.n_v);
    const VecX start = test::gradient(
        [&](const VecX& x) { return -discrete_lagrangian(t, moved(t.tree, t.q, x), q1, tau); }, zero);
    const VecX end = test::gradient(
        [&](const VecX& x) { return discrete_lagrangian(t, t.q, moved(t.tree, q1, x), tau); }, zero);
    // D/tau: steps of 0.02 in q are 0.1 in v, and the logarithm bends: truncation of 1e-9
    const double size = std::max(1.0, lagrangian(t.tree, t.mass, t.q, t.v).L_v.cwiseAbs().maxCoeff());
    EXPECT_LT((p.start - start).cwiseAbs().maxCoeff(), 1e-8 * size) << k;
    EXPECT_LT((p.end - end).cwiseAbs().maxCoeff(), 1e-8 * size) << k;
  }
}

TEST(BallArc, SolveIsTheInverseOfTheSlopeOfItsMomentum) {
  for (const TreeSolver solver : {TreeSolver::lu, TreeSolver::sweep, TreeSolver::automatic}) {
    for (int k = 0; k < 60; ++k) {
      const RandomTree t = varied_ball_tree(k);
      Random random(static_cast<std::uint64_t>(k));
      const VecX x = random.vector(t.tree.n_v);
      BallArc arc(t, solver);
      for (const double tau : times) {
        const auto start = [&](double h) { return arc.momenta(t.v + h * x, tau).start; };
        VecX solved = test::derivative(start, step);
        const double size = solved.norm();
        ASSERT_TRUE(arc.factorize(t.v, tau)) << k;
        const VecX dp = solved;
        solve(t.tree, arc.packed, arc.J, solved);
        // J of long arcs may be nearly singular: its condition is not known, dp's error is 1e-12
        const double condition = size / x.norm();
        EXPECT_LT((solved - x).norm(), tolerance(t.tree) * 1e3 * (1 + condition)) << k << " " << tau;
      }
    }
  }
}

// Sweep and elimination are exact: they agree to the rounding of either.
TEST(BallArc, SweepAgreesWithElimination) {
  for (int k = 0; k < 100; ++k) {
    const RandomTree t = varied_ball_tree(k);
    if (!t.tree.one_to_one) continue;
    BallArc lu(t, TreeSolver::lu), sweep(t, TreeSolver::sweep);
    Random random(static_cast<std::uint64_t>(k));
    const VecX r = random.vector(t.tree.n_v);
    for (const double tau : times) {
      VecX x = r, y = r;
      ASSERT_TRUE(lu.factorize(t.v, tau) && sweep.factorize(t.v, tau));
      solve(t.tree, lu.packed, lu.J, x);
      solve(t.tree, sweep.packed, sweep.J, y);
      if (x.norm() > 1e3 * r.norm()) continue;  // else the condition of J is 1e5 at most
      EXPECT_LT((x - y).norm(), 1e-11 * x.norm()) << k << " " << tau;
      for (int tree = 0; tree < static_cast<int>(lu.packed.trees.size()); ++tree) {
        const PackedPlace& place = lu.packed.trees[static_cast<std::size_t>(tree)];
        const PackedGroup& g = lu.packed.groups[static_cast<std::size_t>(place.group)];
        VecX one(g.positions);
        for (int i = 0; i < g.positions; ++i) {
          one[i] = r[lu.packed.joint[static_cast<std::size_t>(g.slot(i) + place.lane)]];
        }
        solve_tree(lu.packed, tree, lu.J, one.data());
        for (int i = 0; i < g.positions; ++i) {
          const int joint = lu.packed.joint[static_cast<std::size_t>(g.slot(i) + place.lane)];
          EXPECT_NEAR(one[i], x[joint], 1e-12 * x.norm());
        }
      }
    }
  }
}

TEST(BallArc, RateOfItsMomentumByItsDuration) {
  for (int k = 0; k < 60; ++k) {
    const RandomTree t = varied_ball_tree(k);
    BallArc arc(t, TreeSolver::automatic);
    for (const double tau : {0.05, 0.3}) {
      const auto start = [&](double h) { return arc.momenta(t.v, tau + h).start; };
      VecX numeric = -test::derivative(start, 0.005);
      ASSERT_TRUE(arc.factorize(t.v, tau));
      VecX rate(t.tree.n_v), scratch(t.tree.n_v);
      set_momentum_rate(t.tree, arc.packed, arc.w, tau, arc.products, scratch, rate);
      const double size = std::max(1.0, numeric.norm());
      solve_scaled(t.tree, arc.packed, arc.J, rate);
      solve(t.tree, arc.packed, arc.J, numeric);
      EXPECT_LT((rate - numeric).norm(), 1e-9 * (size + numeric.norm())) << k << " " << tau;
    }
  }
}

// What is pulled back: a function of the arc's end, and of its middle.
TEST(BallArc, PullsDerivativesBackToTheVelocity) {
  for (int k = 0; k < 40; ++k) {
    const RandomTree t = varied_ball_tree(k);
    Random random(static_cast<std::uint64_t>(k));
    const VecX c = random.vector(t.tree.n_q);
    BallArc arc(t, TreeSolver::automatic);
    for (const double tau : {0.05, 0.3}) {
      ASSERT_TRUE(arc.factorize(t.v, tau));
      for (const bool at_end : {true, false}) {
        const double part = at_end ? tau : tau / 2;
        const auto f = [&](const VecX& v) {
          VecX q(t.tree.n_q);
          integrate(t.tree, t.q, part, v, q);
          return c.dot(q);
        };
        VecX end(t.tree.n_q);
        integrate(t.tree, t.q, part, t.v, end);
        VecX row = test::gradient([&](const VecX& x) { return c.dot(moved(t.tree, end, x)); },
                                  VecX::Zero(t.tree.n_v));
        at_end ? pull_back_end(arc.packed, arc.J, row) : pull_back_middle(arc.packed, arc.J, row);
        EXPECT_LT((part * row - test::gradient(f, t.v)).norm(), 1e-11) << k << " " << tau;
      }
    }
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
    EXPECT_LT((free.a - a).norm(), 1e-11 * a.norm()) << k;  // condition of M
    const double kappa = a.dot(force) - t.v.dot(L.L_qq * t.v);
    EXPECT_NEAR(free.kappa, kappa, 1e-11 * (std::abs(a.dot(force)) + std::abs(kappa))) << k;
  }
}

TEST(BallArc, AFreeBodyFeelsNoTorqueToTheLastBit) {
  Random random(9);
  for (int k = 0; k < 50; ++k) {
    RandomTree t;
    int parent = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const Pose X{axis == 0 ? rotation_z_to(Vec3::UnitX())
                             : Mat3(rotation_z_to(Vec3::Unit(axis - 1)).transpose() *
                                    rotation_z_to(Vec3::Unit(axis))),
                   Vec3::Zero()};
      parent = add_joint(t.tree, parent, {Joint::Kind::prismatic, 0}, X, {axis, 1, 0});
    }
    add_ball(t.tree, parent, {});
    t.mass.body.resize(5);
    BodyInertia body = random.body();
    body.c_J.setZero();
    t.mass.body.push_back(body);
    t.q = test::random_coordinates(random, t.tree);
    t.v = random.vector(6, 10);
    BallArc arc(t, TreeSolver::automatic);
    arc.momenta(t.v, 0.1);
    VecX L_q(6);
    gather(t.tree, arc.packed, arc.w.arc, 1, L_q);
    EXPECT_EQ(Vec3(L_q.tail<3>()), Vec3(Vec3::Zero())) << L_q.transpose();
  }
}

}  // namespace
}  // namespace saltus
