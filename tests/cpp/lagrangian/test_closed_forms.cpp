// Systems whose Lagrangian fits on a line: pendulum, double pendulum, cart and pole, screw, free
// body.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/random_trees.hpp"
#include "numeric.hpp"
#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

using std::cos, std::sin;

constexpr double g = 9.81;
constexpr double rounding = 1e-14;  // a dozen products of numbers up to 30

const Joint revolute{Joint::Kind::revolute, 0};
const Joint prismatic{Joint::Kind::prismatic, 0};

/// Turns about y; down is -z. The joint's own z axis is the world's y.
const Mat3 to_y = rotation_z_to(Vec3::UnitY());

/// Centre of mass at distance l below a joint that turns about y, inertia I about that axis.
BodyInertia bob(double mass, double l, double I) {
  const Vec3 c = to_y.transpose() * Vec3(0, 0, -l);
  return {mass, c, Vec3(I, I, I).asDiagonal()};
}

TEST(ClosedForm, Pendulum) {
  const double m = 1.3, l = 0.7, I = 0.2, q = 0.6, v = -1.7;
  Tree tree;
  add_joint(tree, -1, revolute, {to_y, {0.4, 0.1, 2}}, {0, 1, 0});
  const MassModel mass{{bob(m, l, I)}};
  const LagrangianPartials L = lagrangian(tree, mass, VecX::Constant(1, q), VecX::Constant(1, v));
  const double inertia = I + m * l * l;
  EXPECT_NEAR(L.value, inertia * v * v / 2 - m * g * (2 - l * cos(q)), rounding);
  EXPECT_NEAR(L.L_q[0], -m * g * l * sin(q), rounding);
  EXPECT_NEAR(L.L_v[0], inertia * v, rounding);
  EXPECT_NEAR(L.L_qq(0, 0), -m * g * l * cos(q), rounding);
  EXPECT_NEAR(L.L_vq(0, 0), 0, rounding);
  EXPECT_NEAR(L.L_vv(0, 0), inertia, rounding);
}

// The second angle is relative: theta_2 = q_1 + q_2.
TEST(ClosedForm, DoublePendulum) {
  const double m1 = 1.1, m2 = 0.6, l1 = 0.8, l2 = 0.5;
  const double q1 = 0.4, q2 = -1.1, v1 = 1.5, v2 = 0.9;
  Tree tree;
  add_joint(tree, -1, revolute, {to_y, {0, 0, 0}}, {0, 1, 0});
  add_joint(tree, 0, revolute, {Mat3::Identity(), to_y.transpose() * Vec3(0, 0, -l1)}, {1, 1, 0});
  const MassModel mass{{bob(m1, l1, 0), bob(m2, l2, 0)}};
  const Eigen::Vector2d q(q1, q2), v(v1, v2);
  const LagrangianPartials L = lagrangian(tree, mass, q, v);
  const double M22 = m2 * l2 * l2, c = m2 * l1 * l2 * cos(q2), s = m2 * l1 * l2 * sin(q2);
  const double M11 = (m1 + m2) * l1 * l1 + M22 + 2 * c, M12 = M22 + c;
  EXPECT_NEAR(L.L_vv(0, 0), M11, rounding);
  EXPECT_NEAR(L.L_vv(0, 1), M12, rounding);
  EXPECT_NEAR(L.L_vv(1, 1), M22, rounding);
  const double V = -(m1 + m2) * g * l1 * cos(q1) - m2 * g * l2 * cos(q1 + q2);
  EXPECT_NEAR(L.value, (M11 * v1 * v1 + 2 * M12 * v1 * v2 + M22 * v2 * v2) / 2 - V, 2 * rounding);
  EXPECT_NEAR(L.L_q[0], -(m1 + m2) * g * l1 * sin(q1) - m2 * g * l2 * sin(q1 + q2), rounding);
  EXPECT_NEAR(L.L_q[1], -s * (v1 * v1 + v1 * v2) - m2 * g * l2 * sin(q1 + q2), rounding);
  EXPECT_NEAR(L.L_vq(0, 1), -s * (2 * v1 + v2), rounding);
  EXPECT_NEAR(L.L_vq(1, 1), -s * v1, rounding);
  EXPECT_NEAR(L.L_vq(1, 0), 0, rounding);
  EXPECT_NEAR(L.L_qq(1, 1), -c * (v1 * v1 + v1 * v2) - m2 * g * l2 * cos(q1 + q2), rounding);
  EXPECT_NEAR(L.L_qq(0, 1), -m2 * g * l2 * cos(q1 + q2), rounding);
}

// The pole hangs at q_2 = 0 and swings towards -x, as a turn about y does.
TEST(ClosedForm, CartAndPole) {
  const double m1 = 2, m2 = 0.3, l = 0.6, I = 0.05, q2 = 0.9, v1 = -0.8, v2 = 2.1;
  Tree tree;
  const Mat3 to_x = rotation_z_to(Vec3::UnitX());
  add_joint(tree, -1, prismatic, {to_x, {0, 0, 0}}, {0, 1, 0});
  add_joint(tree, 0, revolute, {to_x.transpose() * to_y, {0, 0, 0}}, {1, 1, 0});
  const MassModel mass{{{m1, Vec3::Zero(), Mat3::Zero()}, bob(m2, l, I)}};
  const LagrangianPartials L =
      lagrangian(tree, mass, Eigen::Vector2d(5, q2), Eigen::Vector2d(v1, v2));
  EXPECT_NEAR(L.L_vv(0, 0), m1 + m2, rounding);
  EXPECT_NEAR(L.L_vv(0, 1), -m2 * l * cos(q2), rounding);
  EXPECT_NEAR(L.L_vv(1, 1), I + m2 * l * l, rounding);
  EXPECT_NEAR(L.L_q[0], 0, rounding);
  EXPECT_NEAR(L.L_q[1], m2 * l * v1 * v2 * sin(q2) - m2 * g * l * sin(q2), rounding);
  EXPECT_NEAR(L.L_vq(0, 1), m2 * l * v2 * sin(q2), rounding);
  EXPECT_NEAR(L.L_vq(1, 1), m2 * l * v1 * sin(q2), rounding);
  EXPECT_NEAR(L.L_qq(1, 1), m2 * l * cos(q2) * (v1 * v2 - g), rounding);
}

TEST(ClosedForm, ScrewOnAVerticalAxis) {
  const double m = 1.5, I = 0.3, pitch = 0.2, q = 4, v = 3;
  Tree tree;
  add_joint(tree, -1, {Joint::Kind::helical, pitch}, {}, {0, 1, 0});
  const MassModel mass{{{m, Vec3::Zero(), Vec3(I, I, I).asDiagonal()}}};
  const LagrangianPartials L = lagrangian(tree, mass, VecX::Constant(1, q), VecX::Constant(1, v));
  EXPECT_NEAR(L.L_vv(0, 0), I + m * pitch * pitch, rounding);
  EXPECT_NEAR(L.L_q[0], -m * g * pitch, rounding);
  EXPECT_NEAR(L.L_qq(0, 0), 0, rounding);
  EXPECT_NEAR(L.value, (I + m * pitch * pitch) * v * v / 2 - m * g * pitch * q, 3 * rounding);
}

/// x, y, z, then yaw, pitch, roll.
Tree free_body() {
  const Mat3 to_x = rotation_z_to(Vec3::UnitX());
  Tree tree;
  Mat3 last = Mat3::Identity();
  const Mat3 axes[] = {to_x, to_y, Mat3::Identity(), Mat3::Identity(), to_y, to_x};
  for (int k = 0; k < 6; ++k) {
    add_joint(tree, k - 1, k < 3 ? prismatic : revolute, {last.transpose() * axes[k], Vec3::Zero()},
              {k, 1, 0});
    last = axes[k];
  }
  return tree;
}

// T = m c'^2 / 2 + w.I w / 2 with w from the rates of yaw, pitch and roll by the textbook.
TEST(ClosedForm, FreeBody) {
  const Tree tree = free_body();
  const Mat3 to_x = rotation_z_to(Vec3::UnitX());
  test::Random random(1);
  for (int k = 0; k < 20; ++k) {
    const BodyInertia body = random.body();  // axes of the body at zero angles are the world's
    MassModel mass;
    mass.body.resize(6);
    mass.body[5] = transform({to_x.transpose(), Vec3::Zero()}, body);
    const VecX q = random.vector(6, 1.4), v = random.vector(6, 2);
    const double yaw = q[3], pitch = q[4];
    const Mat3 R = rotation_from_rpy(q[5], pitch, yaw);
    const Vec3 w = v[3] * Vec3::UnitZ() + v[4] * Vec3(-sin(yaw), cos(yaw), 0) +
                   v[5] * Vec3(cos(yaw) * cos(pitch), sin(yaw) * cos(pitch), -sin(pitch));
    const Vec3 c = R * body.c_J, dc = Vec3(v.head(3)) + w.cross(c);
    const Mat3 I = R * body.I_J * R.transpose();
    const LagrangianPartials L = lagrangian(tree, mass, q, v);
    const double V = body.mass * g * (q[2] + c[2]);
    EXPECT_NEAR(L.value, body.mass * dc.squaredNorm() / 2 + w.dot(I * w) / 2 - V, 10 * rounding);
    // momenta: linear, and moment of momentum about the body's origin along the three axes
    const Vec3 p = body.mass * dc, moment = I * w + c.cross(p);
    EXPECT_LT((L.L_v.head(3) - p).norm(), 10 * rounding);
    EXPECT_NEAR(L.L_v[3], moment[2], 10 * rounding);
    EXPECT_NEAR(L.L_v[5], moment.dot(R.col(0)), 10 * rounding);
    // moving the scene changes the height alone; yaw turns w and c, not the velocity
    const double L_yaw = body.mass * v.head<3>().dot(Vec3::UnitZ().cross(w.cross(c)));
    EXPECT_LT((L.L_q.head<4>() - Eigen::Vector4d(0, 0, -body.mass * g, L_yaw)).norm(),
              20 * rounding);
    // a free body's acceleration at rest is gravity's, whatever its mass and place
    const LagrangianPartials still = lagrangian(tree, mass, q, VecX::Zero(6));
    const VecX a = still.L_vv.ldlt().solve(still.L_q);
    VecX fall = VecX::Zero(6);
    fall[2] = -g;
    EXPECT_LT((a - fall).norm(), 1e-12);  // condition of M near pitch = 1.4
  }
}

}  // namespace
}  // namespace saltus
