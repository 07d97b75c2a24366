// Arcs of balls: momenta, matrix and rates, each against numeric derivatives.
#include <gtest/gtest.h>

#include <cmath>

#include "lagrangian/ball_arc.hpp"
#include "numeric.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using test::ArcMomenta;
using test::BallArc;
using test::moved;
using test::Random;
using test::RandomTree;
using test::varied_ball_tree;

constexpr double times[] = {0, 0.01, 0.3};

// As in test_partials.cpp: rounding over the step, and mimic multipliers' truncation.
constexpr double step = 0.01;
double tolerance(const Tree& tree) { return tree.one_to_one ? 2e-12 : 1e-9; }

/// L_d(q0, q1, tau) = tau L(q0 (+) D/2, D/tau), D = q1 (-) q0.
double discrete_lagrangian(const RandomTree& t, const VecX& q0, const VecX& q1, double tau) {
  VecX D(t.tree.n_v), mid(t.tree.n_q);
  difference(t.tree, q0, q1, D);
  integrate(t.tree, q0, 0.5, D, mid);
  return tau * lagrangian(t.tree, t.mass, mid, D / tau).value;
}

// p_start = -D1 L_d and p_end = D2 L_d, which are what makes the steps variational.
TEST(BallArcs, MomentaAreSlopesOfTheDiscreteLagrangian) {
  for (int k = 0; k < 60; ++k) {
    const RandomTree t = varied_ball_tree(k);
    const double tau = 0.2;
    BallArc arc(t, TreeSolver::automatic);
    const ArcMomenta p = arc.momenta(t.v, tau);
    VecX q1(t.tree.n_q);
    integrate(t.tree, t.q, tau, t.v, q1);
    const VecX zero = VecX::Zero(t.tree.n_v);
    const VecX start = test::gradient(
        [&](const VecX& x) { return -discrete_lagrangian(t, moved(t.tree, t.q, x), q1, tau); },
        zero);
    const VecX end = test::gradient(
        [&](const VecX& x) { return discrete_lagrangian(t, t.q, moved(t.tree, q1, x), tau); },
        zero);
    // D/tau: steps of 0.02 in q are 0.1 in v, and the logarithm bends: truncation of 1e-9
    const double size =
        std::max(1.0, lagrangian(t.tree, t.mass, t.q, t.v).L_v.cwiseAbs().maxCoeff());
    EXPECT_LT((p.start - start).cwiseAbs().maxCoeff(), 1e-8 * size) << k;
    EXPECT_LT((p.end - end).cwiseAbs().maxCoeff(), 1e-8 * size) << k;
  }
}

TEST(BallArcs, SolveIsTheInverseOfTheSlopeOfItsMomentum) {
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
        EXPECT_LT((solved - x).norm(), tolerance(t.tree) * 1e3 * (1 + condition))
            << k << " " << tau;
      }
    }
  }
}

// Sweep and elimination are exact: they agree to the rounding of either.
TEST(BallArcs, SweepAgreesWithElimination) {
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
      if (x.norm() > 1e3 * r.norm()) continue;  // else the condition of J is 1e6 at most
      EXPECT_LT((x - y).norm(), 1e-10 * x.norm()) << k << " " << tau;
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

TEST(BallArcs, RateOfItsMomentumByItsDuration) {
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
TEST(BallArcs, PullsDerivativesBackToTheVelocity) {
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

TEST(BallArcs, AFreeBodyFeelsNoTorqueToTheLastBit) {
  Random random(9);
  for (int k = 0; k < 50; ++k) {
    RandomTree t;
    int parent = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const Pose X{axis == 0 ? Mat3(random.rotation() * rotation_z_to(Vec3::UnitX()))
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
