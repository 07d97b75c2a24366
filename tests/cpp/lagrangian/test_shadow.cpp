// The shadow term against dense matrices, its gradient against numeric derivatives of those.
#include "saltus/lagrangian/shadow.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "lagrangian/packed_trees.hpp"
#include "numeric.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using std::cos, std::sin;
using test::packed_tree;
using test::RandomTree;
using test::relative_error;

constexpr int trees = 120;

/// Everything at one state.
struct Shadow {
  explicit Shadow(const RandomTree& t)
      : packed(pack(t.tree, t.mass)),
        w(packed),
        M(t.tree, packed),
        free(t.tree, packed),
        term(t.tree, packed) {
    evaluate(t, t.q, t.v);
    EXPECT_TRUE(factorize(t.tree, packed, w, 0, M));
    free_motion(t.tree, packed, w, M, free);
    shadow_gradient(t.tree, packed, w, free.a, term);
  }

  void evaluate(const RandomTree& t, const VecX& q, const VecX& v) {
    set_coordinates(t.tree, packed, q, w);
    set_rates(t.tree, packed, v, w);
    place(packed, w);
    move(packed, w);
    first_pass(packed, w);
    second_pass(packed, w);
  }

  PackedTree packed;
  Packed w;
  PackedMatrix M;
  FreeMotion free;
  ShadowTerm term;
};

struct Dense {
  VecX a;
  double kappa;
  double terms;      ///< size of what kappa is the difference of
  double condition;  ///< of the mass matrix
};

Dense dense(const RandomTree& t, const PackedTree& packed, const VecX& q, const VecX& v) {
  const LagrangianPartials L = lagrangian(t.tree, packed, q, v);
  const VecX force = L.L_q - L.L_vq * v;
  const Eigen::LLT<MatX> M(L.L_vv);
  const VecX a = M.solve(force);
  const double inertial = force.dot(a), bent = v.dot(L.L_qq * v);
  return {a, inertial - bent, std::abs(inertial) + std::abs(bent), 1 / M.rcond()};
}

TEST(Shadow, TermIsThatOfDenseMatrices) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (int k = 0; k < trees; ++k) {
    const RandomTree t = packed_tree(k);
    const Shadow s(t);
    const Dense d = dense(t, s.packed, t.q, t.v);
    const double tolerance = 1e-14 + eps * d.condition;  // of a solve, and of sums
    EXPECT_LT(relative_error(s.free.a, d.a), tolerance) << k;
    EXPECT_NEAR(s.free.kappa, d.kappa, tolerance * d.terms) << k;
    EXPECT_NEAR(s.term.kappa, d.kappa, tolerance * d.terms) << k;
  }
}

// Steps of 0.005 leave 2.1 eps / h = 1e-13 of rounding, times what the sums of 40 joints and the
// solve with M (condition up to 1e5) add: ten to thirty times that is measured. Of truncation: with
// h = 0.02 up to 3e-9 is (mimic multipliers), hence 4^-8 of it here.
TEST(Shadow, GradientByCoordinatesIsTheNumericOne) {
  for (int k = 0; k < trees; ++k) {
    const RandomTree t = packed_tree(k);
    const Shadow s(t);
    VecX numeric(t.q.size());
    for (int i = 0; i < t.q.size(); ++i) {
      const VecX e = VecX::Unit(t.q.size(), i);
      numeric[i] = test::derivative(
          [&](double h) { return dense(t, s.packed, t.q + h * e, t.v).kappa; }, 0.005);
    }
    const double scale = dense(t, s.packed, t.q, t.v).terms;
    EXPECT_LT(relative_error(s.term.kappa_q, numeric, scale), 1e-11) << k;
  }
}

// kappa is of fourth degree in v: differences of eighth order are exact, and long steps lose less.
TEST(Shadow, GradientByVelocitiesIsTheNumericOne) {
  for (int k = 0; k < trees; ++k) {
    const RandomTree t = packed_tree(k);
    const Shadow s(t);
    const auto kappa = [&](const VecX& v) { return dense(t, s.packed, t.q, v).kappa; };
    VecX numeric(t.q.size());
    for (int i = 0; i < t.q.size(); ++i) {
      const VecX e = VecX::Unit(t.q.size(), i);
      numeric[i] = test::derivative([&](double h) { return kappa(t.v + h * e); }, 0.1);
    }
    const double scale = dense(t, s.packed, t.q, t.v).terms;
    EXPECT_LT(relative_error(s.term.kappa_v, numeric, scale), 1e-12) << k;
  }
}

// The envelope: any other y in place of a gives (y - a)^T M (y - a) less.
TEST(Shadow, AccelerationOfFreeMotionMaximises) {
  test::Random random(8);
  for (int k = 0; k < trees; ++k) {
    const RandomTree t = packed_tree(k);
    Shadow s(t);
    const VecX d = random.vector(t.tree.n_v, 0.1);
    const double kappa = s.term.kappa, size = dense(t, s.packed, t.q, t.v).terms;
    const MatX M = mass_matrix(t.tree, s.packed, t.q);
    const VecX y = s.free.a + d;
    shadow_gradient(t.tree, s.packed, s.w, y, s.term);
    EXPECT_NEAR(kappa - s.term.kappa, d.dot(M * d), 1e-12 * size) << k;
  }
}

// With y held, no solve is in the way: depth alone is tested. The scratch has a slot for each
// joint, none for a pair: what is done, is done once a joint.
TEST(Shadow, DeepTreesCostASlotAJoint) {
  constexpr int joints = 600;
  test::Random random(9);
  const RandomTree t = random_tree(random, {.joints = joints, .branch = 0.02});
  Shadow s(t);
  for (const std::size_t blocks :
       {s.term.motion.size(), s.term.momenta.size(), s.term.by_joint.size()}) {
    EXPECT_EQ(blocks, static_cast<std::size_t>((joints + lanes - 1) / lanes));
  }
  const VecX y = random.vector(joints), dq = random.vector(joints), dv = random.vector(joints);
  const auto kappa = [&](double h) {
    s.evaluate(t, t.q + h * dq, t.v + h * dv);
    shadow_gradient(t.tree, s.packed, s.w, y, s.term);
    return s.term.kappa;
  };
  // 600 coordinates move at once: frequencies are those of long branches, hence the short step,
  // whose rounding is 2.1 eps / h = 5e-13
  const double numeric = test::derivative(kappa, 1e-3);
  const double scale = std::abs(kappa(0)) + std::abs(numeric);
  EXPECT_NEAR(s.term.kappa_q.dot(dq) + s.term.kappa_v.dot(dv), numeric, 1e-11 * scale);
}

TEST(Shadow, DoesNotMindTheSecondPass) {
  for (int k = 0; k < 12; ++k) {
    const RandomTree t = packed_tree(k);
    Shadow s(t);
    const ShadowTerm before = s.term;
    place(s.packed, s.w);
    move(s.packed, s.w);
    first_pass(s.packed, s.w);
    shadow_gradient(t.tree, s.packed, s.w, s.free.a, s.term);
    EXPECT_EQ(s.term.kappa, before.kappa);
    EXPECT_EQ(s.term.kappa_q, before.kappa_q);
    EXPECT_EQ(s.term.kappa_v, before.kappa_v);
  }
}

TEST(Shadow, KeepsEveryBitFarFromTheOrigin) {
  for (int k = 0; k < 50; ++k) {
    const RandomTree t = packed_tree(k);
    RandomTree far = t;
    for (int i = 0; i < t.tree.joints(); ++i) {
      if (t.tree.parent[i] < 0) far.tree.X_PJ[i].p += Vec3(1e3, -2e6, 3e6);
    }
    const Shadow a(t), b(far);
    EXPECT_EQ(a.term.kappa, b.term.kappa) << k;
    EXPECT_EQ(a.term.kappa_q, b.term.kappa_q) << k;
    EXPECT_EQ(a.term.kappa_v, b.term.kappa_v) << k;
  }
}

// A base that slid there: O is past the slides.
TEST(Shadow, KeepsItsDigitsWhereABaseSlidFar) {
  for (int k = 0; k < 50; ++k) {
    test::Random random(static_cast<std::uint64_t>(70 + k));
    const RandomTree arm = random_tree(random, {.joints = 6, .branch = 0.3});
    RandomTree t;
    t.mass.gravity = arm.mass.gravity;
    for (int i = 0; i < 3; ++i) {
      add_joint(t.tree, i - 1, {Joint::Kind::prismatic, 0}, random.pose(), {i, 1, 0});
      t.mass.body.push_back(random.body());
    }
    for (int i = 0; i < 6; ++i) {
      add_joint(t.tree, arm.tree.parent[i] < 0 ? 2 : 3 + arm.tree.parent[i], arm.tree.joint[i],
                arm.tree.X_PJ[i], {3 + i, 1, 0});
      t.mass.body.push_back(arm.mass.body[i]);
    }
    t.q = random.vector(9);
    t.v = random.vector(9, 2);
    const Shadow near(t);
    t.q.head(3) += Vec3(1e3, -1e3, 1e3);
    const Shadow far(t);
    EXPECT_LT(relative_error(near.term.kappa_q, far.term.kappa_q), 1e-12) << k;  // rounding
    EXPECT_LT(relative_error(near.term.kappa_v, far.term.kappa_v), 1e-12) << k;
    EXPECT_LT(far.term.kappa_q.head(3).norm(), 1e-12 * far.term.kappa_q.norm()) << k;
  }
}

// L = I v^2 / 2 + k cos q: a = -k sin q / I, kappa = k^2 sin^2 q / I + k v^2 cos q. Small swings
// are those of the harmonic oscillator, kappa = k^2 q^2 / I + k v^2.
TEST(Shadow, Pendulum) {
  const double m = 1.3, l = 0.7, I = 0.2 + m * l * l, g = 9.81, k = m * g * l;
  RandomTree t;
  const Mat3 to_y = rotation_z_to(Vec3::UnitY());
  add_joint(t.tree, -1, {}, {to_y, {0.4, 0.1, 2}}, {0, 1, 0});
  t.mass.gravity = {0, 0, -g};
  t.mass.body.push_back({m, to_y.transpose() * Vec3(0, 0, -l), 0.2 * Mat3::Identity()});
  const auto at = [&](double q, double v) {
    t.q = VecX::Constant(1, q);
    t.v = VecX::Constant(1, v);
    return Shadow(t).term;
  };
  const double q = 0.6, v = -1.7;
  const ShadowTerm swing = at(q, v);
  EXPECT_NEAR(swing.kappa, k * k * sin(q) * sin(q) / I + k * v * v * cos(q), 1e-12);
  EXPECT_NEAR(swing.kappa_q[0], k * k * sin(2 * q) / I - k * v * v * sin(q), 1e-12);
  EXPECT_NEAR(swing.kappa_v[0], 2 * k * v * cos(q), 1e-12);
  const double tiny = 1e-4;  // relative errors are of tiny^2
  const ShadowTerm small = at(tiny, 2 * tiny);
  EXPECT_NEAR(small.kappa, (k * k / I + 4 * k) * tiny * tiny, 1e-6 * tiny * tiny);
  EXPECT_NEAR(small.kappa_q[0], 2 * k * k / I * tiny, 1e-5 * tiny);
  EXPECT_NEAR(small.kappa_v[0], 4 * k * tiny, 1e-5 * tiny);
}

// L = m (r'^2 + r^2 w^2) / 2: a = (-2 r' w / r, r w^2), kappa = m r^2 w^4 + 3 m r'^2 w^2. In
// Cartesian coordinates the same free motion has none.
TEST(Shadow, BeadOnATurningArm) {
  const double m = 0.8, r = 1.4, rate = -0.9, w = 1.7;
  RandomTree t;
  add_joint(t.tree, -1, {}, {}, {0, 1, 0});
  add_joint(t.tree, 0, {Joint::Kind::prismatic, 0}, {rotation_z_to(Vec3::UnitX()), {0, 0, 0}},
            {1, 1, 0});
  t.mass.body = {{0, Vec3::Zero(), Mat3::Zero()}, {m, Vec3::Zero(), Mat3::Zero()}};
  t.q = Eigen::Vector2d(0.3, r);
  t.v = Eigen::Vector2d(w, rate);
  const Shadow s(t);
  EXPECT_NEAR(s.free.a[0], -2 * rate * w / r, 1e-14);
  EXPECT_NEAR(s.free.a[1], r * w * w, 1e-14);
  EXPECT_NEAR(s.term.kappa, m * r * r * std::pow(w, 4) + 3 * m * rate * rate * w * w, 1e-13);
  EXPECT_NEAR(s.term.kappa_q[0], 0, 1e-13);
  EXPECT_NEAR(s.term.kappa_q[1], 2 * m * r * std::pow(w, 4), 1e-13);
  EXPECT_NEAR(s.term.kappa_v[0], 4 * m * r * r * w * w * w + 6 * m * rate * rate * w, 1e-13);
  EXPECT_NEAR(s.term.kappa_v[1], 6 * m * rate * w * w, 1e-13);
}

// Free fall: kappa = m g^2 wherever it is.
TEST(Shadow, FreeFallHasNoGradient) {
  RandomTree t;
  add_joint(t.tree, -1, {Joint::Kind::prismatic, 0}, {}, {0, 1, 0});
  t.mass.body.push_back({2, Vec3::Zero(), Mat3::Zero()});
  t.q = t.v = VecX::Constant(1, 3);
  const Shadow s(t);
  EXPECT_NEAR(s.term.kappa, 2 * 9.81 * 9.81, 1e-13);
  EXPECT_EQ(s.term.kappa_q[0], 0);
  EXPECT_EQ(s.term.kappa_v[0], 0);
}

}  // namespace
}  // namespace saltus
