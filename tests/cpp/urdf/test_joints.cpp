// Every joint type moves its link as the URDF specification says; limits, dynamics and mimic.
#include <cmath>
#include <limits>
#include <sstream>

#include "urdf/urdf_text.hpp"

namespace saltus {
namespace {

using namespace test;

constexpr double pi = 3.14159265358979323846;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr const char* limit = "<limit lower=\"-1\" upper=\"2\" effort=\"3\" velocity=\"4\"/>";

Mat3 turn(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

TEST(UrdfJoints, RevoluteTurnsAboutItsAxis) {
  const Model model = load(
      one_joint("revolute", std::string("<origin xyz=\"1 2 3\"/><axis xyz=\"0 1 0\"/>") + limit));
  const Pose X = pose_of(model, "body", {{"j", 0.7}});
  expect_near(X.R, turn(0.7, Vec3::UnitY()));
  expect_near(X.p, {1, 2, 3});
  EXPECT_EQ(model->joints[0].type, JointType::revolute);
}

TEST(UrdfJoints, TheDefaultAxisIsX) {
  const Model model = load(one_joint("continuous"));
  expect_near(pose_of(model, "body", {{"j", 0.7}}).R, turn(0.7, Vec3::UnitX()));
  EXPECT_EQ(model->joints[0].type, JointType::continuous);
}

TEST(UrdfJoints, PrismaticMovesAlongItsAxisInTheJointFrame) {
  // rpy 0 0 90 deg takes the joint's x to the parent's y
  const Model model = load(one_joint(
      "prismatic", std::string("<origin xyz=\"1 0 0\" rpy=\"0 0 1.5707963267948966\"/>") + limit));
  const Pose X = pose_of(model, "body", {{"j", 0.25}});
  expect_near(X.p, {1, 0.25, 0});
  expect_near(X.R, turn(pi / 2, Vec3::UnitZ()), 4e-16);
}

TEST(UrdfJoints, AxesOfAnyDirectionAndLength) {
  for (const char* axis :
       {"1 2 -2", "10 20 -20", "1e-200 2e-200 -2e-200", "1e200 2e200 -2e200", "+.1 2.e-1 -0.2"}) {
    const Model model = load(one_joint("continuous", "<axis xyz=\"" + std::string(axis) + "\"/>"));
    expect_near(pose_of(model, "body", {{"j", 0.7}}).R, turn(0.7, Vec3(1, 2, -2)), 4e-16);
  }
}

TEST(UrdfJoints, CoordinateAxesAreExact) {
  for (const char* axis : {"0 0 1", "0 0 7", "-3 0 0", "0 1e-3 0"}) {
    const Model model = load(one_joint("continuous", "<axis xyz=\"" + std::string(axis) + "\"/>"));
    EXPECT_EQ(pose_of(model, "body").R, Mat3::Identity());
  }
}

TEST(UrdfJoints, FixedHasNoCoordinateAndIgnoresItsAxis) {
  const Model model =
      load(robot("<link name=\"a\"/>" + ball_link("b") + ball_link("c") +
                 joint("f", "fixed", "a", "b", "<origin xyz=\"0 0 2\"/><axis xyz=\"0 0 0\"/>") +
                 joint("t", "continuous", "b", "c", "<origin xyz=\"0 3 0\"/>")));
  EXPECT_EQ(model.n_q(), 1);
  expect_near(pose_of(model, "b").p, {0, 0, 2});
  expect_near(pose_of(model, "c").p, {0, 3, 2});
  EXPECT_EQ(model->joints[0].type, JointType::fixed);
}

/// The quaternion of joint "j" by names.
std::map<std::string, double> turned(const Mat3& R, std::map<std::string, double> q = {}) {
  const Quaternion x(R);
  q.insert({{"j_qx", x.x()}, {"j_qy", x.y()}, {"j_qz", x.z()}, {"j_qw", x.w()}});
  return q;
}

TEST(UrdfJoints, FloatingIsAPositionAndAQuaternion) {
  const Model model = load(one_joint("floating", "<origin xyz=\"0 0 1\"/>"));
  ASSERT_EQ(model.n_q(), 7);
  ASSERT_EQ(model.n_v(), 6);
  const Pose X =
      pose_of(model, "body",
              turned(rotation_from_rpy(0.1, 0.2, 0.3), {{"j_x", 1}, {"j_y", 2}, {"j_z", 3}}));
  expect_near(X.p, {1, 2, 4});
  expect_near(X.R, rotation_from_rpy(0.1, 0.2, 0.3), 4e-16);
}

TEST(UrdfJoints, PlanarMovesNormalToItsAxis) {
  const Model flat = load(one_joint("planar", "<axis xyz=\"0 0 1\"/>"));
  const Pose X = pose_of(flat, "body", {{"j_x", 1}, {"j_y", 2}, {"j_yaw", 0.3}});
  expect_near(X.p, {1, 2, 0});
  expect_near(X.R, turn(0.3, Vec3::UnitZ()));

  const Model upright = load(one_joint("planar", "<axis xyz=\"0 2 0\"/>"));
  const Pose Y = pose_of(upright, "body", {{"j_x", 1}, {"j_y", 2}, {"j_yaw", 0.3}});
  EXPECT_EQ(Y.p.y(), 0);
  EXPECT_DOUBLE_EQ(Y.p.norm(), std::sqrt(5.0));
  expect_near(Y.R, turn(0.3, Vec3::UnitY()));
}

TEST(UrdfJoints, SphericalAndBallAreAQuaternion) {
  for (const char* type : {"spherical", "ball"}) {
    const Model model = load(one_joint(type, "<origin xyz=\"0 1 0\"/>"));
    ASSERT_EQ(model.n_q(), 4);
    ASSERT_EQ(model.n_v(), 3);
    EXPECT_EQ(model->joints[0].type, JointType::spherical);
    const Pose X = pose_of(model, "body", turned(rotation_from_rpy(0.1, 0.2, 0.3)));
    expect_near(X.R, rotation_from_rpy(0.1, 0.2, 0.3), 4e-16);
    expect_near(X.p, {0, 1, 0});
  }
}

TEST(UrdfJoints, OriginIsFixedAxisRollPitchYaw) {
  const Model model = load(one_joint("fixed", "<origin rpy=\"0.4 -0.5 0.6\" xyz=\"1 2 3\"/>"));
  expect_near(pose_of(model, "body").R, rotation_from_rpy(0.4, -0.5, 0.6), 4e-16);
}

// URDF 1.1; of any length, and at the pole of roll, pitch, yaw.
TEST(UrdfJoints, OriginAsQuaternion) {
  for (const double pitch : {0.5, pi / 2, -pi / 2, 1.5707, -2.0}) {
    const Mat3 R = rotation_from_rpy(0.4, pitch, -2.5);
    const Eigen::Quaterniond q(R);
    std::ostringstream text;
    text.precision(17);
    text << "<origin quat_xyzw=\"" << 3 * q.x() << " " << 3 * q.y() << " " << 3 * q.z() << " "
         << 3 * q.w() << "\"/>";
    expect_near(pose_of(load(one_joint("fixed", text.str())), "body").R, R, 1e-15);
  }
}

TEST(UrdfJoints, LimitsAndDynamicsAreKept) {
  const std::string dynamics = "<dynamics damping=\"0.5\" friction=\"0.25\"/>";
  const Coordinate c = load(one_joint("revolute", limit + dynamics))->coordinates[0];
  EXPECT_EQ(c.lower, -1);
  EXPECT_EQ(c.upper, 2);
  EXPECT_EQ(c.effort, 3);
  EXPECT_EQ(c.velocity, 4);
  EXPECT_EQ(c.damping, 0.5);
  EXPECT_EQ(c.friction, 0.25);
  EXPECT_EQ(c.unit, Unit::radian);
  EXPECT_EQ(load(one_joint("prismatic", limit))->coordinates[0].unit, Unit::metre);
}

TEST(UrdfJoints, LimitsThatAreNotGivenAreInfiniteButPositionsAreZero) {
  const Coordinate none = load(one_joint("continuous"))->coordinates[0];
  EXPECT_EQ(none.lower, -infinity);
  EXPECT_EQ(none.upper, infinity);
  EXPECT_EQ(none.effort, infinity);
  EXPECT_EQ(none.velocity, infinity);
  EXPECT_EQ(none.damping, 0);

  const Coordinate some = load(one_joint("revolute", "<limit effort=\"2\"/>"))->coordinates[0];
  EXPECT_EQ(some.lower, -infinity);  // not the specification's default, 0: nothing would move
  EXPECT_EQ(some.upper, infinity);
  EXPECT_EQ(some.effort, 2);
  EXPECT_EQ(some.velocity, infinity);

  const Coordinate written =
      load(one_joint("revolute", "<limit lower=\"-inf\" upper=\"inf\" effort=\"inf\"/>"))
          ->coordinates[0];
  EXPECT_EQ(written.lower, -infinity);
  EXPECT_EQ(written.upper, infinity);
  EXPECT_EQ(written.effort, infinity);
}

TEST(UrdfJoints, LimitsThatAreCrossedOrMissingAreNoneAndAWarning) {
  for (const std::string bad : {"", "<limit lower=\"2\" upper=\"1\"/>", "<limit effort=\"2\"/>"}) {
    const Model model = load(one_joint("revolute", bad));
    EXPECT_EQ(model->coordinates[0].lower, -infinity);
    EXPECT_EQ(model->coordinates[0].upper, infinity);
    ASSERT_EQ(model->warnings.size(), 1u);
    expect_contains(model->warnings[0], "is read as unlimited");
    expect_error([&] { load(one_joint("revolute", bad), {.strict = true}); }, "joint", "j", {});
  }
}

TEST(UrdfJoints, AMimicJointOfAFixedOneStandsAtItsOffset) {
  const Model model = load(
      robot("<link name=\"base\"/>" + ball_link("a") + ball_link("b") +
            joint("left", "fixed", "base", "a") +
            joint("right", "prismatic", "base", "b",
                  "<axis xyz=\"0 0 1\"/><mimic joint=\"left\" multiplier=\"-2\" offset=\"0.5\"/>" +
                      std::string(limit))));
  EXPECT_EQ(model.n_q(), 0);
  expect_near(pose_of(model, "b").p, {0, 0, 0.5});
  expect_warning(model, {"joint \"right\" mimics joint \"left\", which is fixed", "stands at 0.5"});
}

TEST(UrdfJoints, AContinuousJointHasNoPositionLimits) {
  const Coordinate c = load(one_joint("continuous", limit))->coordinates[0];
  EXPECT_EQ(c.lower, -infinity);
  EXPECT_EQ(c.upper, infinity);
  EXPECT_EQ(c.effort, 3);
}

TEST(UrdfJoints, Urdf12LimitsAndVersionsAreRead) {
  const std::string more =
      "<limit lower=\"-1\" upper=\"2\" acceleration=\"5\" deceleration=\"6\" jerk=\"7\"/>";
  for (const char* version : {"1", "1.0", "1.1", "1.2"}) {
    std::string text = one_joint("prismatic", more);
    text.insert(text.find('>'), " version=\"" + std::string(version) + "\"");
    const Model model = load(text);
    EXPECT_EQ(model->coordinates[0].upper, 2);
    EXPECT_TRUE(model->warnings.empty());
  }
  std::string text = one_joint("continuous");
  text.insert(text.find('>'), " version=\"3.7\"");
  expect_warning(load(text), {"URDF text:1: ", "version \"3.7\""});
}

TEST(UrdfJoints, MimicSharesTheCoordinate) {
  const Model model = load(
      robot("<link name=\"base\"/>" + ball_link("a") + ball_link("b") + ball_link("c") +
            joint("left", "continuous", "base", "a", "<axis xyz=\"0 0 1\"/>") +
            joint("right", "continuous", "base", "b",
                  "<axis xyz=\"0 0 1\"/><mimic joint=\"left\" multiplier=\"-2\" offset=\"0.5\"/>") +
            joint("same", "prismatic", "base", "c",
                  std::string("<axis xyz=\"0 0 1\"/><mimic joint=\"left\"/>") + limit)));
  EXPECT_EQ(model.n_q(), 1);
  const std::map<std::string, double> q = {{"left", 0.3}};
  expect_near(pose_of(model, "b", q).R, turn(-0.1, Vec3::UnitZ()));
  expect_near(pose_of(model, "c", q).p, {0, 0, 0.3});
}

TEST(UrdfJoints, MimicOfAFixedJointIsAWarning) {
  const Model model =
      load(robot("<link name=\"base\"/>" + ball_link("a") + ball_link("b") +
                 joint("left", "continuous", "base", "a") +
                 joint("right", "fixed", "base", "b", "\n<mimic joint=\"left\"/>")));
  EXPECT_EQ(model.n_q(), 1);
  expect_warning(model, {"URDF text:6: joint \"right\" is fixed", "<mimic>"});
}

TEST(UrdfJoints, CoordinatesAreInTheOrderOfTheFile) {
  const Model model = load(robot("<link name=\"base\"/>" + ball_link("z") + ball_link("a") +
                                 ball_link("m") + joint("zulu", "continuous", "base", "z") +
                                 joint("alpha", "continuous", "z", "a", "<origin xyz=\"1 0 0\"/>") +
                                 joint("mike", "continuous", "base", "m")));
  ASSERT_EQ(model.n_q(), 3);
  EXPECT_EQ(model->coordinates[0].name, "zulu");
  EXPECT_EQ(model->coordinates[1].name, "alpha");
  EXPECT_EQ(model->coordinates[2].name, "mike");
}

}  // namespace
}  // namespace saltus
