// The kernels against the plain loops of tests/cpp/plain, on trees that fill the lanes in every
// way.
//
// Tolerances are of rounding: sums of at most 60 terms, a few operations each, in another order.
#include <gtest/gtest.h>

#include <limits>

#include "lagrangian/packed_trees.hpp"
#include "plain/energy.hpp"

namespace saltus {
namespace {

using test::PackedEvaluation;

constexpr double rounding = 1e-13;
constexpr int trees = 60;

template <class A, class B>
void expect_near(const A& a, const B& b, double scale, const std::string& what) {
  EXPECT_LE((a - b).norm(), rounding * scale) << what;
}

TEST(Packed, PosesAndMotionAreThoseOfThePlainLoops) {
  for (int k = 0; k < trees; ++k) {
    const PackedEvaluation e(test::packed_tree(k));
    Kinematics copy(e.t.tree);
    copy_poses(e.t.tree, e.packed, e.w, copy);
    for (int i = 0; i < e.t.tree.joints(); ++i) {
      const JointMotion& m = e.plain.kin.joint[i];
      const std::string what = "tree " + std::to_string(k) + " joint " + std::to_string(i);
      expect_near(copy.joint[i].R, m.R, 10, what);
      expect_near(copy.joint[i].p, m.p, 10, what);
      expect_near(copy.joint[i].S, m.S, 10, what);
      expect_near(e.of<6>(e.w.V, i), m.V, 10 + m.V.norm(), what);
      expect_near(e.of<6>(e.w.S_W, i, 6), m.W, 10 + m.V.norm() * m.S.norm(), what);
      const int root = e.t.tree.root[i];
      expect_near(copy.origin[root], e.plain.kin.origin[root], 10, what);
    }
  }
}

TEST(Packed, FirstPartialsAndGeneratorsAreThoseOfThePlainLoops) {
  for (int k = 0; k < trees; ++k) {
    const PackedEvaluation e(test::packed_tree(k));
    const double L_q = e.plain.comp.L_q.norm(), L_v = e.plain.comp.L_v.norm();
    double U = 0, F = 0, G = 0;  // of the whole tree: a joint's own may cancel
    for (const plain::JointComposite& c : e.plain.comp.joint) {
      U += c.U.norm();
      F += c.F.norm();
      G += c.G.norm();
    }
    for (int i = 0; i < e.t.tree.joints(); ++i) {
      const plain::JointComposite& c = e.plain.comp.joint[i];
      const std::string what = "tree " + std::to_string(k) + " joint " + std::to_string(i);
      EXPECT_NEAR(at(e.w.first, e.packed.slot[i])[0], e.plain.comp.L_v[i], rounding * L_v) << what;
      EXPECT_NEAR(at(e.w.first, e.packed.slot[i])[lanes], e.plain.comp.L_q[i],
                  rounding * (L_q + L_v))
          << what;
      expect_near(e.of<6>(e.w.U_F_G, i), c.U, U, what);
      expect_near(e.of<6>(e.w.U_F_G, i, 6), c.F, F + U, what);
      expect_near(e.of<3>(e.w.U_F_G, i, 12), c.G, G, what);
    }
    const double V = plain::potential_energy(e.t.tree, e.t.mass, e.plain.kin);
    EXPECT_NEAR(potential_energy(e.packed, e.w), V, rounding * (std::abs(V) + G));
  }
}

TEST(Packed, ProductsWithTheVelocityAreThoseOfThePlainLoops) {
  for (int k = 0; k < trees; ++k) {
    const PackedEvaluation e(test::packed_tree(k));
    VecX v_joint(e.t.tree.joints());
    to_joints(e.t.tree, e.t.v, v_joint);
    plain::SecondPartialsTimes plain;
    multiply_second_partials(e.t.tree, e.plain.kin, e.plain.comp, v_joint, plain);
    PackedProducts products(e.packed);
    multiply_by_rates(e.packed, e.w, products);
    const double scale =
        plain.L_vq_x.norm() + plain.L_qv_x.norm() + plain.L_qq_x.norm() + plain.L_vv_x.norm();
    for (int i = 0; i < e.t.tree.joints(); ++i) {
      const Vec3 each = e.of<3>(products.by_joint, i);
      EXPECT_NEAR(each[0], plain.L_vq_x[i], rounding * scale) << k;
      EXPECT_NEAR(each[1], plain.L_qv_x[i], rounding * scale) << k;
      EXPECT_NEAR(each[2], plain.L_qq_x[i], rounding * scale) << k;
    }
  }
}

TEST(Packed, ScaleBoundsWhatTheResidualIsMadeOf) {
  constexpr double tau = 0.1;
  for (int k = 0; k < trees; ++k) {
    PackedEvaluation e(test::packed_tree(k));
    scale_pass(e.packed, tau, e.w);
    for (int i = 0; i < e.t.tree.joints(); ++i) {
      const double terms = std::abs(e.plain.comp.L_v[i]) + tau / 2 * std::abs(e.plain.comp.L_q[i]);
      EXPECT_LE(terms, *at(e.w.scale, e.packed.slot[i]) * (1 + rounding)) << k;
    }
  }
}

TEST(Packed, EqualTreesShareLanesAndOthersDoNot) {
  test::Random random(3);
  const test::RandomTree one = random_tree(random, {.joints = 5, .branch = 0.4});
  const test::RandomTree nine = test::copies_of(one, 9, random);
  const PackedTree packed = pack(nine.tree, nine.mass);
  ASSERT_EQ(packed.groups.size(), 1u);
  EXPECT_EQ(packed.groups[0].width, 16);
  EXPECT_EQ(packed.groups[0].trees, 9);
  EXPECT_EQ(packed.slots, 5 * 16);
  const PackedTree alone = pack(nine.tree, nine.mass, TreeSolver::sweep);
  EXPECT_EQ(alone.groups.size(), 9u);
  for (const PackedGroup& g : alone.groups) EXPECT_TRUE(g.sweep);
}

TEST(Packed, SolverGoesByDepth) {
  test::Random random(4);
  const auto groups = [&](int joints) {
    const test::RandomTree t = random_tree(random, {.joints = joints, .branch = 0});
    return pack(t.tree, t.mass).groups;
  };
  EXPECT_FALSE(groups(8)[0].sweep);
  EXPECT_TRUE(groups(40)[0].sweep);
  const test::RandomTree none;
  EXPECT_TRUE(pack(none.tree, none.mass).groups.empty());
}

/// cos and sin of x by the kernel.
Eigen::Vector2d turn_of(double x) {
  Tree tree;
  add_joint(tree, -1, {}, {}, {0, 1, 0});
  MassModel mass;
  mass.body.push_back({1, Vec3::UnitX(), Mat3::Identity()});
  const PackedTree packed = pack(tree, mass);
  Packed w(packed);
  set_coordinates(tree, packed, VecX::Constant(1, x), w);
  place(packed, w);
  return {w.turn[0].x[0][0], w.turn[0].x[1][0]};
}

TEST(Packed, SinesAndCosinesToAnUlpAndAHalf) {
  constexpr double ulp = std::numeric_limits<double>::epsilon();  // of numbers in [1, 2)
  test::Random random(5);
  for (int k = 0; k < 20000; ++k) {
    const double size = std::pow(10, random.uniform(-8, 7));
    double x = random.uniform(-size, size);
    if (k % 4 == 0) x = std::round(x) * (M_PI / 4);  // where sine and cosine change places
    const Eigen::Vector2d turn = turn_of(x);
    // relative: ulp / 2 to ulp of a number, by where it lies in its binade
    EXPECT_NEAR(turn[0], std::cos(x), 1.5 * ulp * std::abs(std::cos(x))) << x;
    EXPECT_NEAR(turn[1], std::sin(x), 1.5 * ulp * std::abs(std::sin(x))) << x;
    EXPECT_EQ(turn_of(-x)[0], turn[0]);
    EXPECT_EQ(turn_of(-x)[1], -turn[1]);
  }
  EXPECT_EQ(turn_of(0)[0], 1);
  EXPECT_EQ(turn_of(0)[1], 0);
  EXPECT_TRUE(std::isnan(turn_of(std::numeric_limits<double>::infinity())[0]));
  EXPECT_TRUE(std::isnan(turn_of(std::numeric_limits<double>::quiet_NaN())[1]));
}

}  // namespace
}  // namespace saltus
