// Newton and Euler's recursion against the partials of L, which know no accelerations of frames.
#include "saltus/lagrangian/newton_euler.hpp"

#include <gtest/gtest.h>

#include "kit/random_trees.hpp"
#include "lagrangian/packed_trees.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using test::RandomTree;
using test::varied_ball_tree;

/// M a + L_vq v - L_q - w x L_v: the rate of the momenta less what L gives of itself.
VecX force_of_partials(const RandomTree& t, const VecX& a, VecX& bound) {
  const LagrangianPartials L = lagrangian(t.tree, t.mass, t.q, t.v);
  VecX force = L.L_vv * a + L.L_vq * t.v - L.L_q;
  bound = L.L_vv.cwiseAbs() * a.cwiseAbs() + L.L_vq.cwiseAbs() * t.v.cwiseAbs() + L.L_q.cwiseAbs();
  for (const Ball& ball : t.tree.balls) {
    const Vec3 w = t.v.segment<3>(ball.velocity), L_w = L.L_v.segment<3>(ball.velocity);
    force.segment<3>(ball.velocity) -= w.cross(L_w);
    bound.segment<3>(ball.velocity).array() += w.norm() * L_w.norm();
  }
  return force;
}

/// Armature and springs, of all coordinates but balls'.
void add_own_terms(test::Random& random, RandomTree& t) {
  t.mass.armature = random.vector(t.tree.n_v).cwiseAbs();
  t.mass.stiffness = 10 * random.vector(t.tree.n_v).cwiseAbs();
  t.mass.rest = random.vector(t.tree.n_v);
  for (const Ball& ball : t.tree.balls) {
    for (VecX* x : {&t.mass.armature, &t.mass.stiffness, &t.mass.rest}) {
      x->segment<3>(ball.velocity).setZero();
    }
  }
}

TEST(NewtonEuler, IsTheRateOfTheMomenta) {
  test::Random random(7);
  for (int k = 0; k < 200; ++k) {
    RandomTree t = varied_ball_tree(k);
    if (k % 2 == 1) add_own_terms(random, t);
    const VecX a = random.vector(t.tree.n_v, 5);
    const PackedTree packed = pack(t.tree, t.mass);
    Packed w(packed);
    PackedForces forces(packed);
    set_coordinates(t.tree, packed, t.q, w);
    set_rates(t.tree, packed, t.v, w);
    place(packed, w);
    move(packed, w);
    set_accelerations(t.tree, packed, a, forces);
    newton_euler(packed, w, forces);
    VecX tau(t.tree.n_v), bound;
    gather(t.tree, packed, forces.tau, 0, tau);
    const VecX expected = force_of_partials(t, a, bound);
    // what cancels inside of an entry is bounded by the largest of them
    EXPECT_LT((tau - expected).cwiseAbs().maxCoeff(), 1e-13 * bound.maxCoeff()) << k;
  }
}

TEST(NewtonEuler, GravityAloneIsLqAtRest) {
  for (int k = 0; k < 100; ++k) {
    RandomTree t = varied_ball_tree(k);
    t.v.setZero();
    const PackedTree packed = pack(t.tree, t.mass);
    Packed w(packed);
    PackedForces forces(packed);
    set_coordinates(t.tree, packed, t.q, w);
    place(packed, w);
    mass_pass(packed, w);
    gravity_pass(packed, w, forces);
    VecX tau(t.tree.n_v);
    gather(t.tree, packed, forces.tau, 0, tau);
    const VecX L_q = lagrangian(t.tree, t.mass, t.q, t.v).L_q;
    EXPECT_LT((tau - L_q).cwiseAbs().maxCoeff(), 1e-14 * L_q.cwiseAbs().maxCoeff() + 1e-300) << k;
  }
}

}  // namespace
}  // namespace saltus
