// Tangents, and the rows of the relative velocity against central differences.
#include "saltus/collision/slip.hpp"

#include <gtest/gtest.h>

#include "collision/random_scene.hpp"

namespace saltus {
namespace {

using testing_scene::Random;
using testing_scene::random_scene;
using testing_scene::Scene;

TEST(Slip, TangentsAreRightHandedAndOrthonormal) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec3 n = random.direction();
    const Tangents t = tangents(n, tangent_axis(n));
    Mat3 R;
    R << t.t0, t.t1, n;
    EXPECT_LE((R.transpose() * R - Mat3::Identity()).norm(), 1e-15);
    EXPECT_GT(R.determinant(), 0);
  }
}

TEST(Slip, OneTangentOfAPlanarSceneLiesInItsPlaneExactly) {
  for (const double angle : {0.0, 0.3, 1.0, 2.0, 4.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    EXPECT_EQ(tangents({c, 0, s}, tangent_axis({c, 0, s})).t1, Vec3::UnitY());
    const Tangents t = tangents({c, s, 0}, tangent_axis({c, s, 0}));
    EXPECT_TRUE(t.t0.z() == 0 || t.t1.z() == 0);
    EXPECT_TRUE(std::abs(t.t0.z()) == 1 || std::abs(t.t1.z()) == 1);
  }
}

TEST(Slip, RoundingOfANormalAlongAnAxisDoesNotTurnItsTangents) {
  const Tangents exact = tangents(Vec3::UnitZ(), tangent_axis(Vec3::UnitZ()));
  for (const double x : {-1e-16, 0.0, 1e-12}) {
    for (const double y : {-1e-12, 0.0, 1e-16}) {
      const Vec3 n = Vec3(x, y, 1).normalized();
      const Tangents t = tangents(n, tangent_axis(n));
      EXPECT_LE((t.t0 - exact.t0).norm(), 1e-11);
      EXPECT_LE((t.t1 - exact.t1).norm(), 1e-11);
    }
  }
}

/// d.(v_a - v_b) of the material points that are at P at q: where they are at q + dq.
double moved(const Scene& scene, const Kinematics& at_q, const Vec3& P, const Vec3& d,
             const VecX& q) {
  Kinematics kin(scene.tree);
  set_configuration(scene.tree, q, kin);
  const auto where = [&](int joint) -> Vec3 {
    if (joint < 0) return P;
    return kin.X_WJ(scene.tree, joint) * at_q.X_WJ(scene.tree, joint).inverse() * P;
  };
  return d.dot(where(scene.pair.on_a.joint) - where(scene.pair.on_b.joint));
}

TEST(Slip, RowsAreTheVelocityOfMaterialPoints) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Scene scene = random_scene(k % 2 ? "box" : "sphere", {}, random);
    Kinematics kin(scene.tree);
    set_configuration(scene.tree, scene.q, kin);
    const Gap g = pair_gap(scene.tree, kin, scene.pair);
    const Vec3 P = contact_point(g), d = tangents(g.n_W, tangent_axis(g.n_W)).t0;
    VecX row = VecX::Zero(scene.q.size());
    add_motion_gradient(scene.tree, kin, scene.pair, P, d, row);
    constexpr double step = 1e-5;
    for (Eigen::Index c = 0; c < row.size(); ++c) {
      VecX ahead = scene.q, behind = scene.q;
      ahead[c] += step;
      behind[c] -= step;
      const double twin = (moved(scene, kin, P, d, ahead) - moved(scene, kin, P, d, behind));
      EXPECT_NEAR(row[c], twin / (2 * step), 1e-8) << k << " " << c;
    }
  }
}

TEST(Slip, AlongTheNormalTheRowIsTheGradientOfTheGap) {
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const Scene scene = random_scene("capsule", {}, random);
    Kinematics kin(scene.tree);
    set_configuration(scene.tree, scene.q, kin);
    const Gap g = pair_gap(scene.tree, kin, scene.pair);
    VecX phi_q = VecX::Zero(scene.q.size()), row = phi_q;
    add_gap_gradient(scene.tree, kin, scene.pair, g, phi_q);
    add_motion_gradient(scene.tree, kin, scene.pair, contact_point(g), g.n_W, row);
    EXPECT_LE((phi_q - row).cwiseAbs().maxCoeff(), 1e-13);
  }
}

/// T v where q is moved by dq and v stays: T of the gap there.
Eigen::Vector2d slip(const Tree& tree, const Pair& pair, int axis, const VecX& q, const VecX& dq,
                     const VecX& v) {
  Kinematics kin(tree);
  set_configuration(tree, testing_scene::moved(tree, q, 1, dq), kin);
  const Gap g = pair_gap(tree, kin, pair);
  const Tangents t = tangents(g.n_W, axis);
  Eigen::Vector2d out;
  for (int k = 0; k < 2; ++k) {
    VecX row = VecX::Zero(tree.n_v);
    add_motion_gradient(tree, kin, pair, contact_point(g), k == 0 ? t.t0 : t.t1, row);
    out[k] = row.dot(v);
  }
  return out;
}

/// Of round shapes and planes on branching trees with balls.
TEST(Slip, ItsChangeHasItsNumericTwin) {
  Random random(4);
  const std::vector<std::string> kinds = {"sphere", "capsule", "ellipsoid", "half_space"};
  int tried = 0;
  for (int k = 0; k < 200; ++k) {
    const Tree tree =
        testing_scene::random_tree({.joints = 5, .mimic = 0, .ball = k % 2 ? 0.4 : 0}, random);
    const Shape a = testing_scene::random_shape(kinds[random.index(3)], random);
    const Shape b = testing_scene::random_shape(kinds[random.index(4)], random);
    if (!has_gap(a, b)) continue;
    const int on_a = testing_scene::carrier(tree, 4), on_b = k % 3 ? k % 2 - 1 : 2;
    const std::vector<PlacedShape> shapes = {
        testing_scene::place(a, on_a, random.pose(0.5)),
        testing_scene::place(b, testing_scene::carrier(tree, on_b), random.pose(2))};
    const Pair pair = testing_scene::make_pair_of(tree, shapes, 0, 1);
    const VecX q = testing_scene::random_coordinates(tree, 1, random);
    const VecX v = random.numbers(tree.n_v, 1);
    Kinematics kin(tree);
    set_configuration(tree, q, kin);
    const Gap g = pair_gap(tree, kin, pair);
    if (g.phi < 0.05 || pair.chain.empty()) continue;  // where shapes overlap normals may leap
    ++tried;
    const int axis = tangent_axis(g.n_W);
    VecX c0 = VecX::Zero(tree.n_v), c1 = c0;
    add_slip_change(tree, kin, pair, g, axis, v, 1, c0, c1);
    constexpr double step = 1e-5;
    std::vector<int> velocities;
    list_velocities(tree, pair, velocities);
    for (const int c : velocities) {
      const VecX dq = step * VecX::Unit(tree.n_v, c);
      const Eigen::Vector2d twin =
          (slip(tree, pair, axis, q, dq, v) - slip(tree, pair, axis, q, -dq, v)) / (2 * step);
      // 1e-7: the differences' own error, with curvatures of 10 / m
      EXPECT_NEAR(c0[c], twin[0], 1e-7 * (1 + std::abs(twin[0]))) << k << " " << c;
      EXPECT_NEAR(c1[c], twin[1], 1e-7 * (1 + std::abs(twin[1]))) << k << " " << c;
    }
  }
  EXPECT_GT(tried, 50);
}

}  // namespace
}  // namespace saltus
