// What a model measures by name. A sensor has no part in the motion: it reads recorded rows.
#pragma once

#include <string>
#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// MuJoCo's names where it has one.
enum class SensorKind {
  jointpos,       ///< [rad | m] coordinates of a joint
  jointvel,       ///< [rad/s | m/s] velocities of a joint
  actuatorfrc,    ///< [N m | N] what an actuator pushes with, after its limits
  framepos,       ///< [m] where the sensor is, in the world
  framequat,      ///< how it is turned: x y z w
  framelinvel,    ///< [m/s] its velocity, in the world's axes
  frameangvel,    ///< [rad/s] its angular velocity, in the world's axes
  velocimeter,    ///< [m/s] its velocity, in its own axes
  gyro,           ///< [rad/s] its angular velocity, in its own axes
  accelerometer,  ///< [m/s^2] its acceleration less gravity, in its own axes
  touch,          ///< [N] sum of the normal forces on a link
  contactforce,   ///< [N] sum of the contact forces on a link, in the world's axes
};

/// A sensor, as add_sensor takes it.
struct SensorSpec {
  std::string name;                        ///< of the sensor
  SensorKind kind = SensorKind::jointpos;  ///< what it measures
  std::string of;                          ///< the joint, the actuator, or the link that carries it
  std::string other = {};  ///< of touch and contactforce: the link or half-space that counts; "":
                           ///< all that touches
  Pose X_LS = {};          ///< its frame in the link's
};

/// What `of` names: "joint", "actuator" or "link".
SALTUS_EXPORT std::string sensor_element(SensorKind kind);

}  // namespace saltus
