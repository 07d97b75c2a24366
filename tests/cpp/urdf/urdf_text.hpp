// Pieces of URDF, and what a model made of them says.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "kit/ask.hpp"
#include "saltus/urdf/load_urdf.hpp"

namespace saltus::test {

inline std::string robot(const std::string& body) {
  return "<robot name=\"r\">\n" + body + "\n</robot>\n";
}

/// A link with mass 2, centre of mass in its origin, a ball's inertia 0.1.
inline std::string ball_link(const std::string& name, const std::string& more = "") {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"2\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" "
         "iyz=\"0\" izz=\"0.1\"/></inertial>" +
         more + "</link>\n";
}

inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + more + "</joint>\n";
}

/// Two links, `base` and `body`, and joint `j` between them.
inline std::string one_joint(const std::string& type, const std::string& more = "",
                             const std::string& in_body = "") {
  return robot("<link name=\"base\"/>\n" + ball_link("body", in_body) +
               joint("j", type, "base", "body", more));
}

inline Model load(const std::string& text, const UrdfOptions& options = {}) {
  return load_urdf(text, options);
}

/// Pose of a link with these coordinates, the others 0.
inline Pose pose_of(const Model& model, const std::string& link,
                    const std::map<std::string, double>& q = {}) {
  return model.X_WL(model.state(q).q, model.link(link));
}

inline void expect_near(const Mat3& value, const Mat3& expected, double tolerance = 1e-15) {
  EXPECT_LE((value - expected).cwiseAbs().maxCoeff(), tolerance) << value << "\ninstead of\n"
                                                                 << expected;
}

inline void expect_near(const Vec3& value, const Vec3& expected, double tolerance = 1e-15) {
  EXPECT_LE((value - expected).cwiseAbs().maxCoeff(), tolerance)
      << value.transpose() << " instead of " << expected.transpose();
}

/// One warning of the model contains all parts.
inline void expect_warning(const Model& model, const std::vector<std::string>& parts) {
  for (const std::string& warning : model->warnings) {
    const auto is_in = [&](const std::string& part) {
      return warning.find(part) != std::string::npos;
    };
    if (std::all_of(parts.begin(), parts.end(), is_in)) return;
  }
  std::string all;
  for (const std::string& warning : model->warnings) all += "\n" + warning;
  ADD_FAILURE() << "no warning with \"" << parts.front() << "\"... in:" << all;
}

}  // namespace saltus::test
