// Trees with free and ball joints with reference values of 20 digits. The data, and where they come
// from, are in tests/data/lie.json.
#pragma once

#include <string>
#include <vector>

#include "json.hpp"
#include "saltus/model/model_builder.hpp"

namespace saltus::test {

struct GoldenRow {
  int step;
  VecX q, v, p;
  double energy;
  Vec3 linear_momentum, angular_momentum;  ///< of the whole, about the world's origin
};

struct GoldenBalls {
  Model model;
  std::vector<GoldenRow> rows;
};

inline Model golden_ball_model(const Json& system) {
  const std::vector<Json>& joints = system["joints"].items;
  ModelBuilder builder(system["name"].text);
  builder.set_gravity(system["gravity"].vector());
  for (const Json& joint : joints) {
    const std::string type = joint["type"].text;
    const int parent = static_cast<int>(joint["parent"].number());
    JointSpec spec;
    spec.name = joint["name"].text;
    spec.child = spec.name + "_link";
    spec.parent =
        parent < 0 ? "world" : joints[static_cast<std::size_t>(parent)]["name"].text + "_link";
    spec.type = type == "free"        ? JointType::floating
                : type == "ball"      ? JointType::spherical
                : type == "prismatic" ? JointType::prismatic
                                      : JointType::revolute;
    if (joint.members.count("axis") > 0) spec.axis = joint["axis"].vector();
    if (joint.members.count("xyz") > 0) spec.X_PJ.p = joint["xyz"].vector();
    if (joint.members.count("quat") > 0) {
      const VecX x = joint["quat"].vector();
      spec.X_PJ.R = Quaternion(x[3], x[0], x[1], x[2]).normalized().toRotationMatrix();
    }
    builder.add_link({spec.child,
                      {joint["mass"].number(), joint["com"].vector(), joint["inertia"].matrix()}});
    builder.add_joint(spec);
  }
  return builder.build();
}

inline std::vector<GoldenBalls> golden_balls() {
  std::vector<GoldenBalls> out;
  const Json data = read_json(std::string(SALTUS_TEST_DATA_DIR) + "/lie.json");
  for (const Json& system : data["systems"].items) {
    GoldenBalls golden{golden_ball_model(system), {}};
    for (const Json& row : system["rows"].items) {
      golden.rows.push_back({static_cast<int>(row["step"].number()), row["q"].vector(),
                             row["v"].vector(), row["p"].vector(), row["energy"].number(),
                             row["linear_momentum"].vector(), row["angular_momentum"].vector()});
    }
    out.push_back(std::move(golden));
  }
  return out;
}

}  // namespace saltus::test
