// Mistakes in a file, and what the reader says of them.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "urdf/urdf_text.hpp"

namespace saltus::test {

// Each case edits this file in one place.
inline constexpr const char* good_file = R"(<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    <collision>
      <geometry><capsule radius="0.1" length="0.5"/></geometry>
    </collision>
  </link>
  <link name="lower">
    <inertial>
      <mass value="2"/>
      <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="10" velocity="1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/>
    <child link="lower"/>
    <origin xyz="0 0 1"/>
    <axis xyz="0 1 0"/>
    <mimic joint="shoulder" multiplier="1"/>
  </joint>
  <saltus>
    <half_space name="floor" normal="0 0 1" offset="-5"/>
    <capsule link="lower" radius="0.1" length="0.2"/>
    <exclude link1="base" link2="lower"/>
  </saltus>
</robot>
)";

/// An edit of that file, and the error that it is to cause.
struct Mistake {
  const char* kind;  ///< name of the test
  const char* from;  ///< replaced by `to`, once
  const char* to;
  int line;                        ///< where the message points
  std::vector<const char*> parts;  ///< that the message contains
  const char* element = "";        ///< of the exception; "": anything
  const char* name = "";
};

inline std::ostream& operator<<(std::ostream& out, const Mistake& mistake) {
  return out << mistake.kind;
}

inline std::string kind(const testing::TestParamInfo<Mistake>& tested) { return tested.param.kind; }

inline std::string edited(const Mistake& mistake) {
  std::string text = good_file;
  const std::size_t at = text.find(mistake.from);
  EXPECT_NE(at, std::string::npos) << mistake.from;
  return text.replace(at, std::string(mistake.from).size(), mistake.to);
}

inline void expect_error(const Mistake& mistake) {
  try {
    read_urdf(edited(mistake), {.strict = true});
    ADD_FAILURE() << "no ModelError";
  } catch (const ModelError& error) {
    const std::string what = error.what();
    const std::string place = "URDF text:" + std::to_string(mistake.line) + ": ";
    EXPECT_EQ(what.rfind(place, 0), 0u) << "not at \"" << place << "\": " << what;
    for (const char* part : mistake.parts) expect_contains(what, part);
    if (*mistake.element != '\0') {
      EXPECT_EQ(error.element, mistake.element);
      EXPECT_EQ(error.name, mistake.name);
    }
  }
}

}  // namespace saltus::test
