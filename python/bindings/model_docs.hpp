// Docstrings of the model floor, apart from the code because they are longer than it.
#pragma once

namespace saltus::bindings::docs {

constexpr auto state = R"(The state of a model: a value. Keep it, compare it, go back to it.

Its arrays are read-only. Made by `Model.state`, `Stepper.advance` and `Trajectory.state`.

Parameters
----------
t : float
    [s]
q : array_like, shape (n,)
    [rad | m] coordinates.
p : array_like, shape (n,)
    [kg m^2/s | kg m/s] conjugate momenta, p = L_v.
)";

constexpr auto joint_type = R"(Kinds of joints and their coordinates.

planar: x, y, yaw in the plane normal to the axis; floating: x, y, z, then yaw, pitch, roll
(singular at pitch = pi/2); spherical: yaw, pitch, roll; helical: turns and advances by `pitch`.
)";

constexpr auto coordinate = R"(A generalized coordinate and what the model's file says of it.

Limits, damping and friction are kept for the user; the stepper does not apply them.
)";

constexpr auto tree_solution = R"(How steps solve for the velocities of one tree, or of equal ones.

Equal trees (pendulums of a cradle, bodies that fly alone) may be solved side by side, in lanes of
vector instructions; `trees` says how many.
)";

constexpr auto gaps = R"(Gaps of all m pairs of a model at one configuration.

`p_WA - p_WB == phi * normal` for every pair. Arrays are read-only views, no copies.
)";

constexpr auto model = R"(A tree of rigid bodies: frozen, checked, cheap to copy.

Made by `load_urdf` or `ModelBuilder.build`. Wherever a method takes coordinates or velocities,
it takes an array of shape (n,) or a mapping from names to values, whose other values are 0.
)";

constexpr auto model_state = R"(The state with these coordinates and velocities, p = M(q) v.

Parameters
----------
q : array_like, shape (n,), or mapping of names to values
    [rad | m]; coordinates that are not named are 0.
v : array_like, shape (n,), or mapping of names to values
    [rad/s | m/s]
t : float
    [s]

Returns
-------
State

Raises
------
ModelError
    On an unknown name, a wrong shape, or a value that is not finite.
)";

constexpr auto model_velocity = R"(Velocities v = M(q)^-1 p of a state.

Returns
-------
numpy.ndarray, shape (n,)
    [rad/s | m/s]

Raises
------
ModelError
    On a state that does not fit the model.
StepError
    Where the mass matrix is singular.
)";

constexpr auto model_lagrangian = R"(L = T - V and all its first and second partials.

Parameters
----------
q : array_like, shape (n,), or mapping of names to values
    [rad | m]
v : array_like, shape (n,), or mapping of names to values
    [rad/s | m/s]

Returns
-------
LagrangianPartials

Raises
------
ModelError
    On an unknown name, a wrong shape, or a value that is not finite.
)";

constexpr auto model_mass_matrix = R"(M(q) = L_vv.

Parameters
----------
q : array_like, shape (n,), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (n, n)
)";

constexpr auto model_gaps = R"(Gaps phi of all pairs with their first and second partials.

Parameters
----------
q : array_like, shape (n,), or mapping of names to values
    [rad | m]

Returns
-------
Gaps
)";

constexpr auto model_pose = R"(Pose of a link in the world; `Model::X_WL` in C++.

Parameters
----------
q : array_like, shape (n,), or mapping of names to values
    [rad | m]
link : str or int
    Its name or index.

Returns
-------
Pose
    Origin [m] and axes of the link's frame; `.matrix()` is the homogeneous matrix, shape (4, 4).

Raises
------
ModelError
    On an unknown link or coordinate, a wrong shape, or a value that is not finite.
)";

}  // namespace saltus::bindings::docs
