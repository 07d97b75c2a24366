// Chains, and phi_q, phi_qq against central differences.
#include "saltus/collision/contact.hpp"

#include <gtest/gtest.h>

#include "collision/random_scene.hpp"

namespace saltus {
namespace {

using testing_scene::make_pair_of;
using testing_scene::moved;
using testing_scene::place;
using testing_scene::Random;
using testing_scene::random_scene;
using testing_scene::Scene;
using testing_scene::TreeOptions;

struct Derivatives {
  Gap gap;
  VecX phi_q;
  MatX phi_qq;
};

Derivatives derivatives(const Scene& scene, const VecX& q) {
  Kinematics kin(scene.tree);
  set_configuration(scene.tree, q, kin);
  const int n_v = scene.tree.n_v;
  Derivatives d{pair_gap(scene.tree, kin, scene.pair), VecX::Zero(n_v), MatX::Zero(n_v, n_v)};
  add_gap_gradient(scene.tree, kin, scene.pair, d.gap, d.phi_q);
  add_gap_hessian(scene.tree, kin, scene.pair, d.gap, d.phi_qq);
  return d;
}

std::vector<std::pair<int, int>> as_numbers(const std::vector<ChainJoint>& chain) {
  std::vector<std::pair<int, int>> out;
  for (const ChainJoint& k : chain) out.emplace_back(k.joint, k.sign > 0 ? 1 : -1);
  return out;
}

//        world
//       0     5
//       1     6
//      2 3
//        4
TEST(Chain, RunsFromBToAWithoutCommonAncestors) {
  Tree tree;
  for (const int parent : {-1, 0, 1, 1, 3, -1, 5}) {
    add_joint(tree, parent, {}, {}, {tree.joints(), 1, 0});
  }
  using Numbers = std::vector<std::pair<int, int>>;
  EXPECT_EQ(as_numbers(chain_between(tree, 2, 4)), (Numbers{{2, -1}, {3, 1}, {4, 1}}));
  EXPECT_EQ(as_numbers(chain_between(tree, 4, 2)), (Numbers{{4, -1}, {3, -1}, {2, 1}}));
  EXPECT_EQ(as_numbers(chain_between(tree, 1, 4)), (Numbers{{3, 1}, {4, 1}}));
  EXPECT_EQ(as_numbers(chain_between(tree, 6, 2)),
            (Numbers{{6, -1}, {5, -1}, {0, 1}, {1, 1}, {2, 1}}));
  EXPECT_EQ(as_numbers(chain_between(tree, -1, 1)), (Numbers{{0, 1}, {1, 1}}));
  EXPECT_EQ(as_numbers(chain_between(tree, 5, -1)), (Numbers{{5, -1}}));
  EXPECT_TRUE(chain_between(tree, 3, 3).empty());
  EXPECT_TRUE(chain_between(tree, -1, -1).empty());
}

TEST(PairGap, IsTheGapOfThePosesInTheWorld) {
  Random random(11);
  for (int k = 0; k < 200; ++k) {
    const Scene scene = random_scene(k % 2 ? "box" : "sphere", {}, random);
    Kinematics kin(scene.tree);
    set_configuration(scene.tree, scene.q, kin);
    const PlacedShape &a = scene.shapes[0], &b = scene.shapes[1];
    const Gap expected = gap(a.shape, kin.X_WJ(scene.tree, a.joint) * a.X_JG, b.shape,
                             kin.X_WJ(scene.tree, b.joint) * b.X_JG);
    const Gap g = scene.gap_at(scene.q);
    EXPECT_NEAR(g.phi, expected.phi, 1e-14);  // rounding of positions of some metres
    EXPECT_LE((g.p_WA - expected.p_WA).norm(), 1e-13);
    EXPECT_LE((g.center_W - expected.center_W).norm(), 1e-14);
  }
}

TEST(PairGap, KeepsItsDigitsFarFromTheOrigin) {
  Random random(12);
  for (int k = 0; k < 50; ++k) {
    Scene scene = random_scene("capsule", {.branching = 0, .mimic = 0}, random);
    if (scene.shapes[1].joint < 0) continue;
    const double near = scene.gap_at(scene.q).phi;
    scene.tree.X_PJ[0].p += Vec3(3000, 1000, 2000);
    EXPECT_NEAR(scene.gap_at(scene.q).phi, near, 1e-14);  // would be 1e-12 from world positions
  }
}

class ContactPartials : public ::testing::TestWithParam<std::string> {};

TEST_P(ContactPartials, AgreeWithCentralDifferences) {
  Random random(13);
  const double h = 1e-5;
  int used = 0;
  for (int k = 0; k < 300; ++k) {
    const TreeOptions options{
        .joints = 1 + random.index(7), .branching = k % 3 ? 0.3 : 1, .ball = k % 2 ? 0.4 : 0};
    const Scene scene = random_scene(GetParam(), options, random);
    const Derivatives d = derivatives(scene, scene.q);
    const int n_v = scene.tree.n_v;
    VecX phi_q(n_v);
    MatX phi_qq(n_v, n_v);
    double change = 0;  // of F over the stencil: large where it straddles two features
    for (int i = 0; i < n_v; ++i) {
      const VecX e = VecX::Unit(n_v, i);
      const Derivatives up = derivatives(scene, moved(scene.tree, scene.q, h, e));
      const Derivatives down = derivatives(scene, moved(scene.tree, scene.q, -h, e));
      phi_q[i] = (up.gap.phi - down.gap.phi) / (2 * h);
      phi_qq.col(i) = (up.phi_q - down.phi_q) / (2 * h);
      change = std::max(change, (F_W(up.gap) - F_W(down.gap)).norm());
    }
    // the slope of the gradient along a ball's axis turns the gradient too: the mean of both orders
    // is the Hessian along turns at constant rates
    for (const Ball& ball : scene.tree.balls) {
      auto block = phi_qq.block<3, 3>(ball.velocity, ball.velocity);
      block = (0.5 * (block + block.transpose())).eval();
    }
    const double curvature = F_W(d.gap).norm();
    if (curvature > 20 || change > 0.01) continue;
    ++used;
    // truncation h^2 of third derivatives, up to (joints x speed x curvature)^2; rounding 1e-15/h
    const double scale = (1 + curvature) * (1 + d.phi_qq.norm());
    EXPECT_LE((phi_q - d.phi_q).norm(), 1e-8 * scale);
    EXPECT_LE((phi_qq - d.phi_qq).norm(), 1e-7 * scale * (1 + curvature));
    EXPECT_EQ(d.phi_qq, d.phi_qq.transpose());
  }
  EXPECT_GT(used, 200);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ContactPartials,
                         ::testing::Values("sphere", "capsule", "box", "cylinder", "half_space"),
                         [](const auto& kind) { return kind.param; });

TEST(ContactPartials, AddToWhatIsThere) {
  Random random(14);
  const Scene scene = random_scene("sphere", {}, random);
  const Derivatives d = derivatives(scene, scene.q);
  Kinematics kin(scene.tree);
  set_configuration(scene.tree, scene.q, kin);
  VecX phi_q = VecX::Ones(scene.q.size());
  MatX phi_qq = MatX::Ones(scene.q.size(), scene.q.size());
  add_gap_gradient(scene.tree, kin, scene.pair, d.gap, phi_q);
  add_gap_hessian(scene.tree, kin, scene.pair, d.gap, phi_qq);
  EXPECT_LE((phi_q - d.phi_q - VecX::Ones(scene.q.size())).norm(), 1e-14);
  EXPECT_LE((phi_qq - d.phi_qq - MatX::Ones(scene.q.size(), scene.q.size())).norm(), 1e-14);
}

// Exchanging two spheres reverses the chain and changes nothing.
TEST(ContactPartials, OfTwoSpheresAreTheSameInBothOrders) {
  Random random(15);
  for (int k = 0; k < 100; ++k) {
    Scene scene = random_scene("sphere", {.joints = 6}, random);
    const Derivatives d = derivatives(scene, scene.q);
    scene.pair = make_pair_of(scene.tree, scene.shapes, 1, 0);
    const Derivatives e = derivatives(scene, scene.q);
    const double scale = 1 + F_W(d.gap).norm() + d.phi_qq.norm();
    EXPECT_LE((d.phi_q - e.phi_q).norm(), 1e-13 * scale);
    EXPECT_LE((d.phi_qq - e.phi_qq).norm(), 1e-13 * scale * scale);
  }
}

// Two pendulums of length 1 whose pivots are 1 apart: at the angles t0, t1 the centres are
// D = (1 + sin t1 - sin t0, cos t0 - cos t1) apart.
TEST(ContactPartials, OfTwoPendulumsByHand) {
  Tree tree;
  const Mat3 y_axis = rotation_z_to(-Vec3::UnitY());
  for (int i = 0; i < 2; ++i) add_joint(tree, -1, {}, {y_axis, Vec3(i, 0, 0)}, {i, 1, 0});
  const Pose bob{Mat3::Identity(), y_axis.transpose() * Vec3(0, 0, -1)};
  const std::vector<PlacedShape> shapes = {place(Sphere{0.5}, 1, bob), place(Sphere{0.5}, 0, bob)};
  const Scene scene{tree, shapes, make_pair_of(tree, shapes, 0, 1), VecX::Zero(2)};
  const Derivatives d = derivatives(scene, scene.q);
  EXPECT_NEAR(d.gap.phi, 0, 1e-16);
  EXPECT_LE((d.phi_q - Eigen::Vector2d(-1, 1)).norm(), 1e-15);
  // phi = |D| - 1: at 0, D_x has no second derivative and D_z'' = (-1, 1) is across n
  EXPECT_LE(d.phi_qq.norm(), 1e-15);
}

}  // namespace
}  // namespace saltus
