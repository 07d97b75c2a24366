// Dampers between points: their pull by closed form, and Newton's matrix against differences. Its
// source is compiled with this program: the library exports nothing of it.
#include "variational/arc/point_dampers.hpp"

#include <gtest/gtest.h>

#include "lagrangian/ball_arc.hpp"
#include "lagrangian/sprung_trees.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

using test::BallArc;
using test::RandomTree;

/// An arc with dampers in its middle.
struct DampedArc : BallArc {
  DampedArc(const RandomTree& tree, TreeSolver solver, int seed) : BallArc(tree, solver) {
    test::Random random(static_cast<std::uint64_t>(seed));
    for (int k = 0; k < 2; ++k) {
      BodyPoint a = test::random_point(random, t.tree), b = test::random_point(random, t.tree);
      if (a.joint == b.joint) a.joint = b.joint < 0 ? t.tree.joints() - 1 : -1;
      PlacedDamper damper;
      damper.a = pack_point(t.tree, packed, a);
      damper.b = pack_point(t.tree, packed, b);
      damper.damping = random.uniform(1, 5);
      dampers.push_back(damper);
    }
    const auto columns = static_cast<Eigen::Index>(3 * dampers.size());
    for (MatX* each : {&w.coupled, &w.coupled_q, &w.coupled_v}) {
      each->setZero(t.tree.n_v, columns);
    }
    for (VecX* each : {&Q, &size}) each->setZero(t.tree.n_v);
  }

  VecX start(const VecX& v, double tau) {
    momenta(v, tau);
    Q.setZero();
    for (PlacedDamper& each : dampers) add_damper(w, each, Q, size);
    for (int c = 0; c < t.tree.n_v; ++c) at(w.first, packed.slot_of_velocity[c])[lanes] += Q[c];
    arc_pass(packed, tau, w);
    add_ball_pull(packed, tau, Q, w);
    VecX L_v(t.tree.n_v), L_q(t.tree.n_v);
    gather(t.tree, packed, w.arc, 0, L_v);
    gather(t.tree, packed, w.arc, 1, L_q);
    return L_v - tau / 2 * L_q;
  }

  bool factorize_with_dampers(const VecX& v, double tau) {
    start(v, tau);
    second_pass(packed, w);
    Eigen::Index column = 0;
    for (const PlacedDamper& each : dampers) {
      add_damper_partials(each, column, w);
      column += 3;
    }
    return saltus::factorize(t.tree, packed, w, tau, J);
  }

  std::vector<PlacedDamper> dampers;
  VecX Q, size;
};

TEST(PointDampers, NewtonsMatrixIsTheSlopeOfAnArcsMomentum) {
  for (const TreeSolver solver : {TreeSolver::automatic, TreeSolver::sweep}) {
    for (int k = 0; k < 30; ++k) {
      const RandomTree t = test::varied_ball_tree(k);
      DampedArc arc(t, solver, 90 + k);
      test::Random random(static_cast<std::uint64_t>(k));
      const VecX x = random.vector(t.tree.n_v);
      for (const double tau : {0.01, 0.1}) {
        const auto start = [&](double h) { return arc.start(t.v + h * x, tau); };
        const VecX dp = test::derivative(start, 1e-3);
        ASSERT_TRUE(arc.factorize_with_dampers(t.v, tau)) << k;
        VecX solved = dp;
        solve(t.tree, arc.packed, arc.J, solved);
        EXPECT_LT((solved - x).norm(), 1e-8 * (1 + dp.norm() / x.norm())) << k << " " << tau;
      }
    }
  }
}

/// What it takes is -c d'^2, with d' by differences of d.
TEST(PointDampers, TakeTheSquareOfTheRateOfTheirLength) {
  for (int k = 0; k < 20; ++k) {
    const RandomTree t = test::varied_ball_tree(k);
    DampedArc arc(t, TreeSolver::automatic, 90 + k);
    arc.start(t.v, 0);
    double power = 0;
    for (std::size_t i = 0; i < arc.dampers.size(); ++i) {
      const auto length = [&](double h) {
        VecX q(t.tree.n_q);
        integrate(t.tree, t.q, h, t.v, q);
        set_coordinates(t.tree, arc.packed, q, arc.w);
        place(arc.packed, arc.w);
        const PlacedDamper& each = arc.dampers[i];
        return (position_from_O(arc.w, each.a) + origin_of(arc.w, each.a) -
                position_from_O(arc.w, each.b) - origin_of(arc.w, each.b))
            .norm();
      };
      const double rate = test::derivative(length, 1e-3);
      power -= arc.dampers[i].damping * rate * rate;
    }
    EXPECT_NEAR(arc.Q.dot(t.v), power, 1e-9 * (1 + std::abs(power))) << k;
  }
}

TEST(PointDampers, AreContinuousWhereTheirEndsMeet) {
  RandomTree t;
  add_joint(t.tree, -1, {Joint::Kind::prismatic, 0}, {}, {0, 1, 0});
  t.mass.body.push_back({1, Vec3::Zero(), Mat3::Zero()});
  t.q = VecX::Zero(1);
  t.v = VecX::Constant(1, 2);
  DampedArc arc(t, TreeSolver::automatic, 1);
  arc.dampers.resize(1);
  arc.dampers[0].a.p_J.setZero();
  arc.dampers[0].a = pack_point(t.tree, arc.packed, {0, Vec3::Zero()});
  arc.dampers[0].b = pack_point(t.tree, arc.packed, {-1, Vec3::Zero()});
  arc.dampers[0].damping = 3;
  arc.start(t.v, 0);
  EXPECT_EQ(arc.Q[0], -6);
  arc.start(VecX::Zero(1), 0);
  EXPECT_EQ(arc.Q[0], 0);
}

}  // namespace
}  // namespace saltus
