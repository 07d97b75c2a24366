#include "urdf/schema.hpp"

#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

constexpr bool required = true, positive = true, may_be_infinite = true;

ElementRule origin() {
  return {.name = "origin",
          .occurs = Occurs::at_most_once,
          .numbers = {{"xyz", 3}, {"rpy", 3}, {"quat_xyzw", 4}}};
}

ElementRule inertial() {
  const ElementRule mass = {
      .name = "mass", .occurs = Occurs::at_most_once, .numbers = {{"value", 1, required}}};
  const ElementRule inertia = {.name = "inertia",
                               .occurs = Occurs::at_most_once,
                               .numbers = {{"ixx", 1, required},
                                           {"ixy", 1},
                                           {"ixz", 1},
                                           {"iyy", 1, required},
                                           {"iyz", 1},
                                           {"izz", 1, required}}};
  return {
      .name = "inertial", .occurs = Occurs::at_most_once, .children = {origin(), mass, inertia}};
}

ElementRule geometry() {
  ElementRule rule = {.name = "geometry", .occurs = Occurs::at_most_once};
  for (const ShapeElement& shape : shape_elements()) {
    if (shape.in_geometry) rule.children.push_back({.name = shape.name, .numbers = shape.sizes});
  }
  rule.children.push_back(
      {.name = "mesh", .numbers = {{"scale", 3}}, .texts = {{"filename", required}}});
  return rule;
}

ElementRule link() {
  return {.name = "link",
          .texts = {{"name", required}, {"type"}},
          .children = {inertial(),
                       {.name = "collision",
                        .texts = {{"name"}, {"group"}},
                        .children = {origin(), geometry()},
                        .skipped = {"verbose", "material"}}},
          .skipped = {"visual", "sensor", "contact", "gazebo", "collision_checking",
                      "self_collision_checking"}};
}

ElementRule joint() {
  const auto limit = [](const char* name) {
    return NumberRule{name, 1, !required, !positive, may_be_infinite};
  };
  return {.name = "joint",
          .texts = {{"name", required}, {"type", required}},
          .children =
              {origin(),
               {.name = "parent", .occurs = Occurs::once, .texts = {{"link", required}}},
               {.name = "child", .occurs = Occurs::once, .texts = {{"link", required}}},
               {.name = "axis", .occurs = Occurs::at_most_once, .numbers = {{"xyz", 3, required}}},
               {.name = "limit",
                .occurs = Occurs::at_most_once,
                .numbers = {limit("lower"), limit("upper"), limit("effort"), limit("velocity"),
                            limit("acceleration"), limit("deceleration"), limit("jerk")}},
               {.name = "dynamics",
                .occurs = Occurs::at_most_once,
                .numbers = {{"damping"}, {"friction"}}},
               {.name = "mimic",
                .occurs = Occurs::at_most_once,
                .numbers = {{"multiplier"}, {"offset"}},
                .texts = {{"joint", required}}}},
          .skipped = {"safety_controller", "calibration", "hardwareInterface", "sensor"}};
}

/// What holds and drives joints and links.
std::vector<ElementRule> drive_rules() {
  const NumberRule effort{"effort", 1, !required, positive, may_be_infinite};
  return {
      {.name = "loop",
       .numbers = {{"xyz1", 3}, {"rpy1", 3}, {"xyz2", 3}, {"rpy2", 3}, {"distance"}},
       .texts = {{"name", required}, {"type", required}, {"link1", required}, {"link2", required}},
       .strict = true},
      {.name = "coupling",
       .texts = {{"joint", required}, {"of", required}, {"polynomial", required}},
       .strict = true},
      {.name = "prescribed",
       .texts = {{"joint", required}, {"times", required}, {"values", required}},
       .strict = true},
      {.name = "motor",
       .numbers = {{"gear"}, effort},
       .texts = {{"name", required}, {"joint", required}},
       .strict = true},
      {.name = "position_servo",
       .numbers = {{"kp", 1, required}, {"kd"}, effort},
       .texts = {{"name", required}, {"joint", required}},
       .strict = true},
      {.name = "velocity_servo",
       .numbers = {{"kv", 1, required}, effort},
       .texts = {{"name", required}, {"joint", required}},
       .strict = true},
      {.name = "actuator",
       .numbers =
           {{"gain"}, {"bias", 3}, effort, {"control", 2, !required, !positive, may_be_infinite}},
       .texts = {{"name", required}, {"joints", required}, {"ratios"}},
       .strict = true},
      {.name = "spring",
       .numbers = {{"xyz1", 3}, {"xyz2", 3}, {"stiffness"}, {"length"}, {"damping"}},
       .texts = {{"name", required}, {"link1", required}, {"link2", required}},
       .strict = true},
      {.name = "gravity_compensation",
       .numbers = {{"part"}},
       .texts = {{"link", required}},
       .strict = true},
      {.name = "joint",
       .numbers = {{"armature"},
                   {"damping"},
                   {"friction"},
                   {"stiffness"},
                   {"rest"},
                   {"slopes", 2},
                   {"limit_restitution"}},
       .texts = {{"name", required}, {"angles"}, {"forces"}},
       .strict = true}};
}

ElementRule extension() {
  std::vector<ElementRule> children = {{.name = "half_space",
                                        .numbers = {{"normal", 3}, {"offset"}},
                                        .texts = {{"name"}},
                                        .strict = true}};
  for (const ShapeElement& shape : shape_elements()) {
    if (!shape.in_block) continue;
    children.push_back({.name = shape.name,
                        .numbers = shape.sizes,
                        .texts = {{"link", required}},
                        .children = {origin()},
                        .strict = true});
  }
  const std::vector<ElementRule> others = {
      {.name = "mesh", .texts = {{"link", required}, {"use", required}}, .strict = true},
      {.name = "exclude", .texts = {{"link1"}, {"link2"}, {"group1"}, {"group2"}}, .strict = true},
      {.name = "group", .texts = {{"name", required}, {"links", required}}, .strict = true},
      {.name = "material", .texts = {{"name", required}, {"links", required}}, .strict = true},
      {.name = "contact",
       .numbers = {{"restitution"}, {"friction"}},
       .texts = {{"material1"}, {"material2"}},
       .strict = true},
      {.name = "adjacent_links", .texts = {{"gaps", required}}, .strict = true}};
  const std::vector<ElementRule> drives = drive_rules();
  for (const auto* each : {&others, &drives}) {
    children.insert(children.end(), each->begin(), each->end());
  }
  return {.name = "saltus", .children = children, .strict = true};
}

}  // namespace

const ElementRule* ElementRule::child(const std::string& child_name) const {
  for (const ElementRule& rule : children) {
    if (rule.name == child_name) return &rule;
  }
  return nullptr;
}

std::vector<std::string> ElementRule::attribute_names() const {
  std::vector<std::string> names;
  for (const TextRule& text : texts) names.push_back(text.name);
  for (const NumberRule& number : numbers) names.push_back(number.name);
  return names;
}

std::vector<std::string> ElementRule::child_names() const {
  std::vector<std::string> names;
  for (const ElementRule& rule : children) names.push_back(rule.name);
  names.insert(names.end(), skipped.begin(), skipped.end());
  return names;
}

const ElementRule& schema() {
  static const ElementRule robot = {
      .name = "robot",
      .texts = {{"name"}, {"version"}},
      .children = {link(), joint(), extension()},
      .skipped = {"material", "gazebo", "transmission", "sensor", "ros2_control", "mujoco"}};
  return robot;
}

}  // namespace saltus::reader
