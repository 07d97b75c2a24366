// Sensors of a builder: what they are of must be there.
#include "saltus/model/sensor.hpp"

#include "model/assembly.hpp"
#include "model/shape_checks.hpp"

namespace saltus {
namespace {

bool is_of_contacts(SensorKind kind) {
  return kind == SensorKind::touch || kind == SensorKind::contactforce;
}

/// Whether the sensor is at a point of a link.
bool has_place(SensorKind kind) { return sensor_element(kind) == "link" && !is_of_contacts(kind); }

void check_placement(const SensorSpec& sensor) {
  const Pose& X = sensor.X_LS;
  if (has_place(sensor.kind) || (X.R == Mat3::Identity() && X.p == Vec3::Zero())) return;
  throw ModelError("sensor " + quoted(sensor.name) +
                       " is given a pose, which only sensors at a point of a link have",
                   "sensor", sensor.name);
}

template <class Items>
void check_of(const Items& items, const SensorSpec& sensor, const std::string& element,
              const std::string& name) {
  std::vector<std::string> names;
  for (const auto& item : items) {
    if (item.name == name) return;
    names.push_back(item.name);
  }
  throw ModelError("sensor " + quoted(sensor.name) + " is of " + element + " " + quoted(name) +
                       ", which does not exist; " + element + "s are " + list_names(names),
                   "sensor", sensor.name);
}

void check_moves(const std::vector<JointSpec>& joints, const SensorSpec& sensor) {
  for (const JointSpec& joint : joints) {
    if (joint.name != sensor.of || joint.type != JointType::fixed) continue;
    throw ModelError(
        "sensor " + quoted(sensor.name) + " is of joint " + quoted(sensor.of) + ", which is fixed",
        "sensor", sensor.name);
  }
}

void check_other(const ModelDescription& d, const SensorSpec& sensor) {
  if (sensor.other.empty()) return;
  const auto fail = [&](const std::string& what) {
    throw ModelError("sensor " + quoted(sensor.name) + " " + what, "sensor", sensor.name);
  };
  if (!is_of_contacts(sensor.kind)) {
    fail("is given " + quoted(sensor.other) +
         " to touch, which only touch and contactforce sensors take");
  }
  std::vector<std::string> names;
  for (const LinkSpec& link : d.links) names.push_back(link.name);
  for (const ShapeSpec& shape : d.shapes) {
    if (!shape.name.empty()) names.push_back(shape.name);
  }
  for (const std::string& name : names) {
    if (name == sensor.other) return;
  }
  fail("is of contacts with " + quoted(sensor.other) +
       ", which does not exist; links and half-spaces are " + list_names(names));
}

}  // namespace

std::string sensor_element(SensorKind kind) {
  if (kind == SensorKind::jointpos || kind == SensorKind::jointvel) return "joint";
  return kind == SensorKind::actuatorfrc ? "actuator" : "link";
}

ModelBuilder& ModelBuilder::add_sensor(const SensorSpec& given) {
  if (given.name.empty()) throw ModelError("a sensor has no name", "sensor", "");
  for (const SensorSpec& other : d_.sensors) {
    if (other.name != given.name) continue;
    throw ModelError("two sensors are named " + quoted(given.name), "sensor", given.name);
  }
  SensorSpec sensor = given;
  sensor.X_LS = checked_pose(given.X_LS, "sensor", given.name);
  check_placement(sensor);
  const std::string element = sensor_element(sensor.kind);
  if (element == "joint") {
    check_of(d_.joints, sensor, element, sensor.of);
    check_moves(d_.joints, sensor);
  }
  if (element == "actuator") check_of(d_.actuators, sensor, element, sensor.of);
  if (element == "link") check_of(d_.links, sensor, element, sensor.of);
  check_other(d_, sensor);
  d_.sensors.push_back(sensor);
  return *this;
}

}  // namespace saltus
