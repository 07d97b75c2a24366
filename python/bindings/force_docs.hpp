// Documentation of forces and actuators.
#pragma once

#include "doc_phrases.hpp"

namespace saltus::bindings::docs {

constexpr auto joint_effects =
    R"(What of a joint acts in steps; what does not is kept as information.

limits
    A stop at each end of the range, without rebound unless its restitution says otherwise.
damping
    Viscous damping, with armature and spring.
friction
    Dry friction.
motors
    Actuators on the joint, and the effort that they are limited to.
all, none
    Members combine: `JointEffects.limits | JointEffects.damping`.
)";

constexpr auto wrench = R"(A force and a torque on a link, held over a step.

Parameters
----------
force, torque : array_like, shape (3,)
    [N], [N m]
point : array_like, shape (3,)
    [m] where the force acts, in the link's frame.
frame : {"world", "body"}
    Whose axes force and torque are in; those of the body turn with it.
)";

constexpr auto add_motor = R"(Adds a motor; the control is its torque [N m], or force [N].

Parameters
----------
)" SALTUS_NAME_AND_JOINT R"(gear : float
    The joint gets `gear` times the motor's torque.
effort : float
    Of the motor at most; it is also the range of the control.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a joint that does not exist or has several coordinates, a name that is taken, an effort that
    is not positive.
)";

constexpr auto add_position_servo =
    R"(Adds a servo, kp (control - q) - kd v; the control is the position to reach.

The servo acts inside the step, which is stable at any gain that rounding leaves sense: kp h^2 and
kd h up to 1e12 times what they move.

Parameters
----------
)" SALTUS_NAME_AND_JOINT R"(kp : float
    [N m/rad | N/m]
kd : float
    [N m s/rad | N s/m]
effort : float
    [N m | N] at most.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    As `add_motor`.
)";

constexpr auto add_velocity_servo =
    R"(Adds a servo, kv (control - v); the control is the rate to reach.

Parameters
----------
)" SALTUS_NAME_AND_JOINT R"(kv : float
    [N m s/rad | N s/m]
effort : float
    [N m | N] at most.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    As `add_motor`.
)";

constexpr auto add_actuator =
    R"(Adds an actuator that is affine in what it moves, as MuJoCo's `general`.

With l the sum of ratio times coordinate over `joints` it pushes each joint by its ratio times
`clip(gain clip(control) + bias[0] + bias[1] l + bias[2] dl/dt)`.

Parameters
----------
name : str
joints : mapping of str to float
    Joints of one coordinate and their ratios.
gain : float
bias : (float, float, float)
effort : float
    Of the force, before ratios, at most.
control : (float, float), optional
    Range of the control; beyond it the nearest value acts.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    As `add_motor`.
)";

constexpr auto set_limit = R"(Sets the range of a joint of one coordinate.

Parameters
----------
joint : str
lower, upper : float
    [rad | m] infinite where there is no limit.
restitution : float
    At the stops, in [0, 1].

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a joint that does not exist or has several coordinates, lower > upper, a restitution outside
    of [0, 1].
)";

constexpr auto set_effects = R"(Sets what of joints acts in steps.

Parameters
----------
effects : JointEffects or str
joint : str, optional
    None: all joints that there are now.

)" SALTUS_RETURNS_BUILDER R"()";

constexpr auto stiff_joints = R"(Joints whose damping stops them within a step.

They have z = h d (M^-1)_ii > 4, d the damping. The midpoint rule would turn their velocity round in
each step; they get the rule that damps it (positions are of first order then). A smaller h, or less
damping, makes them exact.

Parameters
----------
h : float
    [s] the step.
q : array_like, shape (n_q,), or mapping, optional
    Where; `neutral()` if not given.

Returns
-------
list of str

Raises
------
ModelError
    Where h is not positive.
)";

}  // namespace saltus::bindings::docs
