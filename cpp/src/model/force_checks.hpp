// What is wrong with a joint's forces and with an actuator.
#pragma once

#include "saltus/force/most_number.hpp"
#include "saltus/model/description.hpp"

namespace saltus {

/// "1e+300; it is finite and at least 0", and how much at most where that is it.
std::string refused_number(double number, bool may_be_negative);
bool is_force_number(double number, bool may_be_negative);

/// @throws ModelError on negative damping, friction, armature or stiffness, numbers that are not
/// finite or beyond most_number, a restitution outside of 0 .. 1, and what a joint of this type
/// cannot have.
void check_forces(const JointSpec& joint);

/// @throws ModelError where the curve of its spring is none.
void check_curve(const JointSpec& joint);

/// @throws ModelError on negative numbers, or ones that are not finite.
void check_spring(const SpringSpec& spring);

/// @throws ModelError on no name, no joint, numbers that are not finite, effort or limits that
/// leave nothing.
void check_actuator(const ActuatorSpec& actuator);

}  // namespace saltus
