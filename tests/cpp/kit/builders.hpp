// Short ways to describe small models, for tests.
#pragma once

#include <string>

#include "saltus/model/model_builder.hpp"

namespace saltus::test {

inline JointSpec joint(const std::string& name, JointType type, const std::string& parent,
                       const std::string& child, const Vec3& p = Vec3::Zero(),
                       const Vec3& axis = Vec3::UnitY()) {
  JointSpec spec;
  spec.name = name;
  spec.type = type;
  spec.parent = parent;
  spec.child = child;
  spec.X_PJ.p = p;
  spec.axis = axis;
  return spec;
}

/// A body whose centre of mass and inertia have no symmetry.
inline BodyInertia some_body(double mass = 1) {
  Mat3 I;
  I << 0.3, 0.02, -0.01, 0.02, 0.25, 0.03, -0.01, 0.03, 0.2;
  return {mass, Vec3(0.1, -0.2, 0.15), mass * I};
}

/// world - shoulder - upper - elbow - lower: two revolute joints about y.
inline ModelBuilder arm() {
  ModelBuilder builder("arm");
  builder.add_link({"upper", some_body(2)}).add_link({"lower", some_body(1)});
  builder.add_joint(joint("shoulder", JointType::revolute, "world", "upper", {0, 0, 1}));
  builder.add_joint(joint("elbow", JointType::revolute, "upper", "lower", {0, 0, -0.5}));
  return builder;
}

/// world - free_a - a, world - free_b - b: two balls of radius 0.1 in the air.
inline ModelBuilder two_balls() {
  ModelBuilder builder("balls");
  for (const std::string name : {"a", "b"}) {
    builder.add_link({name, solid_sphere(1, 0.1)});
    builder.add_joint(joint("free_" + name, JointType::floating, "world", name));
    builder.add_shape(name, Sphere{0.1});
  }
  return builder;
}

}  // namespace saltus::test
