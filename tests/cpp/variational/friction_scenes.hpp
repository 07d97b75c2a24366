// Bodies on floors and slopes with friction, that several tests play with.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

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

/// Free boxes of 1 kg, one on the other, on a floor that gravity is tilted against by `angle`: as
/// on a slope that falls towards +x.
inline Model boxes_on_slope(int boxes, const Vec3& half, double angle, ContactProperties contact) {
  ModelBuilder b("boxes");
  for (int i = 0; i < boxes; ++i) {
    const std::string name = "box_" + std::to_string(i);
    b.add_link({name, solid_box(1, half)});
    b.add_joint({.name = name,
                 .type = JointType::floating,
                 .parent = "world",
                 .child = name,
                 .X_PJ = {Mat3::Identity(), Vec3(0, 0, (2 * i + 1) * half.z())}});
    b.add_shape(name, Box{half});
  }
  b.set_gravity(gravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
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
