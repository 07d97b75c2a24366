// Docstrings of bind_dynamics.cpp.
#pragma once

namespace saltus::bindings::docs {

constexpr auto frames = R"(A model at one configuration: its kinematics once, then what follows.

Made by `Model.at`. `set` moves it on without new memory, which a loop over configurations wants; to
have many at once, the methods of `Model` take arrays of shape (rows, n_q). World axes and
[angular; linear] throughout. Not for two threads at once.
)";

constexpr auto frames_set = R"(Moves to another configuration and returns itself.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values
    [rad | m]

Returns
-------
Frames
)";

constexpr auto frames_pose = R"(Pose of a link in the world.

Parameters
----------
link : str, int or Link

Returns
-------
Pose
)";

constexpr auto frames_shape_pose = R"(Pose of a shape in the world.

Parameters
----------
shape : str or int
    Its name, as in pairs, or index.

Returns
-------
Pose
)";

constexpr auto frames_jacobian = R"(As `Model.jacobian`, here.

Parameters
----------
link : str, int or Link
point : array_like, shape (3,), optional
    [m] in the link's frame.

Returns
-------
numpy.ndarray, shape (6, n_v), with a point (3, n_v)
)";

constexpr auto frames_momentum = R"(As `Model.momentum`, here.

Parameters
----------
v : array_like, shape (n_v,), or mapping of names to values
    [rad/s | m/s]
about : array_like, shape (3,), optional
    [m] point in the world; None: its origin.

Returns
-------
numpy.ndarray, shape (6,)
)";

constexpr auto frames_inverse_dynamics = R"(As `Model.inverse_dynamics`, here.

Parameters
----------
v : array_like, shape (n_v,), or mapping of names to values
    [rad/s | m/s]
a : array_like, shape (n_v,), or mapping of names to values
    [rad/s^2 | m/s^2]
t : float
    [s] of prescribed motions.

Returns
-------
numpy.ndarray, shape (n_v,)
)";

constexpr auto frames_accelerations = R"(As `Model.accelerations`, here.

Parameters
----------
v : array_like, shape (n_v,), or mapping of names to values
    [rad/s | m/s]
forces : array_like, shape (n_v,), or mapping of names to values, optional
    [N m | N]
t : float
    [s] of prescribed motions.

Returns
-------
numpy.ndarray, shape (n_v,)
)";

constexpr auto model_at = R"(The kinematics at one configuration, once: poses, Jacobians, dynamics.

Parameters
----------
q : array_like, shape (n_q,), or mapping of names to values, optional
    [rad | m]; coordinates that are not named are as in `neutral`.

Returns
-------
Frames

Examples
--------
>>> import saltus
>>> model = saltus.load_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
>>> frames = model.at({"swing_0": 0.3})
>>> frames.jacobian("ball_0").shape
(6, 3)
)";

constexpr auto model_jacobian = R"(Jacobian J of a link: J v is its velocity.

Rows are [angular; linear] in world axes: the angular velocity [rad/s] of the link and the velocity
[m/s] of its frame's origin. With a point there are three rows, the velocity of that point. Columns
are by velocity; of free and ball joints v is in the parent's axes, so that a free body's first six
columns are those of its own velocity and angular velocity. J^T takes a wrench [moment about that
point; force] to forces on the coordinates.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]
link : str, int or Link
point : array_like, shape (3,), optional
    [m] in the link's frame.

Returns
-------
numpy.ndarray, shape (6, n_v), with a point (3, n_v)
    Of many rows (rows, 6, n_v) or (rows, 3, n_v).

Raises
------
ModelError
    On an unknown link, a wrong shape, or a value that is not finite.
)";

constexpr auto model_accelerations = R"(Accelerations: forward dynamics.

Solves M(q) a + c(q, v) = forces + gravity_forces(q) + those of springs and potentials, c the forces
of motion alone. Loops and couplings are kept closed and prescribed joints move as they are told:
the right side has A lambda besides, A the gradients of the loops, so that A^T a is what that takes.
Contacts, limits, damping, friction, motors and forces that are functions do not act. O(n) for deep
trees, and one solve more for each row of a loop.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]
v : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
    [rad/s | m/s] None: at rest.
forces : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values, optional
    [N m | N] on the coordinates; of free and ball joints in the parent's axes.
t : float
    [s] of prescribed motions.

Returns
-------
numpy.ndarray, shape (n_v,) or (rows, n_v)
    [rad/s^2 | m/s^2] the rates of v.

Raises
------
ModelError
    On an unknown name, a wrong shape, or a value that is not finite; where a loop is open at q, or
    opens with v; where a joint moves by a function that does not say the acceleration.
StepError
    Where the mass matrix is singular, or loops hold no single motion.
)";

constexpr auto model_inverse_dynamics = R"(Forces that make given accelerations: inverse dynamics.

M(q) a + c(q, v) - gravity_forces(q) less those of springs and potentials, by the recursion of
Newton and Euler, O(n). At rest and without acceleration they are what holds the model up.

Where there are loops, many forces make these accelerations, and the loops take what they differ by.
Those that are returned are what loops do not take: M times accelerations that keep the loops
closed. Of prescribed joints they are 0, as what moves these has the rest. `accelerations` makes of
them the a that was given.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]
v : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
    [rad/s | m/s] None: at rest.
a : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
    [rad/s^2 | m/s^2] the rates of v. None: none.
t : float
    [s] of prescribed motions.

Returns
-------
numpy.ndarray, shape (n_v,) or (rows, n_v)
    [N m | N] on the coordinates; of free and ball joints in the parent's axes.

Raises
------
ModelError
    On an unknown name, a wrong shape, or a value that is not finite; where a loop is open at q, or
    opens with v or a; where a joint moves by a function that does not say the acceleration.
)";

constexpr auto model_gravity_forces = R"(What gravity does to the coordinates.

What is compensated of it (`set_gravity_compensation`) is left out. Holding the model still takes
the opposite; where there are springs or potentials `inverse_dynamics(q)` has theirs, too.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (n_v,) or (rows, n_v)
    [N m | N]
)";

constexpr auto model_centre_of_mass = R"(Centre of mass of all that moves, in the world.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (3,) or (rows, 3)
    [m]

Raises
------
ModelError
    Also where nothing that moves has mass.
)";

constexpr auto model_momentum = R"(Momentum of all that moves, [angular; linear] in world axes.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]
v : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
    [rad/s | m/s]
about : array_like, shape (3,) or (rows, 3), optional
    [m] point in the world that the angular momentum is about; None: the world's origin. With
    `centre_of_mass(q)` it is the centroidal momentum.

Returns
-------
numpy.ndarray, shape (6,) or (rows, 6)
    Angular momentum [kg m^2/s], momentum [kg m/s].
)";

constexpr auto model_all_poses = R"(Poses of all links, one pass a row.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (links, 4, 4) or (rows, links, 4, 4)
    Homogeneous matrices, in the order of `links`.
)";

constexpr auto model_all_shape_poses = R"(Poses of all shapes, one pass a row.

Parameters
----------
q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
    [rad | m]

Returns
-------
numpy.ndarray, shape (shapes, 4, 4) or (rows, shapes, 4, 4)
    Homogeneous matrices, in the order of `shapes`.
)";

}  // namespace saltus::bindings::docs
