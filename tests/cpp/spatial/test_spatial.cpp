// The algebra of 6-vectors, poses and inertias against its defining identities.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kit/random_trees.hpp"
#include "numeric.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {
namespace {

using test::Random;
using test::relative_error;

// Sums of a dozen products of numbers of size 1: 16 eps.
constexpr double rounding = 4e-15;

TEST(Spatial, ForceCrossIsTheAdjointOfMotionCross) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec6 a = random.vec6(), b = random.vec6(), f = random.vec6();
    EXPECT_NEAR(b.dot(cross_force(a, f)), -cross_motion(a, b).dot(f), rounding);
  }
}

TEST(Spatial, MotionCrossIsALieBracket) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Vec6 a = random.vec6(), b = random.vec6(), c = random.vec6();
    EXPECT_LT(cross_motion(a, a).norm(), rounding);
    EXPECT_LT((cross_motion(a, b) + cross_motion(b, a)).norm(), rounding);
    const Vec6 jacobi = cross_motion(a, cross_motion(b, c)) + cross_motion(b, cross_motion(c, a)) +
                        cross_motion(c, cross_motion(a, b));
    EXPECT_LT(jacobi.norm(), 4 * rounding);
  }
}

// The bracket is the commutator of the 4x4 matrices of the twists.
TEST(Spatial, MotionCrossIsTheCommutatorOfMatrices) {
  const auto matrix = [](const Vec6& x) {
    Eigen::Matrix4d X = Eigen::Matrix4d::Zero();
    X(2, 1) = x[0], X(1, 2) = -x[0], X(0, 2) = x[1];
    X(2, 0) = -x[1], X(1, 0) = x[2], X(0, 1) = -x[2];
    X.topRightCorner<3, 1>() = linear(x);
    return X;
  };
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    const Vec6 a = random.vec6(), b = random.vec6();
    const Eigen::Matrix4d A = matrix(a), B = matrix(b);
    EXPECT_LT((A * B - B * A - matrix(cross_motion(a, b))).norm(), rounding);
  }
}

TEST(Spatial, PartsOfASixVector) {
  const Vec6 x = spatial({1, 2, 3}, {4, 5, 6});
  EXPECT_EQ(Vec3(angular(x)), Vec3(1, 2, 3));
  EXPECT_EQ(Vec3(linear(x)), Vec3(4, 5, 6));
  EXPECT_EQ(x[0], 1);
  EXPECT_EQ(x[5], 6);
}

struct Particle {
  double mass;
  Vec3 r;  // from O
};

std::vector<Particle> random_particles(Random& random) {
  std::vector<Particle> out;
  for (int k = 0; k < 7; ++k) out.push_back({random.uniform(0.1, 1), random.vec3()});
  return out;
}

// Momentum and moment of momentum of particles that move with one twist.
TEST(Inertia, MomentumIsThatOfParticles) {
  Random random(4);
  for (int k = 0; k < 50; ++k) {
    const std::vector<Particle> particles = random_particles(random);
    const Vec6 V = random.vec6();
    Inertia sum;
    Vec6 momentum = Vec6::Zero();
    for (const Particle& particle : particles) {
      sum += inertia_about(particle.mass, particle.r, Mat3::Zero());
      const Vec3 p = particle.mass * (linear(V) + angular(V).cross(particle.r));
      momentum += spatial(particle.r.cross(p), p);
    }
    EXPECT_LT(relative_error(Vec6(sum * V), momentum), rounding);
  }
}

TEST(Inertia, OfABodyFromItsCentreOfMass) {
  Random random(5);
  const std::vector<Particle> particles = random_particles(random);
  double mass = 0;
  Vec3 c = Vec3::Zero();
  for (const Particle& p : particles) mass += p.mass;
  for (const Particle& p : particles) c += p.mass / mass * p.r;
  Inertia about_O;
  Mat3 about_c = Mat3::Zero();
  for (const Particle& p : particles) {
    about_O += inertia_about(p.mass, p.r, Mat3::Zero());
    about_c += inertia_about(p.mass, p.r - c, Mat3::Zero()).I;
  }
  const Inertia body = inertia_about(mass, c, about_c);
  EXPECT_NEAR(body.mass, about_O.mass, rounding);
  EXPECT_LT(relative_error(body.h, about_O.h), rounding);
  EXPECT_LT(relative_error(body.I, about_O.I), rounding);
}

TEST(Inertia, OfAPointMassByHand) {
  const Inertia I = inertia_about(2, {0, 3, 0}, Mat3::Zero());
  EXPECT_EQ(I.mass, 2);
  EXPECT_EQ(I.h, Vec3(0, 6, 0));
  EXPECT_EQ(I.I, Mat3(Vec3(18, 0, 18).asDiagonal()));
}

TEST(Pose, ComposesLikeHomogeneousMatrices) {
  Random random(6);
  for (int k = 0; k < 50; ++k) {
    const Pose X_AB = random.pose(), X_BC = random.pose();
    const Vec3 p_C = random.vec3();
    EXPECT_LT(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm(), rounding);
    EXPECT_LT((X_AB * p_C - (X_AB.R * p_C + X_AB.p)).norm(), rounding);
    const Pose one = X_AB * X_AB.inverse(), other = X_AB.inverse() * X_AB;
    EXPECT_LT((one.R - Mat3::Identity()).norm() + one.p.norm(), rounding);
    EXPECT_LT((other.R - Mat3::Identity()).norm() + other.p.norm(), rounding);
  }
  EXPECT_EQ(Pose{} * Vec3(1, 2, 3), Vec3(1, 2, 3));
}

// Fixed axes: roll first about x, then pitch about y, then yaw about z, as URDF has it.
TEST(Pose, RollPitchYaw) {
  const double right = std::acos(0.0);
  const auto turned = [](double roll, double pitch, double yaw, const Vec3& x) {
    return Vec3(rotation_from_rpy(roll, pitch, yaw) * x);
  };
  EXPECT_LT((turned(right, 0, 0, Vec3::UnitY()) - Vec3::UnitZ()).norm(), rounding);
  EXPECT_LT((turned(0, right, 0, Vec3::UnitZ()) - Vec3::UnitX()).norm(), rounding);
  EXPECT_LT((turned(0, 0, right, Vec3::UnitX()) - Vec3::UnitY()).norm(), rounding);
  // y -> (roll) z -> (pitch) x -> (yaw) y
  EXPECT_LT((turned(right, right, right, Vec3::UnitY()) - Vec3::UnitY()).norm(), rounding);
  // x -> (roll) x -> (pitch) -z; with the axes in the other order it would end at y
  EXPECT_LT((turned(right, right, right, Vec3::UnitX()) + Vec3::UnitZ()).norm(), rounding);
  // the closed form, entry by entry
  using std::cos, std::sin;
  const double r = 0.3, p = -0.7, y = 1.9;
  Mat3 R;
  R << cos(y) * cos(p), cos(y) * sin(p) * sin(r) - sin(y) * cos(r),
      cos(y) * sin(p) * cos(r) + sin(y) * sin(r),  //
      sin(y) * cos(p), sin(y) * sin(p) * sin(r) + cos(y) * cos(r),
      sin(y) * sin(p) * cos(r) - cos(y) * sin(r),  //
      -sin(p), cos(p) * sin(r), cos(p) * cos(r);
  EXPECT_LT((rotation_from_rpy(r, p, y) - R).norm(), rounding);
}

}  // namespace
}  // namespace saltus
