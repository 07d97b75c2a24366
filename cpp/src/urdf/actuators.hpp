// Motors and servos: `<transmission>` below `<robot>`, and the elements of the block `<saltus>`.
#pragma once

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// A simple transmission is a motor of its actuator's name, whose control is the joint's torque, as
/// ros_control has it at joint level: mechanicalReduction is not used. Others, and those of joints
/// that are not there or have not one coordinate, are named in a warning.
void add_transmissions(const Document& document, ModelBuilder& builder);

/// `<motor>`, `<position_servo>`, `<velocity_servo>`, `<actuator>`, `<spring>`,
/// `<gravity_compensation>`, and `<joint>` with armature, spring or curve, and restitution. @return
/// false where the element is none of these.
bool add_force_element(const Document& document, const XMLElement& element, ModelBuilder& builder);

}  // namespace saltus::reader
