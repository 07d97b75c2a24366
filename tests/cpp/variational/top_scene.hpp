// A body that flies and spins.
#pragma once

#include "saltus/model/model_builder.hpp"

namespace saltus::scenes {

/// A body that flies, moments 1 : 2 : 3, no gravity.
inline Model top(const Vec3& moments = Vec3(1, 2, 3)) {
  BodyInertia body{1, Vec3::Zero(), Mat3::Zero()};
  body.I_J.diagonal() = moments;
  JointSpec joint;
  joint.name = "base";
  joint.type = JointType::floating;
  joint.parent = "world";
  joint.child = "top";
  return ModelBuilder("top")
      .set_gravity(Vec3::Zero())
      .add_link({"top", body})
      .add_joint(joint)
      .build();
}

inline State spinning(const Model& model, const Vec3& w, const Vec3& v = Vec3::Zero()) {
  VecX rates(6);
  rates << v, w;
  return model.state(model.neutral(), rates);
}

}  // namespace saltus::scenes
