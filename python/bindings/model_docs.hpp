// Docstrings of the model floor, apart from the code because they are longer than it.
#pragma once

namespace saltus::bindings::docs {

constexpr auto state = R"(The state of a model: a value. Keep it, compare it, go back to it.

Its arrays are read-only. Made by `Model.state`, `Stepper.advance` and `Trajectory.state`.

Parameters
----------
t : float
    [s]
q : array_like, shape (n_q,)
    [rad | m] coordinates; of ball joints a unit quaternion x y z w.
p : array_like, shape (n_v,)
    [kg m^2/s | kg m/s] conjugate momenta, p = L_v.
)";

constexpr auto joint_type = R"(Kinds of joints and their coordinates.

planar: x, y, yaw in the plane normal to the axis; spherical: a ball, whose coordinates are a unit
quaternion x y z w and whose velocities are the angular velocity, both in the parent's axes;
floating: x, y, z, then a ball; helical: turns and advances by `pitch`.
)";

constexpr auto coordinate = R"(A number of q and what the model's file says of it.

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

Made by `load_urdf` or `ModelBuilder.build`. Where a method takes coordinates, it takes an array of
shape (n_q,) or a mapping from names to values, others being those of `neutral`; where it takes
velocities, an array of shape (n_v,) or a mapping, others being 0. In both mappings the name of a
joint with several numbers stands for all of them: `q={"base": Pose(...)}`, or a position and a
quaternion, or a SciPy Rotation; `v={"base": ((1, 0, 0), (0, 0, 5))}`.
)";

constexpr auto model_state = R"(The state with these coordinates and velocities, p = M(q) v.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values, or str
    [rad | m]; coordinates that are not named are as in `neutral`. The name of a state that the
    model has, `state_names`, stands for its coordinates, here and in all functions that take q.
v : array_like, shape (n_v,), or mapping of names to values
    [rad/s | m/s]; of free and ball joints in the parent's axes. None: 0, or those of the named
    state.
t : float
    [s]

Returns
-------
State

Raises
------
ModelError
    On an unknown name, a wrong shape, a value that is not finite, a quaternion that is not of
    length 1 (to 1e-6; within that it is normalised).
)";

constexpr auto model_neutral = R"(Coordinates at rest: 0, but quaternions, which are the identity.

Returns
-------
numpy.ndarray, shape (n_q,)
)";

constexpr auto model_integrate = R"(Coordinates after motion at constant velocities dv for 1 s.

Adds dv to the coordinates of joints with one number each; turns a ball by the angle |w| about w, in
its parent's axes.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values
    [rad | m]
dv : array_like, shape (n_v,), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (n_q,)

Raises
------
ModelError
    As `state`.
)";

constexpr auto model_difference = R"(The dv with integrate(q0, dv) = q1, the shortest of them.

It compares orientations: a quaternion and its negative are one, and differ by 0.

Parameters
----------
q0, q1 : array_like, shape (n_q,), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (n_v,)
    [rad | m] at most pi for each ball.

Raises
------
ModelError
    As `state`.
)";

constexpr auto model_normalized = R"(Coordinates with their quaternions made of length 1.

Parameters
----------
q : array_like, shape (n_q,)

Returns
-------
numpy.ndarray, shape (n_q,)

Raises
------
ModelError
    On a wrong shape, a value that is not finite, a quaternion of length 0.
)";

constexpr auto model_random = R"(Coordinates drawn at random.

Quaternions are uniform over all orientations; others are uniform within their limits, and where
there are none within +-pi rad and +-1 m.

Parameters
----------
random : int or numpy.random.Generator, optional
    Seed, or where numbers are drawn from.

Returns
-------
numpy.ndarray, shape (n_q,)
)";

constexpr auto model_velocity = R"(Velocities v = M(q)^-1 p of a state.

Returns
-------
numpy.ndarray, shape (n_v,)
    [rad/s | m/s]

Raises
------
ModelError
    On a state that does not fit the model.
StepError
    Where the mass matrix is singular.
)";

constexpr auto model_lagrangian = R"(L = T - V and all its first and second partials.

V is that of gravity, less what is compensated, of springs, and of potentials that are functions.
Partials by q are along velocities, of shape (n_v,). Of a ball they are along turns exp(eta) R about
its parent's axes, with the angular velocity in these axes held: `L_q` is no force then (the torque
is L_q + w x L_v), and `L_qq` is not symmetric within a ball.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values
    [rad | m]
v : array_like, shape (n_v,), or mapping of names to values
    [rad/s | m/s]
out : LagrangianPartials, optional
    One of an earlier call, to be overwritten: what reads its arrays sees the new values. Of large
    models this saves most of the time.

Returns
-------
LagrangianPartials
    `out` where it is given.

Raises
------
ModelError
    On an unknown name, a wrong shape, or a value that is not finite; where `out` is of another size.
)";

constexpr auto model_mass_matrix = R"(M(q) = L_vv.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (n_v, n_v)
)";

constexpr auto model_gaps = R"(Gaps phi of all pairs with their first and second partials.

Partials are along velocities: `phi_q @ v` is the rate of phi, and `v @ phi_qq[i] @ v` its second
derivative where q moves at the constant velocities v.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values
    [rad | m]

Returns
-------
Gaps
)";

constexpr auto model_pose = R"(Pose of a link in the world; `Model::X_WL` in C++.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values
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
