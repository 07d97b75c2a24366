// What coordinates have of their own, armature, springs, slopes of forces: in L, in J, in torques.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lagrangian/packed_trees.hpp"
#include "saltus/lagrangian/newton_euler.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/lagrangian/shadow.hpp"

namespace saltus {
namespace {

constexpr TreeSolver solvers[] = {TreeSolver::automatic, TreeSolver::lu, TreeSolver::sweep};

/// A tree with armature and springs on its coordinates, beside the same without.
struct Twin {
  test::RandomTree plain, own;
};

Twin twin(int k) {
  Twin out{test::packed_tree(k), {}};
  out.own = out.plain;
  test::Random random(static_cast<std::uint64_t>(k));
  const int n = out.own.tree.n_v;
  out.own.mass.armature = random.vector(n).cwiseAbs();
  out.own.mass.stiffness = 5 * random.vector(n).cwiseAbs();
  out.own.mass.rest = random.vector(n);
  return out;
}

TEST(OwnTerms, AddToTheLagrangianWhatTheyAre) {
  for (int k = 0; k < 30; ++k) {
    const Twin t = twin(k);
    const VecX &q = t.own.q, &v = t.own.v, x = q - t.own.mass.rest;
    const VecX &a = t.own.mass.armature, &s = t.own.mass.stiffness;
    const PackedTree packed = pack(t.own.tree, t.own.mass);
    const LagrangianPartials L = lagrangian(t.own.tree, packed, q, v);
    const LagrangianPartials P = lagrangian(t.plain.tree, pack(t.plain.tree, t.plain.mass), q, v);
    const double more = 0.5 * v.dot(a.cwiseProduct(v)) - 0.5 * x.dot(s.cwiseProduct(x));
    const double scale = std::abs(P.value) + std::abs(more) + P.L_vv.norm() + P.L_q.norm() + 10;
    // sums of a few terms each
    EXPECT_NEAR(L.value, P.value + more, 1e-13 * scale) << k;
    EXPECT_LE((L.L_v - P.L_v - a.cwiseProduct(v)).norm(), 1e-13 * scale) << k;
    EXPECT_LE((L.L_q - P.L_q + s.cwiseProduct(x)).norm(), 1e-13 * scale) << k;
    EXPECT_LE((L.L_vv - P.L_vv - MatX(a.asDiagonal())).norm(), 1e-13 * scale) << k;
    EXPECT_LE((L.L_qq - P.L_qq + MatX(s.asDiagonal())).norm(), 1e-13 * scale) << k;
    EXPECT_LE((L.L_vq - P.L_vq).norm(), 1e-13 * scale) << k;
    EXPECT_LE((mass_matrix(t.own.tree, packed, q) - L.L_vv).norm(), 1e-13 * scale) << k;
  }
}

/// J + diagonal + G D G^T, solved as a dense matrix would be.
TEST(OwnTerms, NewtonsMatrixHoldsThemAndSlopesOfForces) {
  for (int k = 0; k < 30; ++k) {
    const Twin t = twin(k);
    const int n = t.own.tree.n_v;
    const LagrangianPartials L =
        lagrangian(t.own.tree, pack(t.own.tree, t.own.mass), t.own.q, t.own.v);
    test::Random random(static_cast<std::uint64_t>(100 + k));
    const VecX Q_q = -20 * random.vector(n).cwiseAbs(), Q_v = -3 * random.vector(n).cwiseAbs();
    MatX G(n, 2);
    for (int r = 0; r < 2; ++r) G.col(r) = random.vector(n);
    const VecX slope = -30 * random.vector(4).cwiseAbs();
    for (const TreeSolver solver : solvers) {
      test::PackedEvaluation e(t.own, solver);
      e.w.slope.resize(static_cast<std::size_t>(e.packed.slots / lanes));
      for (int c = 0; c < n; ++c) {
        double* to = at(e.w.slope, e.packed.slot_of_velocity[c]);
        to[0] = Q_q[c];
        to[lanes] = Q_v[c];
      }
      e.w.coupled = G;
      e.w.coupled_q = G * VecX(slope(Eigen::seqN(0, 2, 2))).asDiagonal();
      e.w.coupled_v = G * VecX(slope(Eigen::seqN(1, 2, 2))).asDiagonal();
      PackedMatrix J(t.own.tree, e.packed);
      for (const double tau : {0.01, 0.3}) {
        MatX dense = L.L_vv + tau / 2 * (L.L_vq - L.L_vq.transpose()) - tau * tau / 4 * L.L_qq;
        dense -= tau / 2 * MatX((Q_v + tau / 2 * Q_q).asDiagonal());
        for (int r = 0; r < 2; ++r) {
          dense -= tau / 2 * (slope[2 * r + 1] + tau / 2 * slope[2 * r]) *
                   (G.col(r) * G.col(r).transpose());
        }
        if (dense.fullPivLu().rcond() < 1e-10) continue;
        const VecX b = random.vector(n);
        VecX x = b;
        ASSERT_TRUE(factorize(t.own.tree, e.packed, e.w, tau, J)) << k;
        solve(t.own.tree, e.packed, J, x);
        EXPECT_LE((dense * x - b).norm(), 1e-11 * dense.norm() * x.norm()) << k << " " << tau;
      }
    }
  }
}

TEST(OwnTerms, TorquesHoldArmatureAndSprings) {
  for (int k = 0; k < 30; ++k) {
    const Twin t = twin(k);
    test::Random random(static_cast<std::uint64_t>(200 + k));
    const VecX a = random.vector(t.own.tree.n_v);
    const auto torques = [&](const test::RandomTree& tree) {
      const test::PackedEvaluation e(tree);
      PackedForces forces(e.packed);
      set_accelerations(tree.tree, e.packed, a, forces);
      newton_euler(e.packed, e.w, forces);
      VecX tau(tree.tree.n_v);
      gather(tree.tree, e.packed, forces.tau, 0, tau);
      return tau;
    };
    const VecX own = torques(t.own), plain = torques(t.plain);
    const VecX x = t.own.q - t.own.mass.rest;
    const VecX more = t.own.mass.armature.cwiseProduct(a) + t.own.mass.stiffness.cwiseProduct(x);
    EXPECT_LE((own - plain - more).norm(), 1e-13 * (own.norm() + more.norm() + 10)) << k;
  }
}

/// kappa's gradient by central differences, with a held (the envelope theorem).
TEST(OwnTerms, TheShadowTermHasTheirGradient) {
  for (int k = 0; k < 24; ++k) {
    const Twin t = twin(k);
    const PackedTree packed = pack(t.own.tree, t.own.mass);
    PackedMatrix M(t.own.tree, packed);
    FreeMotion free(t.own.tree, packed);
    const auto kappa = [&](const VecX& q, const VecX& v, Packed& w) {
      set_coordinates(t.own.tree, packed, q, w);
      set_rates(t.own.tree, packed, v, w);
      place(packed, w);
      move(packed, w);
      first_pass(packed, w);
      second_pass(packed, w);
      if (!factorize(t.own.tree, packed, w, 0, M)) return 0.0;
      free_motion(t.own.tree, packed, w, M, free);
      return free.kappa;
    };
    Packed w(packed), other(packed);
    ShadowTerm shadow(t.own.tree, packed);
    const double value = kappa(t.own.q, t.own.v, w);
    const VecX a = free.a;
    shadow_gradient(t.own.tree, packed, w, a, shadow);
    EXPECT_NEAR(shadow.kappa, value, 1e-11 * (std::abs(value) + 1)) << k;
    const double step = 1e-6;
    const double scale = 1 + shadow.kappa_q.norm() + shadow.kappa_v.norm();
    for (int c = 0; c < t.own.tree.n_v; ++c) {
      const VecX d = step * VecX::Unit(t.own.tree.n_v, c);
      const double by_q =
          (kappa(t.own.q + d, t.own.v, other) - kappa(t.own.q - d, t.own.v, other)) / (2 * step);
      const double by_v =
          (kappa(t.own.q, t.own.v + d, other) - kappa(t.own.q, t.own.v - d, other)) / (2 * step);
      // 1e-5: differences of kappa, whose third derivatives are large where masses are unlike
      EXPECT_NEAR(shadow.kappa_q[c], by_q, 1e-5 * scale) << k << " " << c;
      EXPECT_NEAR(shadow.kappa_v[c], by_v, 1e-5 * scale) << k << " " << c;
    }
  }
}

}  // namespace
}  // namespace saltus
