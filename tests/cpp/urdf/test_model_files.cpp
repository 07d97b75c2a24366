// The files in urdf/ are what their comments say.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "urdf/urdf_text.hpp"

namespace saltus {
namespace {

using namespace test;

Model load_file(const std::string& name) {
  return load(std::string(SALTUS_URDF_DIR) + "/" + name + ".urdf");
}

class UrdfCradle : public testing::TestWithParam<int> {
 protected:
  const int n_ = GetParam();
  const Model model_ = load_file("newtons_cradle_" + std::to_string(n_));
};
INSTANTIATE_TEST_SUITE_P(Balls, UrdfCradle, testing::Values(3, 5));

TEST_P(UrdfCradle, NamesAreNumberedFromMinusX) {
  ASSERT_EQ(model_.n_q(), 2 * n_);
  for (int i = 0; i < n_; ++i) {
    EXPECT_EQ(model_->coordinates[2 * i].name, "swing_" + std::to_string(i));
    EXPECT_EQ(model_->coordinates[2 * i + 1].name, "sway_" + std::to_string(i));
    EXPECT_EQ(model_->links[model_->shapes[i].link].name, "ball_" + std::to_string(i));
    EXPECT_EQ(model_->shapes[i].name, "ball_" + std::to_string(i));
  }
  EXPECT_EQ(model_->links[0].name, "frame");
  EXPECT_TRUE(model_->warnings.empty());
}

// Exactly, not to 1e-15: what touches at rest shall not depend on a tolerance.
TEST_P(UrdfCradle, NeighboursTouchAtRest) {
  const Gaps gaps = model_.gaps(VecX::Zero(2 * n_));
  ASSERT_EQ(gaps.phi.size(), n_ * (n_ - 1) / 2);
  for (int k = 0, i = 0; i < n_; ++i) {
    for (int j = i + 1; j < n_; ++j, ++k) {
      EXPECT_EQ(gaps.names[k], "ball_" + std::to_string(i) + " ~ ball_" + std::to_string(j));
      if (j == i + 1) {
        EXPECT_EQ(gaps.phi[k], 0);
      } else {
        EXPECT_NEAR(gaps.phi[k], 0.1 * (j - i - 1), 1e-15);
      }
    }
  }
}

TEST_P(UrdfCradle, BallsHangAtHeightZeroOnAxesOfTheirOwn) {
  for (int i = 0; i < n_; ++i) {
    const Pose X = pose_of(model_, "ball_" + std::to_string(i));
    expect_near(X.p, {0.1 * (i - (n_ - 1) / 2), 0, 1});
    EXPECT_EQ(X.R, Mat3::Identity());
    const Vec3 centre = X * model_->shapes[i].X_JG.p;
    EXPECT_EQ((X * Vec3(0, 0, -1)).z(), 0) << centre.transpose();
  }
  const Pose X = pose_of(model_, "ball_0", {{"swing_0", 0.3}});
  expect_near(X.R * Vec3(0, 0, -1), Vec3{-std::sin(0.3), 0, -std::cos(0.3)});
  const Pose Y = pose_of(model_, "ball_0", {{"sway_0", 0.3}});
  expect_near(Y.R * Vec3(0, 0, -1), Vec3{0, std::sin(0.3), -std::cos(0.3)});
}

TEST_P(UrdfCradle, MassMatrixIsThatOfPendulumsOfOneMetre) {
  const MatX M = model_.mass_matrix(VecX::Zero(2 * n_));
  EXPECT_LE((M - 1.001 * MatX::Identity(2 * n_, 2 * n_)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(UrdfModelFiles, BouncingBall) {
  const Model model = load_file("bouncing_ball");
  EXPECT_EQ(model->coordinates[0].name, "height");
  EXPECT_EQ(model->coordinates[0].unit, Unit::metre);
  const State at = model.state({{"height", 1.5}}, {{"height", 2.0}});
  EXPECT_EQ(model.gaps(at.q).names, std::vector<std::string>{"ball ~ floor"});
  EXPECT_DOUBLE_EQ(model.gaps(at.q).phi[0], 1.4);
  EXPECT_DOUBLE_EQ(model.kinetic_energy(at), 2);
  EXPECT_DOUBLE_EQ(model.potential_energy(at.q), 9.81 * 1.5);
}

TEST(UrdfModelFiles, PendulumAndWall) {
  const Model model = load_file("pendulum_and_wall");
  EXPECT_DOUBLE_EQ(model.mass_matrix(VecX::Zero(1))(0, 0), 1.004);
  EXPECT_EQ(model.gaps(VecX::Zero(1)).phi[0], 0);
  for (const double swing : {0.4, -0.1, 1.0}) {
    const Gaps gaps = model.gaps(VecX::Constant(1, swing));
    EXPECT_EQ(gaps.names, std::vector<std::string>{"bob ~ wall"});
    EXPECT_NEAR(gaps.phi[0], std::sin(swing), 1e-15);
  }
}

// M of two rods: [3 + 2 cos q2 + 2 I, 1 + cos q2 + I; ., 1 + I].
TEST(UrdfModelFiles, DoublePendulum) {
  const Model model = load_file("double_pendulum");
  const double I = 0.001, c = std::cos(0.7);
  const MatX M = model.mass_matrix(model.state({{"shoulder", 0.2}, {"elbow", 0.7}}).q);
  EXPECT_NEAR(M(0, 0), 3 + 2 * c + 2 * I, 1e-14);
  EXPECT_NEAR(M(0, 1), 1 + c + I, 1e-14);
  EXPECT_NEAR(M(1, 1), 1 + I, 1e-15);
  EXPECT_DOUBLE_EQ(model.potential_energy(VecX::Zero(2)), 9.81 * (1 + 0));
  EXPECT_TRUE(model->pairs.empty());
}

TEST(UrdfModelFiles, SphericalPendulum) {
  const Model model = load_file("spherical_pendulum");
  const State q = model.state({{"swing", 0.4}, {"sway", 0.7}});
  const Pose X = model.X_WL(q.q, model.link("ball"));
  expect_near(X * Vec3(0, 0, -1),
              {-std::cos(0.7) * std::sin(0.4), std::sin(0.7), 1 - std::cos(0.7) * std::cos(0.4)});
  // about y: m (l cos sway)^2 + I; about x: m l^2 + I
  const MatX M = model.mass_matrix(q.q);
  EXPECT_NEAR(M(0, 0), std::cos(0.7) * std::cos(0.7) + 0.001, 1e-15);
  EXPECT_NEAR(M(1, 1), 1.001, 1e-15);
  EXPECT_NEAR(M(0, 1), 0, 1e-15);
}

TEST(UrdfModelFiles, ArmStandsUpright) {
  const Model model = load_file("arm");
  ASSERT_EQ(model.n_q(), 7);
  EXPECT_EQ(model->coordinates[6].name, "grip");
  EXPECT_EQ(model->coordinates[1].upper, 2);
  EXPECT_EQ(model->coordinates[1].effort, 80);
  EXPECT_EQ(model->coordinates[1].damping, 0.5);
  double mass = 0;
  for (const Link& link : model->links) mass += link.mass;
  EXPECT_DOUBLE_EQ(mass, 4 + 3 + 2 + 0.8 + 0.5 + 0.4 + 2 * 0.05);
  const std::map<std::string, double> heights = {{"turret", 0.1},   {"upper_arm", 0.2},
                                                 {"forearm", 0.55}, {"wrist_1", 0.7},
                                                 {"wrist_2", 0.85}, {"hand", 0.92}};
  for (const auto& [link, z] : heights) expect_near(pose_of(model, link).p, {0, 0, z});
  expect_near(pose_of(model, "hand", {{"elbow", 1.5707963267948966}}).p, {0.37, 0, 0.55});
}

TEST(UrdfModelFiles, ArmsGripperMirrors) {
  const Model model = load_file("arm");
  const std::map<std::string, double> q = {{"grip", 0.02}};
  expect_near(pose_of(model, "finger_left", q).p, {0, 0.035, 0.98});
  expect_near(pose_of(model, "finger_right", q).p, {0, -0.035, 0.98});
  const Gaps gaps = model.gaps(model.state(q).q);
  for (std::size_t k = 0; k < gaps.names.size(); ++k) {
    EXPECT_GT(gaps.phi[static_cast<Eigen::Index>(k)], 0) << gaps.names[k];
    if (gaps.names[k] == "finger_left ~ finger_right") {
      EXPECT_NEAR(gaps.phi[static_cast<Eigen::Index>(k)], 0.01 + 2 * 0.02, 1e-15);
    }
  }
}

TEST(UrdfModelFiles, ArmsCapsulesAreThoseThatItsInertiasAreOf) {
  const Model model = load_file("arm");
  int capsules = 0;
  for (const PlacedShape& shape : model->shapes) {
    const auto* capsule = std::get_if<Capsule>(&shape.shape);
    if (capsule == nullptr) continue;
    ++capsules;
    const BodyInertia& body = model->mass.body[shape.joint];
    expect_near(shape.X_JG.p, body.c_J);
    const double r = capsule->radius, l = 2 * capsule->half_length;
    const double ball = body.mass * (4 * r) / (4 * r + 3 * l), rod = body.mass - ball;
    const double along = rod * r * r / 2 + ball * 2 / 5 * r * r;
    const double across =
        rod * (l * l / 12 + r * r / 4) + ball * (2 * r * r / 5 + l * l / 4 + 3 * l * r / 8);
    const Mat3 R = shape.X_JG.R;
    expect_near(body.I_J, R * Vec3(across, across, along).asDiagonal() * R.transpose(), 1e-7);
  }
  EXPECT_EQ(capsules, 3);
}

TEST(UrdfModelFiles, AllLoadAndStandAlone) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SALTUS_URDF_DIR)) {
    if (entry.path().extension() != ".urdf") continue;
    ++files;
    const ModelBuilder builder = read_urdf(entry.path().string());
    EXPECT_TRUE(builder.warnings().empty()) << entry.path();
    EXPECT_EQ(builder.build()->name, entry.path().stem().string());
  }
  EXPECT_GE(files, 7);
}

}  // namespace
}  // namespace saltus
