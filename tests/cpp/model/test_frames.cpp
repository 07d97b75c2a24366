// A model at one configuration, and at many: Jacobians and what else has a numeric twin.
#include "saltus/model/frames.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "kit/ask.hpp"
#include "kit/builders.hpp"
#include "kit/random_trees.hpp"
#include "numeric.hpp"
#include "saltus/model/dynamics.hpp"

namespace saltus {
namespace {

using test::joint;
using test::Random;
using test::relative_error;

constexpr double step = 0.01;  // central differences of eighth order: 1e-13 of what is derived

/// Every kind of joint, on two branches, one mimic; and something beside it that flies.
Model zoo() {
  Random random(3);
  ModelBuilder builder("zoo");
  const JointType kinds[] = {JointType::floating,  JointType::revolute, JointType::spherical,
                             JointType::prismatic, JointType::helical,  JointType::planar,
                             JointType::revolute,  JointType::floating};
  const char* parents[] = {"world", "b0", "b0", "b2", "b1", "b4", "b3", "world"};
  for (int i = 0; i < 8; ++i) {
    const std::string n = std::to_string(i);
    builder.add_link({"b" + n, random.body()});
    JointSpec spec = joint("j" + n, kinds[i], parents[i], "b" + n);
    spec.X_PJ = random.pose(0.4);
    spec.axis = random.unit();
    if (kinds[i] == JointType::helical) spec.pitch = 0.1;
    if (i == 6) spec.mimic = Mimic{"j1", -0.5, 0.2};
    builder.add_joint(spec);
  }
  builder.add_link({"tip", random.body()});
  JointSpec weld = joint("weld", JointType::fixed, "b6", "tip");
  weld.X_PJ = random.pose(0.3);
  builder.add_joint(weld);
  for (const char* link : {"b0", "b6", "tip"}) builder.add_shape(link, Sphere{0.1}, random.pose());
  builder.add_half_space("floor", {0, 0.1, 1}, -3);
  return builder.build();
}

VecX random_q(const Model& model, int seed) {
  std::mt19937_64 bits(static_cast<std::uint64_t>(seed));
  return model.random_configuration(bits);
}

/// d f / dt along v, of a function of a configuration.
template <class F>
auto along(const Model& model, const VecX& q, const VecX& v, const F& f) {
  return test::derivative([&](double h) { return f(model.integrate(q, h * v)); }, step);
}

TEST(Frames, PosesAreThoseOfTheTree) {
  const Model model = zoo();
  for (int seed = 0; seed < 5; ++seed) {
    const VecX q = random_q(model, seed);
    const Frames frames(model, q);
    Kinematics kin(model->tree);
    set_configuration(model->tree, q, kin);
    for (int i = 0; i < std::ssize(model->links); ++i) {
      const Link& link = model->links[static_cast<std::size_t>(i)];
      const Pose X = kin.X_WJ(model->tree, link.joint) * link.X_JL, ours = frames.pose(i);
      EXPECT_LT((X.R - ours.R).norm() + (X.p - ours.p).norm(), 1e-14) << link.name;
      EXPECT_EQ(model.X_WL(q, i).p, ours.p);
    }
    for (int i = 0; i < std::ssize(model->shapes); ++i) {
      const PlacedShape& shape = model->shapes[static_cast<std::size_t>(i)];
      const Pose X = frames.pose(shape.link) * shape.X_LG, ours = frames.shape_pose(i);
      EXPECT_LT((X.R - ours.R).norm() + (X.p - ours.p).norm(), 1e-14) << shape.name;
    }
  }
}

TEST(Frames, JacobiansAreDerivativesOfPoses) {
  const Model model = zoo();
  Random random(11);
  for (int seed = 0; seed < 5; ++seed) {
    const VecX q = random_q(model, seed);
    const Frames frames(model, q);
    for (int link = 0; link < std::ssize(model->links); ++link) {
      const Vec3 p_L = random.vec3();
      const MatX J = frames.jacobian(link), J_p = frames.jacobian(link, p_L);
      ASSERT_EQ(J.rows(), 6);
      ASSERT_EQ(J_p.rows(), 3);
      const Mat3 R = frames.pose(link).R;
      for (int c = 0; c < model.n_v(); ++c) {
        const VecX e = VecX::Unit(model.n_v(), c);
        const auto pose = [&](const VecX& at) {
          const Pose X = model.X_WL(at, link);
          Eigen::Matrix<double, 3, 5> out;
          out << X.R, X.p, X * p_L;
          return out;
        };
        const auto rate = along(model, q, e, pose);
        const Mat3 turn = rate.leftCols<3>() * R.transpose();  // [w]
        const Vec3 w(turn(2, 1), turn(0, 2), turn(1, 0));
        EXPECT_LT((J.col(c).head<3>() - w).norm(), 1e-12) << link << " " << c;
        EXPECT_LT((J.col(c).tail<3>() - rate.col(3)).norm(), 1e-11) << link << " " << c;
        EXPECT_LT((J_p.col(c) - rate.col(4)).norm(), 1e-11) << link << " " << c;
      }
    }
  }
}

TEST(Frames, MomentumIsThatOfItsParticles) {
  const Model model = zoo();
  Random random(12);
  const VecX q = random_q(model, 1), v = random.vector(model.n_v(), 2);
  Frames frames(model, q);
  // every body as six particles, which have its mass, its centre and its inertia
  Vec6 sum = Vec6::Zero();
  for (int link = 0; link < std::ssize(model->links); ++link) {
    const BodyInertia& body = model->links[static_cast<std::size_t>(link)].inertia;
    if (body.mass == 0) continue;
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(body.I_J);
    const Vec3 I = axes.eigenvalues();
    for (int k = 0; k < 3; ++k) {
      // second moments along the principal axes: (I_i + I_j - I_k) / 2
      const double moment = 0.5 * I.sum() - I[k];
      const Vec3 reach =
          std::sqrt(std::max(0.0, 3 * moment / body.mass)) * axes.eigenvectors().col(k);
      for (const double sign : {-1, 1}) {
        const Vec3 p_L = body.c_J + sign * reach;
        const Vec3 p = frames.pose(link) * p_L;
        const Vec3 momentum = body.mass / 6 * (frames.jacobian(link, p_L) * v);
        sum += spatial(p.cross(momentum), momentum);
      }
    }
  }
  EXPECT_LT((frames.momentum(v) - sum).norm(), 1e-13 * sum.norm());
}

TEST(Frames, CentreOfMassMovesWithTheMomentum) {
  const Model model = zoo();
  Random random(13);
  const VecX q = random_q(model, 2), v = random.vector(model.n_v(), 2);
  Frames frames(model, q);
  const Vec3 rate =
      along(model, q, v, [&](const VecX& at) { return Vec3(Frames(model, at).centre_of_mass()); });
  const Vec3 linear_momentum = linear(frames.momentum(v));
  EXPECT_LT((frames.mass() * rate - linear_momentum).norm(), 1e-11 * linear_momentum.norm());
}

TEST(Frames, GravityForcesAreTheSlopeOfTheEnergy) {
  const Model model = zoo();
  const VecX q = random_q(model, 3);
  VecX forces;
  Frames frames(model, q);
  frames.gravity_forces(forces);
  for (int c = 0; c < model.n_v(); ++c) {
    const VecX e = VecX::Unit(model.n_v(), c);
    const double slope =
        along(model, q, e, [&](const VecX& at) { return model.potential_energy(at); });
    EXPECT_NEAR(forces[c], -slope, 1e-11 * std::abs(model.potential_energy(q))) << c;
  }
}

TEST(Frames, TheTwoDynamicsAreInverse) {
  const Model model = zoo();
  Random random(14);
  Frames frames(model);
  for (int seed = 0; seed < 10; ++seed) {
    frames.set(random_q(model, seed));
    const VecX v = random.vector(model.n_v(), 2), a = random.vector(model.n_v(), 5);
    VecX forces, back, still, gravity;
    frames.inverse_dynamics(v, a, forces);
    frames.accelerations(v, forces, back);
    EXPECT_LT((back - a).norm(), 1e-11 * a.norm()) << seed;  // condition of M
    const VecX zero = VecX::Zero(model.n_v());
    frames.inverse_dynamics(zero, zero, still);
    frames.gravity_forces(gravity);
    EXPECT_LT((still + gravity).norm(), 1e-13 * gravity.norm()) << seed;
  }
}

// Without forces the momenta about the origin change by gravity alone: a check of accelerations
// that knows nothing of how they are computed.
TEST(Frames, AccelerationsKeepTheMomentumOfWhatFlies) {
  Random random(15);
  ModelBuilder builder("flies");
  builder.set_gravity({1, -2, 3});
  for (int i = 0; i < 4; ++i) {
    const std::string n = std::to_string(i);
    builder.add_link({"b" + n, random.body()});
    JointSpec spec = joint("j" + n,
                           i == 0   ? JointType::floating
                           : i == 2 ? JointType::spherical
                                    : JointType::revolute,
                           i == 0 ? "world" : "b" + std::to_string(i - 1), "b" + n);
    spec.X_PJ = random.pose(0.4);
    spec.axis = random.unit();
    builder.add_joint(spec);
  }
  const Model model = builder.build();
  const VecX q = random_q(model, 4), v = random.vector(model.n_v(), 2);
  Frames frames(model, q);
  VecX a;
  frames.accelerations(v, VecX::Zero(model.n_v()), a);
  // along a curve with these rates at 0: q(h) = q + h v + h^2 a / 2, v(h) = v + h a; of balls the
  // second-order term of the curve is along w as well, which changes nothing at h = 0
  const Vec6 rate = test::derivative(
      [&](double h) {
        const VecX at = model.integrate(q, h * v + 0.5 * h * h * a);
        Frames there(model, at);
        return Vec6(there.momentum(v + h * a));
      },
      step);
  const Vec3 weight = frames.mass() * model->mass.gravity;
  const Vec6 expected = spatial(frames.centre_of_mass().cross(weight), weight);
  EXPECT_LT((rate - expected).norm(), 1e-9 * expected.norm());
}

TEST(Frames, GapsAreThoseOfTheModel) {
  const Model model = zoo();
  const VecX q = random_q(model, 5);
  const Gaps ours = Frames(model, q).gaps(), gaps = model.gaps(q);
  ASSERT_GT(gaps.phi.size(), 3);
  EXPECT_EQ(ours.phi, gaps.phi);
  EXPECT_EQ(ours.phi_q, gaps.phi_q);
}

TEST(Rows, AreTheConfigurationsOneByOne) {
  const Model model = zoo();
  Random random(16);
  const int rows = 4, link = model.link("tip"), n = model.n_v();
  MatX q(rows, model.n_q()), v(rows, n), a(rows, n);
  for (int row = 0; row < rows; ++row) {
    q.row(row) = random_q(model, row).transpose();
    v.row(row) = random.vector(n).transpose();
    a.row(row) = random.vector(n).transpose();
  }
  const MatX J = jacobians(model, q, link), J_p = jacobians(model, q, link, Vec3(1, 2, 3));
  const MatX tau = inverse_dynamics(model, q, v, a), back = accelerations(model, q, v, tau);
  const MatX T = all_poses(model, q), T_G = all_shape_poses(model, q),
             com = centres_of_mass(model, q);
  const MatX h = momenta(model, q, v, com), gravity = gravity_forces(model, q);
  EXPECT_LT(relative_error(back, a), 1e-11);
  for (int row = 0; row < rows; ++row) {
    Frames frames(model, q.row(row).transpose());
    VecX x;
    EXPECT_EQ((Eigen::Map<const MatX>(J.row(row).data(), 6, n)), frames.jacobian(link));
    EXPECT_EQ((Eigen::Map<const MatX>(J_p.row(row).data(), 3, n)),
              frames.jacobian(link, Vec3(1, 2, 3)));
    frames.inverse_dynamics(v.row(row).transpose(), a.row(row).transpose(), x);
    EXPECT_EQ(VecX(tau.row(row).transpose()), x);
    frames.gravity_forces(x);
    EXPECT_EQ(VecX(gravity.row(row).transpose()), x);
    const Vec6 sum = frames.momentum(v.row(row).transpose());
    const Vec3 c = frames.centre_of_mass();
    EXPECT_LT(
        (h.row(row).head<3>().transpose() - (angular(sum) - c.cross(Vec3(linear(sum))))).norm(),
        1e-13 * sum.norm());
    EXPECT_EQ(T(row, 16 * link + 3), frames.pose(link).p.x());
    EXPECT_EQ(T(row, 16 * link + 6), frames.pose(link).R(1, 2));
    EXPECT_EQ(T_G(row, 16 + 11), frames.shape_pose(1).p.z());
  }
}

TEST(Rows, OneStandsForAll) {
  const Model model = test::arm().build();
  MatX q(3, 2);
  q << 0, 1, 2, 3, 4, 5;
  const MatX v = MatX::Ones(1, 2), a = MatX::Zero(1, 2);
  const MatX tau = inverse_dynamics(model, q, v, a);
  ASSERT_EQ(tau.rows(), 3);
  EXPECT_EQ(tau.row(2), inverse_dynamics(model, q.row(2), v, a));
  EXPECT_EQ(inverse_dynamics(model, q.row(0), v.replicate(2, 1), a).rows(), 2);
  EXPECT_EQ(all_poses(model, MatX(0, 2)).rows(), 0);
}

TEST(Rows, WrongOnesAreNamed) {
  const Model model = test::arm().build();
  const MatX q = MatX::Zero(3, 2);
  MatX nan = q;
  nan(1, 0) = std::numeric_limits<double>::quiet_NaN();
  test::expect_error([&] { all_poses(model, MatX::Zero(3, 4)); },
                     {"rows of q have 4 entries; the model has 2 coordinates"});
  test::expect_error([&] { gravity_forces(model, nan); }, {"row 1 of q is not finite"});
  test::expect_error([&] { inverse_dynamics(model, q, MatX::Zero(2, 2), MatX::Zero(1, 2)); },
                     {"q has 3 rows and v has 2"});
  test::expect_error([&] { inverse_dynamics(model, q, nan, MatX::Zero(1, 2)); },
                     {"row 1 of v is not finite"});
  test::expect_error([&] { Frames(ModelBuilder().build()).centre_of_mass(); }, {"has mass"});
}

}  // namespace
}  // namespace saltus
