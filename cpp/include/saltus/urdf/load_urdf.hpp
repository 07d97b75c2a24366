// URDF to ModelBuilder.
//
// urdfdom parses; what it lets pass (negative mass, zero axis, unknown mimic, duplicate names) is
// checked here and in ModelBuilder, with file and line. Beyond URDF:
//   * joints of type "spherical" or "ball" are three revolutes (yaw, pitch, roll);
//   * a block `<saltus>` below `<robot>`, which other readers skip:
//       <half_space name="floor" normal="0 0 1" offset="0"/>
//       <capsule link="arm" radius="0.03" length="0.3"> <origin xyz="0 0 0" rpy="0 0 0"/> </capsule>
//       <exclude link1="a" link2="b"/>
//   * `<capsule radius length>` inside `<geometry>`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saltus/model/model_builder.hpp"

namespace saltus {

struct UrdfOptions {
  Vec3 gravity = Vec3(0, 0, -9.81);           ///< [m/s^2]
  std::vector<std::string> package_dirs = {}; ///< where `package://name/...` is looked up
  /// How the root link hangs on the world: fixed, or by a joint named "root" (floating, planar, ...)
  JointType root_joint = JointType::fixed;
};

/// Reads a URDF file, or URDF text where the argument begins with '<' (after white space).
/// @throws ModelError with file:line where known, element and name.
SALTUS_EXPORT ModelBuilder load_urdf(const std::string& path_or_text,
                                     const UrdfOptions& options = {});

}  // namespace saltus
