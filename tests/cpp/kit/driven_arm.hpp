// An arm with all that drives joints, for tests.
#pragma once

#include "kit/builders.hpp"

namespace saltus::test {

/// Two joints with servos, damping, dry friction and limits.
inline Model driven_arm(double friction) {
  ModelBuilder builder = arm();
  for (const char* joint : {"shoulder", "elbow"}) {
    builder.set_damping(joint, 0.2).set_armature(joint, 0.05).set_friction(joint, friction);
    builder.set_limit(joint, -1, 1, 0.2);
    builder.add_position_servo(joint, joint, 80, 6, 30);
  }
  builder.add_actuator(
      {.name = "belt", .joints = {{"shoulder", 1}, {"elbow", 1}}, .bias_l = -5, .bias_v = -0.5});
  return builder.build();
}

}  // namespace saltus::test
