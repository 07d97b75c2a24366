// Models that several tests play with.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "saltus/saltus.hpp"

namespace saltus::scenes {

/// How far q is from the neutral configuration along one velocity, of a ball the turn about an axis.
inline double moved(const Model& model, const VecX& q, const std::string& velocity) {
  return model.difference(model.neutral(), q)[model.velocity_index(velocity)];
}

/// The most that q is from the neutral configuration.
inline double farthest(const Model& model, const VecX& q) {
  return model.difference(model.neutral(), q).cwiseAbs().maxCoeff();
}

/// The angle between -pi and pi that differs from `angle` by whole turns.
inline double within_a_turn(double angle) { return std::remainder(angle, 2 * std::acos(-1.0)); }

struct Cradle {
  int balls = 3;
  double gap = 0;
  std::vector<double> masses = {};  ///< 1 kg each if empty
  bool sways = true;                ///< spherical pendulums: swing about y, then sway about x
};

/// Solid spheres r = 0.05 on pendulums of 1 m, pivots along x so that they hang `gap` apart.
inline Model cradle(const Cradle& c) {
  ModelBuilder b("cradle");
  for (int i = 0; i < c.balls; ++i) {
    const std::string k = std::to_string(i);
    const double mass = c.masses.empty() ? 1.0 : c.masses[i];
    BodyInertia ball = solid_sphere(mass, 0.05);
    ball.c_J = Vec3(0, 0, -1);
    b.add_link({"ball_" + k, ball});
    if (c.sways) b.add_link({"gimbal_" + k, {}});
    b.add_joint({.name = "swing_" + k,
                 .parent = "world",
                 .child = (c.sways ? "gimbal_" : "ball_") + k,
                 .X_PJ = {Mat3::Identity(), Vec3(i * (0.1 + c.gap), 0, 0)},
                 .axis = Vec3::UnitY()});
    if (c.sways) {
      b.add_joint({.name = "sway_" + k, .parent = "gimbal_" + k, .child = "ball_" + k});
    }
    b.add_shape("ball_" + k, Sphere{0.05}, {Mat3::Identity(), Vec3(0, 0, -1)});
  }
  return b.build();
}

/// A ball that slides along one axis of the world; joint and link are named `name`.
inline void add_bead(ModelBuilder& b, const std::string& name, const Vec3& start, const Vec3& axis,
                     double mass, double radius) {
  b.add_link({name, solid_sphere(mass, radius)});
  b.add_joint({.name = name,
               .type = JointType::prismatic,
               .parent = "world",
               .child = name,
               .X_PJ = {Mat3::Identity(), start},
               .axis = axis});
  b.add_shape(name, Sphere{radius});
}

/// Balls of radius 0.05 and mass 1 on the x axis, touching, without gravity.
inline Model beads_in_line(int balls) {
  ModelBuilder b("beads");
  b.set_gravity(Vec3::Zero());
  for (int i = 0; i < balls; ++i) {
    add_bead(b, "x_" + std::to_string(i), Vec3(0.1 * i, 0, 0), Vec3::UnitX(), 1, 0.05);
  }
  return b.build();
}

/// A ball above the floor z = 0; coordinate "height" is its centre's.
inline Model bouncing_ball(double radius = 0.1) {
  ModelBuilder b("ball");
  add_bead(b, "height", Vec3::Zero(), Vec3::UnitZ(), 1, radius);
  b.add_half_space("floor", Vec3::UnitZ());
  return b.build();
}

/// Discs (spheres that slide in x and y) of radius 0.5, without gravity: billiards.
inline Model discs(const std::vector<Vec3>& centers, const std::vector<double>& masses) {
  ModelBuilder b("discs");
  b.set_gravity(Vec3::Zero());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const std::string k = std::to_string(i);
    b.add_link({"slide_" + k, {}});
    b.add_link({"disc_" + k, solid_sphere(masses[i], 0.5)});
    b.add_joint({.name = "x_" + k,
                 .type = JointType::prismatic,
                 .parent = "world",
                 .child = "slide_" + k,
                 .X_PJ = {Mat3::Identity(), centers[i]},
                 .axis = Vec3::UnitX()});
    b.add_joint({.name = "y_" + k,
                 .type = JointType::prismatic,
                 .parent = "slide_" + k,
                 .child = "disc_" + k,
                 .axis = Vec3::UnitY()});
    b.add_shape("disc_" + k, Sphere{0.5});
  }
  return b.build();
}

}  // namespace saltus::scenes
