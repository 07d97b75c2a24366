// Bodies on floors and slopes with friction, that several tests play with.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scenes.hpp"

namespace saltus::scenes {

inline constexpr double gravity = 9.81;

/// A solid ball of 1 kg that moves in x and z, and turns about y (with the clock as seen from -y:
/// it rolls along +x with a positive angle).
inline Model rolling_ball(double radius, ContactProperties contact, const Vec3& up = Vec3::UnitZ(),
                          bool turns = true) {
  ModelBuilder b("ball");
  b.add_link({"slide", {}});
  b.add_link({"lift", turns ? BodyInertia{} : solid_sphere(1, radius)});
  b.add_joint({.name = "x", .type = JointType::prismatic, .parent = "world", .child = "slide"});
  b.add_joint({.name = "z",
               .type = JointType::prismatic,
               .parent = "slide",
               .child = "lift",
               .axis = Vec3::UnitZ()});
  if (turns) {
    b.add_link({"ball", solid_sphere(1, radius)});
    b.add_joint({.name = "turn",
                 .type = JointType::continuous,
                 .parent = "lift",
                 .child = "ball",
                 .axis = Vec3::UnitY()});
  }
  b.add_shape(turns ? "ball" : "lift", Sphere{radius});
  return b.add_half_space("floor", up).set_default_contact(contact).build();
}

/// A free box of 1 kg, box_<i>, its middle there.
inline void add_free_box(ModelBuilder& b, int i, const Vec3& half, const Vec3& at) {
  const std::string name = "box_" + std::to_string(i);
  b.add_link({name, solid_box(1, half)});
  b.add_joint({.name = name,
               .type = JointType::floating,
               .parent = "world",
               .child = name,
               .X_PJ = {Mat3::Identity(), at}});
  b.add_shape(name, Box{half});
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

inline double energy(const Model& model, const State& state) {
  return model.kinetic_energy(state) + model.potential_energy(state.q);
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

}  // namespace saltus::scenes
