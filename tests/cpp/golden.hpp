// Two systems with reference values of 25 digits: partials of L, and trajectories of the midpoint
// stepper. The data, and where they come from, are in tests/data/golden.json.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "json.hpp"
#include "saltus/model/model_builder.hpp"

namespace saltus::test {

struct GoldenNode {
  int step;
  VecX q, p;
};

struct GoldenTrajectory {
  double h;  ///< [s]
  int steps;
  State start;                    ///< t = 0
  std::vector<GoldenNode> nodes;  ///< every 20 steps, the first and the last among them
};

struct Golden {
  Model model;
  VecX q, v;
  LagrangianPartials L;  ///< at (q, v)
  GoldenTrajectory from_rest, from_state;
};

inline Vec3 golden_axis(char letter) { return Vec3::Unit(letter - 'X'); }

/// A frame becomes a link, and the way from its parent a joint: named after the coordinate, or
/// fixed and named after the frame.
inline JointSpec golden_joint(const Json& frame) {
  const std::string kind = frame[2].text;
  const Json& parameter = frame[3];
  JointSpec joint;
  joint.name = frame[0].text;
  joint.parent = frame[1].text;
  joint.child = frame[0].text;
  joint.type = JointType::fixed;
  if (kind == "SE3") {
    joint.X_PJ = {parameter["R"].matrix(), parameter["p"].vector()};
    return joint;
  }
  joint.axis = golden_axis(kind.at(1));
  if (!parameter.items.empty()) {
    joint.name = parameter[1].text;
    joint.type = kind[0] == 'R' ? JointType::revolute : JointType::prismatic;
  } else if (kind[0] == 'R') {
    joint.X_PJ.R = Eigen::AngleAxisd(parameter.number(), joint.axis).toRotationMatrix();
  } else {
    joint.X_PJ.p = parameter.number() * joint.axis;
  }
  return joint;
}

inline Model golden_model(const Json& system) {
  std::map<std::string, BodyInertia> bodies;
  for (const Json& body : system["bodies"].items) {
    bodies[body["frame"].text] = {body["mass"].number(), body["com"].vector(),
                                  body["inertia_com"].matrix()};
  }
  const std::vector<Json>& frames = system["frames"].items;
  ModelBuilder builder(system["name"].text, frames.at(0)[0].text);
  builder.set_gravity(system["gravity"].vector());
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const std::string& name = frames[i][0].text;
    builder.add_link({name, bodies[name]}).add_joint(golden_joint(frames[i]));
  }
  return builder.build();
}

inline GoldenTrajectory golden_trajectory(const Json& trajectory) {
  GoldenTrajectory out;
  out.h = trajectory["h"].number();
  out.steps = static_cast<int>(trajectory["steps"].number());
  const VecX p0 = trajectory["p0"].vector();
  for (const Json& node : trajectory["ref"].items) {
    out.nodes.push_back({static_cast<int>(node["step"].number()), node["q"].vector(),
                         node.members.count("p") > 0 ? node["p"].vector() : p0});
  }
  out.start = {0, out.nodes.at(0).q, p0};
  return out;
}

/// All systems of the file: a chain of revolute and prismatic joints with skew placements and full
/// inertias, and three pendulums of two revolute joints each.
inline std::vector<Golden> golden_systems() {
  std::vector<Golden> out;
  const Json data = read_json(std::string(SALTUS_TEST_DATA_DIR) + "/golden.json");
  for (const Json& system : data["systems"].items) {
    const Json& ref = system["ref"];
    out.push_back(
        {golden_model(system), system["q"].vector(), system["dq"].vector(),
         LagrangianPartials{ref["L"].number(), ref["L_q"].vector(), ref["L_v"].vector(),
                            ref["L_qq"].matrix(), ref["L_vq"].matrix(), ref["L_vv"].matrix()},
         golden_trajectory(system["trajectory_from_rest"]),
         golden_trajectory(system["trajectory_from_state"])});
  }
  return out;
}

}  // namespace saltus::test
