// Springs between points, constant forces, curves and functions: in L, in arcs, in torques.
#include <gtest/gtest.h>

#include <cmath>

#include "lagrangian/ball_arc.hpp"
#include "lagrangian/packed_trees.hpp"
#include "lagrangian/sprung_trees.hpp"
#include "numeric.hpp"
#include "saltus/error.hpp"
#include "saltus/lagrangian/newton_euler.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/lagrangian/shadow.hpp"

namespace saltus {
namespace {

using test::ArcMomenta;
using test::BallArc;
using test::moved;
using test::RandomTree;

constexpr TreeSolver solvers[] = {TreeSolver::automatic, TreeSolver::lu, TreeSolver::sweep};

RandomTree sprung(int k) {
  RandomTree t = test::varied_ball_tree(k);
  test::add_potentials(static_cast<std::uint64_t>(40 + k), true, t);
  return t;
}

// Distances, and splines between their knots, are no polynomials: steps of 1e-3 leave 2.1 eps / h
// of rounding, and where a knot is passed f''' jumps, which leaves h^3 of that.
constexpr double step = 1e-3;

TEST(Potentials, PartialsOfTheLagrangianAreNumericOnes) {
  for (int k = 0; k < 40; ++k) {
    const RandomTree t = sprung(k);
    const PackedTree packed = pack(t.tree, t.mass);
    const LagrangianPartials L = lagrangian(t.tree, packed, t.q, t.v);
    const double size = 10 + std::abs(L.value) + L.L_qq.norm();
    for (int j = 0; j < t.tree.n_v; ++j) {
      const auto at = [&](double h) {
        return lagrangian(t.tree, packed, moved(t.tree, t.q, h * VecX::Unit(t.tree.n_v, j)), t.v);
      };
      const double slope = test::derivative([&](double h) { return at(h).value; }, step);
      const VecX column = test::derivative([&](double h) { return at(h).L_q; }, step);
      EXPECT_NEAR(L.L_q[j], slope, 1e-10 * size) << k << " " << j;
      EXPECT_LT((L.L_qq.col(j) - column).norm(), 1e-8 * size) << k << " " << j;
    }
  }
}

/// L_d(q0, q1, tau) = tau L(q0 (+) D/2, D/tau), D = q1 (-) q0.
double discrete_lagrangian(const RandomTree& t, const VecX& q0, const VecX& q1, double tau) {
  VecX D(t.tree.n_v), mid(t.tree.n_q);
  difference(t.tree, q0, q1, D);
  integrate(t.tree, q0, 0.5, D, mid);
  return tau * lagrangian(t.tree, t.mass, mid, D / tau).value;
}

TEST(Potentials, MomentaOfArcsAreSlopesOfTheDiscreteLagrangian) {
  for (int k = 0; k < 20; ++k) {
    const RandomTree t = sprung(k);
    const double tau = 0.2;
    BallArc arc(t, TreeSolver::automatic);
    const ArcMomenta p = arc.momenta(t.v, tau);
    const VecX q1 = moved(t.tree, t.q, tau * t.v);
    for (int j = 0; j < t.tree.n_v; ++j) {
      const VecX e = VecX::Unit(t.tree.n_v, j);
      const double start = test::derivative(
          [&](double h) { return -discrete_lagrangian(t, moved(t.tree, t.q, h * e), q1, tau); },
          step);
      const double end = test::derivative(
          [&](double h) { return discrete_lagrangian(t, t.q, moved(t.tree, q1, h * e), tau); },
          step);
      const double size = 10 + p.start.norm() + p.end.norm();
      EXPECT_NEAR(p.start[j], start, 1e-9 * size) << k << " " << j;
      EXPECT_NEAR(p.end[j], end, 1e-9 * size) << k << " " << j;
    }
  }
}

/// By every solver, and by columns beside the tree as by a dense matrix.
TEST(Potentials, SolveIsTheInverseOfTheSlopeOfAnArcsMomentum) {
  for (const TreeSolver solver : solvers) {
    for (int k = 0; k < 30; ++k) {
      const RandomTree t = sprung(k);
      test::Random random(static_cast<std::uint64_t>(k));
      const VecX x = random.vector(t.tree.n_v);
      for (const bool dense : {true, false}) {
        BallArc arc(t, solver);
        arc.packed.dense_arcs = dense;
        arc.w = Packed(arc.packed);
        arc.J = PackedMatrix(t.tree, arc.packed);
        for (const double tau : {0.01, 0.1}) {
          const auto start = [&](double h) { return arc.momenta(t.v + h * x, tau).start; };
          const VecX dp = test::derivative(start, step);
          ASSERT_TRUE(arc.factorize(t.v, tau)) << k;
          VecX solved = dp;
          solve(t.tree, arc.packed, arc.J, solved);
          const double condition = dp.norm() / x.norm();
          EXPECT_LT((solved - x).norm(), 1e-7 * (1 + condition)) << k << " " << tau << dense;
        }
      }
    }
  }
}

TEST(Potentials, RateOfAnArcsMomentumByItsDuration) {
  for (int k = 0; k < 30; ++k) {
    const RandomTree t = sprung(k);
    BallArc arc(t, TreeSolver::automatic);
    const double tau = 0.05;
    VecX numeric =
        -test::derivative([&](double h) { return arc.momenta(t.v, tau + h).start; }, step);
    ASSERT_TRUE(arc.factorize(t.v, tau));
    VecX rate(t.tree.n_v), scratch(t.tree.n_v);
    set_momentum_rate(t.tree, arc.packed, arc.w, tau, arc.products, scratch, rate);
    const double size = 1 + numeric.norm();
    solve_scaled(t.tree, arc.packed, arc.J, rate);
    solve(t.tree, arc.packed, arc.J, numeric);
    EXPECT_LT((rate - numeric).norm(), 1e-8 * (size + numeric.norm())) << k;
  }
}

/// Inverse dynamics with and without: V_q is what they differ by.
TEST(Potentials, TorquesHoldThem) {
  for (int k = 0; k < 30; ++k) {
    const RandomTree with = sprung(k), without = test::varied_ball_tree(k);
    const VecX a = VecX::Constant(with.tree.n_v, 0.3);
    const auto torques = [&](const RandomTree& t) {
      const PackedTree packed = pack(t.tree, t.mass);
      Packed w(packed);
      PackedForces forces(packed);
      set_coordinates(t.tree, packed, t.q, w);
      set_rates(t.tree, packed, t.v, w);
      place(packed, w);
      move(packed, w);
      set_accelerations(t.tree, packed, a, forces);
      newton_euler(packed, w, forces);
      VecX tau(t.tree.n_v);
      gather(t.tree, packed, forces.tau, 0, tau);
      return tau;
    };
    const VecX V_q = lagrangian(without.tree, without.mass, with.q, with.v).L_q -
                     lagrangian(with.tree, with.mass, with.q, with.v).L_q;
    const VecX more = torques(with) - torques(without);
    EXPECT_LT((more - V_q).norm(), 1e-12 * (10 + torques(with).norm() + V_q.norm())) << k;
  }
}

/// kappa and its gradient, for trees without balls, against numeric derivatives.
TEST(Potentials, ShadowsGradientIsTheNumericOne) {
  for (int k = 0; k < 40; ++k) {
    RandomTree t = test::packed_tree(k);
    test::add_potentials(static_cast<std::uint64_t>(k), false, t);
    const PackedTree packed = pack(t.tree, t.mass);
    Packed w(packed);
    PackedMatrix M(t.tree, packed);
    FreeMotion free(t.tree, packed);
    ShadowTerm term(t.tree, packed);
    const auto kappa = [&](const VecX& q, const VecX& v) {
      set_coordinates(t.tree, packed, q, w);
      set_rates(t.tree, packed, v, w);
      place(packed, w);
      move(packed, w);
      first_pass(packed, w);
      second_pass(packed, w);
      EXPECT_TRUE(factorize(t.tree, packed, w, 0, M));
      free_motion(t.tree, packed, w, M, free);
      return free.kappa;
    };
    const double value = kappa(t.q, t.v);
    shadow_gradient(t.tree, packed, w, free.a, term);
    const double size = std::abs(value) + term.kappa_q.norm() + term.kappa_v.norm();
    EXPECT_NEAR(term.kappa, value, 1e-11 * size) << k;
    for (int j = 0; j < t.tree.n_v; ++j) {
      const VecX e = VecX::Unit(t.tree.n_v, j);
      const double by_q = test::derivative([&](double h) { return kappa(t.q + h * e, t.v); }, step);
      const double by_v = test::derivative([&](double h) { return kappa(t.q, t.v + h * e); }, step);
      EXPECT_NEAR(term.kappa_q[j], by_q, 1e-8 * size) << k << " " << j;
      EXPECT_NEAR(term.kappa_v[j], by_v, 1e-8 * size) << k << " " << j;
    }
  }
}

TEST(Potentials, ASpringOfALengthHasNoDirectionWhereItsEndsMeet) {
  RandomTree t;
  add_joint(t.tree, -1, {Joint::Kind::prismatic, 0}, {}, {0, 1, 0});
  t.mass.body.push_back({1, Vec3::Zero(), Mat3::Zero()});
  t.mass.potentials.springs.push_back({"bungee", {0, {}}, {-1, {}}, 10, 0.5});
  t.mass.potentials.springs.front().a.p_J.setZero();
  t.mass.potentials.springs.front().b.p_J.setZero();
  const VecX zero = VecX::Zero(1);
  try {
    lagrangian(t.tree, t.mass, zero, zero);
    FAIL();
  } catch (const StepError& error) {
    EXPECT_NE(std::string(error.what()).find("\"bungee\""), std::string::npos);
  }
  t.mass.potentials.springs.front().length = 0;
  EXPECT_EQ(lagrangian(t.tree, t.mass, zero, zero).L_q[0], -9.81);
  EXPECT_EQ(lagrangian(t.tree, t.mass, zero, zero).L_qq(0, 0), -10);
}

}  // namespace
}  // namespace saltus
