// Loops and couplings by themselves: values where they are known, gradients against differences.
#include "saltus/constraint/equality.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "kit/random_trees.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

constexpr std::array<LoopType, 5> types = {LoopType::point, LoopType::weld, LoopType::distance,
                                           LoopType::on_plane, LoopType::coupling};

/// A joint that is no ball, or -1.
int one_degree_joint(test::Random& random, const Tree& tree) {
  for (int tries = 0; tries < 50; ++tries) {
    const int joint = random.below(tree.joints());
    if (!tree.joint[static_cast<std::size_t>(joint)].is_ball()) return joint;
  }
  return -1;
}

/// One of each type between random bodies, the world among them.
EqualityModel random_equalities(test::Random& random, const Tree& tree) {
  EqualityModel out;
  for (const LoopType type : types) {
    Equality each{.name = loop_type_name(type), .type = type, .first = out.rows};
    const auto end = [&] { return test::random_parent(random, tree); };
    each.a = {end(), random.pose(0.3)};
    each.b = {random.chance(0.3) ? -1 : end(), random.pose(0.3)};
    if (type == LoopType::distance) each.distance = random.uniform(0.1, 1);
    if (type == LoopType::coupling) {
      each.a.joint = one_degree_joint(random, tree);
      each.b.joint = one_degree_joint(random, tree);
      if (each.a.joint < 0 || each.b.joint < 0) continue;
      each.polynomial = {0.1, -0.7, 0.3, 0.2};
    }
    out.rows += rows_of(type);
    out.all.push_back(each);
  }
  return out;
}

EqualityValues values_at(const Tree& tree, const EqualityModel& model, const VecX& q) {
  Kinematics kin(tree);
  set_configuration(tree, q, kin);
  EqualityValues out(tree.n_v, model.rows);
  set_equalities(tree, model, kin, q, 0, out);
  return out;
}

TEST(Equalities, GradientsAreThoseOfDifferences) {
  for (int k = 0; k < 40; ++k) {
    const test::RandomTree random_tree = test::varied_ball_tree(k);
    const Tree& tree = random_tree.tree;
    test::Random random(static_cast<std::uint64_t>(k));
    const EqualityModel model = random_equalities(random, tree);
    const EqualityValues at = values_at(tree, model, random_tree.q);
    constexpr double step = 1e-6;  // central: 1e-12 of the third derivative, rounding 1e-10
    for (int c = 0; c < tree.n_v; ++c) {
      VecX more(tree.n_q), less(tree.n_q);
      integrate(tree, random_tree.q, step, VecX::Unit(tree.n_v, c), more);
      integrate(tree, random_tree.q, -step, VecX::Unit(tree.n_v, c), less);
      const VecX slope =
          (values_at(tree, model, more).h - values_at(tree, model, less).h) / (2 * step);
      EXPECT_LE((slope.transpose() - at.A.row(c)).norm(), 1e-7 * (1 + at.A.norm()))
          << "tree " << k << ", velocity " << c;
    }
  }
}

TEST(Equalities, NeededAccelerationsAreThoseOfDifferences) {
  for (int k = 0; k < 40; ++k) {
    const test::RandomTree random_tree = test::varied_ball_tree(k);
    const Tree& tree = random_tree.tree;
    test::Random random(static_cast<std::uint64_t>(k));
    const EqualityModel model = random_equalities(random, tree);
    const VecX v = VecX::NullaryExpr(tree.n_v, [&] { return random.uniform(-1, 1); });
    Kinematics kin(tree);
    set_configuration(tree, random_tree.q, kin);
    set_velocity(tree, v, kin);
    // a weld that is open by half a turn has two signs, and no difference across
    const VecX h = values_at(tree, model, random_tree.q).h;
    const bool turned = std::any_of(model.all.begin(), model.all.end(), [&](const Equality& e) {
      return e.type == LoopType::weld && h.segment<3>(e.first + 3).norm() > 1.99;
    });
    if (turned) continue;
    VecX needed(model.rows), q(tree.n_q);
    set_needed_accelerations(tree, model, kin, v, 0, needed);
    // A'^T v, along the motion at constant v
    const VecX bend = test::derivative(
        [&](double s) -> VecX {
          integrate(tree, random_tree.q, s, v, q);
          return values_at(tree, model, q).A.transpose() * v;
        },
        0.01);
    // eighth order: 1e-16 of the ninth derivative, rounding 1e-14
    EXPECT_LE((needed + bend).norm(), 1e-11 * (1 + bend.norm())) << "tree " << k;
  }
}

TEST(Equalities, AToldMotionIsAskedForItsAcceleration) {
  Tree tree;
  add_joint(tree, -1, {Joint::Kind::prismatic}, {}, {0, 1, 0});
  EqualityModel model;
  model.all = {{.name = "told", .type = LoopType::prescribed, .a = {0, {}}}};
  model.all[0].motion = [](double t) { return PrescribedMotion{t * t, 2 * t, 2}; };
  model.rows = 1;
  Kinematics kin(tree);
  VecX needed(1);
  set_needed_accelerations(tree, model, kin, VecX::Zero(1), 3, needed);
  EXPECT_EQ(needed[0], 2);
  model.all[0].motion = [](double t) { return PrescribedMotion{t, 1}; };
  set_needed_accelerations(tree, model, kin, VecX::Zero(1), 3, needed);
  EXPECT_TRUE(std::isnan(needed[0]));
}

TEST(Equalities, JointsThatAreReadAreAllThatMatter) {
  const test::RandomTree random_tree = test::varied_ball_tree(7);
  test::Random random(7);
  const EqualityModel model = random_equalities(random, random_tree.tree);
  Kinematics kin(random_tree.tree), some(random_tree.tree);
  set_configuration(random_tree.tree, random_tree.q, kin);
  for (const int joint : joints_read(random_tree.tree, model)) {
    const auto k = static_cast<std::size_t>(joint);
    some.joint[k] = kin.joint[k];
    const auto root = static_cast<std::size_t>(random_tree.tree.root[k]);
    some.origin[root] = kin.origin[root];
  }
  EqualityValues all(random_tree.tree.n_v, model.rows), few = all;
  set_equalities(random_tree.tree, model, kin, random_tree.q, 0, all);
  set_equalities(random_tree.tree, model, some, random_tree.q, 0, few);
  EXPECT_EQ(all.h, few.h);
  EXPECT_EQ(all.A, few.A);
}

TEST(Equalities, AWeldOfATurnIsTwiceTheSineOfItsHalf) {
  Tree tree;
  add_joint(tree, -1, {Joint::Kind::revolute}, {}, {0, 1, 0});
  EqualityModel model;
  model.all = {{.name = "weld", .type = LoopType::weld, .a = {0, {}}}};
  model.rows = 6;
  for (const double angle : {-3.0, -0.1, 0.0, 1e-9, 2.0}) {
    const EqualityValues at = values_at(tree, model, VecX::Constant(1, angle));
    EXPECT_NEAR(at.h[5], 2 * std::sin(angle / 2), 1e-15);
    EXPECT_EQ(at.h.head(5).norm(), 0);
  }
}

}  // namespace
}  // namespace saltus
