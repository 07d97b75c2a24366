// Models that several tests play with: beads, pendulums, balls and boxes on floors and slopes.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "saltus/saltus.hpp"

namespace saltus::scenes {

inline constexpr double gravity = 9.81;

/// How far q is from the neutral configuration along one velocity, of a ball the turn about an
/// axis.
inline double moved(const Model& model, const VecX& q, const std::string& velocity) {
  return model.difference(model.neutral(), q)[model.velocity_index(velocity)];
}

/// The most that q is from the neutral configuration.
inline double farthest(const Model& model, const VecX& q) {
  return model.difference(model.neutral(), q).cwiseAbs().maxCoeff();
}

/// The angle between -pi and pi that differs from `angle` by whole turns.
inline double within_a_turn(double angle) { return std::remainder(angle, 2 * std::acos(-1.0)); }

inline double energy(const Model& model, const State& state) {
  return model.kinetic_energy(state) + model.potential_energy(state.q);
}

/// Names of the pairs that are within 1e-9 m of touching.
inline std::set<std::string> touching(const Model& model, const VecX& q) {
  std::set<std::string> names;
  const Gaps gaps = model.gaps(q);
  for (int k = 0; k < gaps.phi.size(); ++k) {
    if (std::abs(gaps.phi[k]) < 1e-9) names.insert(gaps.names[static_cast<std::size_t>(k)]);
  }
  return names;
}

/// Steps for `duration`, and expects that no step gains energy. @return the state then
inline State run_losing_energy(const Model& model, State state, double duration, double h,
                               double tolerance = 1e-11) {
  Stepper stepper(model, {.h = h});
  const int steps = static_cast<int>(std::lround(duration / h));
  double before = energy(model, state);
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const double after = energy(model, state);
    EXPECT_LE(after, before + tolerance) << "t = " << state.t;
    before = after;
  }
  return state;
}

/// A ball that slides along one axis of the world; joint and link are named `name`.
inline void add_bead(ModelBuilder& b, const std::string& name, const Vec3& start, const Vec3& axis,
                     double mass, double radius) {
  b.add_body({.name = name,
              .shape = Sphere{radius},
              .mass = mass,
              .X = {Mat3::Identity(), start},
              .joint = JointType::prismatic,
              .axis = axis});
}

/// Beads x_0, x_1, ... of 1 kg and radius 0.05 on the x axis, `apart` from middle to middle,
/// without gravity.
inline Model beads_in_line(int balls, double apart = 0.1, ContactProperties contact = {1, 0}) {
  ModelBuilder b("beads");
  b.set_gravity(Vec3::Zero()).set_default_contact(contact);
  for (int i = 0; i < balls; ++i) {
    add_bead(b, "x_" + std::to_string(i), Vec3(apart * i, 0, 0), Vec3::UnitX(), 1, 0.05);
  }
  return b.build();
}

/// A bead of 1 kg above the floor z = 0; coordinate "height" is its middle's.
inline Model bouncing_ball(ContactProperties contact = {1, 0}, double radius = 0.1) {
  ModelBuilder b("ball");
  add_bead(b, "height", Vec3::Zero(), Vec3::UnitZ(), 1, radius);
  return b.add_half_space("floor", Vec3::UnitZ()).set_default_contact(contact).build();
}

/// A ball that slides in x and z: links slide<of>, ball<of>, joints x<of>, z<of>. Or in x and y:
/// disc<of>, y<of>.
inline void add_slider(ModelBuilder& b, double radius, const std::string& of = "",
                       const Vec3& start = Vec3::Zero(), double mass = 1, bool is_disc = false) {
  b.add_link({"slide" + of, {}});
  b.add_joint({.name = "x" + of,
               .type = JointType::prismatic,
               .parent = "world",
               .child = "slide" + of,
               .X_PJ = {Mat3::Identity(), start}});
  b.add_body({.name = (is_disc ? "disc" : "ball") + of,
              .shape = Sphere{radius},
              .mass = mass,
              .joint = JointType::prismatic,
              .joint_name = (is_disc ? "y" : "z") + of,
              .parent = "slide" + of,
              .axis = is_disc ? Vec3::UnitY() : Vec3::UnitZ()});
}

/// Discs (spheres that slide in x and y) of radius 0.5, without gravity: billiards.
inline Model discs(const std::vector<Vec3>& centers, const std::vector<double>& masses) {
  ModelBuilder b("discs");
  b.set_gravity(Vec3::Zero());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    add_slider(b, 0.5, "_" + std::to_string(i), centers[i], masses[i], true);
  }
  return b.build();
}

/// A ball of 1 kg that moves in x and z, and turns about y (with the clock as seen from -y: it
/// rolls along +x with a positive angle).
inline Model rolling_ball(double radius, ContactProperties contact, const Vec3& up = Vec3::UnitZ(),
                          bool turns = true) {
  ModelBuilder b("ball");
  if (turns) {
    b.add_link({"slide", {}}).add_link({"lift", {}});
    b.add_joint({.name = "x", .type = JointType::prismatic, .parent = "world", .child = "slide"});
    b.add_joint({.name = "z",
                 .type = JointType::prismatic,
                 .parent = "slide",
                 .child = "lift",
                 .axis = Vec3::UnitZ()});
    b.add_body({.name = "ball",
                .shape = Sphere{radius},
                .mass = 1,
                .joint = JointType::continuous,
                .joint_name = "turn",
                .parent = "lift",
                .axis = Vec3::UnitY()});
  } else {
    add_slider(b, radius);
  }
  return b.add_half_space("floor", up).set_default_contact(contact).build();
}

/// A solid sphere r = 0.05 on a weightless rod, its middle `length` below the joint's frame.
struct Pendulum {
  std::string link, joint;
  Pose pivot = {};
  double length = 1, mass = 1;
  std::string parent = "world";
  std::string sway = {};  ///< name of a second joint, about x, after the one about y
};

inline void add_pendulum(ModelBuilder& b, const Pendulum& p) {
  BodyInertia bob = solid_sphere(p.mass, 0.05);
  bob.c_J = Vec3(0, 0, -p.length);
  b.add_link({p.link, bob});
  const std::string first = p.sway.empty() ? p.link : p.link + "_gimbal";
  if (!p.sway.empty()) b.add_link({first, {}});
  b.add_joint({.name = p.joint,
               .parent = p.parent,
               .child = first,
               .X_PJ = p.pivot,
               .axis = Vec3::UnitY()});
  if (!p.sway.empty()) b.add_joint({.name = p.sway, .parent = first, .child = p.link});
  b.add_shape(p.link, Sphere{0.05}, {Mat3::Identity(), bob.c_J});
}

struct Cradle {
  int balls = 3;
  double gap = 0;
  std::vector<double> masses = {};  ///< 1 kg each if empty
  bool sways = true;                ///< spherical pendulums: swing about y, then sway about x
  Pose at = {};                     ///< of the row; gravity turns with it
  ContactProperties contact = {1, 0};
};

/// Pendulums of 1 m, pivots along x so that they hang `gap` apart.
inline Model cradle(const Cradle& c) {
  ModelBuilder b("cradle");
  b.set_gravity(c.at.R * Vec3(0, 0, -gravity)).set_default_contact(c.contact);
  for (int i = 0; i < c.balls; ++i) {
    const std::string k = std::to_string(i);
    add_pendulum(b, {.link = "ball_" + k,
                     .joint = "swing_" + k,
                     .pivot = {c.at.R, c.at.R * Vec3(i * (0.1 + c.gap), 0, 0) + c.at.p},
                     .mass = c.masses.empty() ? 1.0 : c.masses[i],
                     .sway = c.sways ? "sway_" + k : ""});
  }
  return b.build();
}

/// A free box of 1 kg, box_<i>, its middle there.
inline void add_free_box(ModelBuilder& b, int i, const Vec3& half, const Vec3& at) {
  b.add_body({.name = "box_" + std::to_string(i),
              .shape = Box{half},
              .mass = 1,
              .X = {Mat3::Identity(), at}});
}

/// Free boxes, one on the other, on a floor that gravity is tilted against by `angle`: as on a
/// slope that falls towards +x.
/// @param lift [m] of the lowest above the floor
/// @param floor_friction of the floor, if it is not that of the boxes
inline Model boxes_on_slope(int boxes, const Vec3& half, double angle, ContactProperties contact,
                            double lift = 0, double floor_friction = -1) {
  ModelBuilder b("boxes");
  for (int i = 0; i < boxes; ++i) {
    add_free_box(b, i, half, Vec3(0, 0, lift + (2 * i + 1) * half.z()));
  }
  b.set_gravity(gravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
  b.add_half_space("floor", Vec3::UnitZ()).set_default_contact(contact);
  if (floor_friction >= 0) {
    b.set_material("box_0", "smooth");
    b.set_contact("smooth", "ground", {contact.restitution, floor_friction});
    b.set_material("world", "ground");
  }
  return b.build();
}

/// Rows of free boxes, each box on two of the row below, 1 cm apart.
inline Model pyramid(const std::vector<int>& rows, const Vec3& half, ContactProperties contact,
                     double lift = 0) {
  ModelBuilder b("pyramid");
  int count = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double z = lift + (2 * static_cast<double>(k) + 1) * half.z();
    for (int i = 0; i < rows[k]; ++i) {
      const double x = (i - (rows[k] - 1) / 2.0) * (2 * half.x() + 0.01);
      add_free_box(b, count++, half, Vec3(x, 0, z));
    }
  }
  return b.add_half_space("floor", Vec3::UnitZ()).set_default_contact(contact).build();
}

/// A body that flies, moments 1 : 2 : 3, no gravity.
inline Model top(const Vec3& moments = Vec3(1, 2, 3)) {
  BodyInertia body{1, Vec3::Zero(), Mat3::Zero()};
  body.I_J.diagonal() = moments;
  ModelBuilder b("top");
  b.set_gravity(Vec3::Zero()).add_link({"top", body});
  b.add_joint({.name = "base", .type = JointType::floating, .parent = "world", .child = "top"});
  return b.build();
}

inline State spinning(const Model& model, const Vec3& w, const Vec3& v = Vec3::Zero()) {
  VecX rates(6);
  rates << v, w;
  return model.state(model.neutral(), rates);
}

}  // namespace saltus::scenes
