// Documentation of springs, compensation of gravity, and functions.
#pragma once

#include "doc_phrases.hpp"

namespace saltus::bindings::docs {

constexpr auto add_spring = R"(Adds a spring and a damper side by side between two points.

With d the distance of the points, V = stiffness (d - length)^2 / 2, and the damper pulls with
-damping dd/dt along the line between them. The spring is a potential: it is in `lagrangian`, in the
energies and in `inverse_dynamics`. The damper acts in steps, and its work is part of
`run.work["damping"]`.

Parameters
----------
name : str
a, b : At or str
    A point of a link, or a link for its origin; of two bodies.
stiffness : float
    [N/m] at least 0.
length : float
    [m] where the spring pulls no more. A spring of length 0 is smooth where its ends meet; of any
    other the force has no direction there, and a step that comes to it is a StepError.
damping : float
    [N s/m] at least 0.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a link that does not exist, a number that is negative or not finite, a name that is taken;
    `build` where both points are on one body.
)";

constexpr auto add_joint_spring = R"(Adds a spring to a joint of one coordinate, or replaces it.

Either V = stiffness (q - rest)^2 / 2, or a curve: the spring resists with `forces` at the
displacements `angles`, with a cubic spline between them and a line beyond its ends. V is the
integral of the curve from its first point, so that the joint feels minus the curve.

Parameters
----------
joint : str
stiffness : float
    [N m/rad | N/m] at least 0.
rest : float
    [rad | m]
curve : tuple of two array_like, shape (k,), optional
    `(angles, forces)`, [rad | m] ascending and [N m | N]; k is 2 at least.
slopes : tuple of two floats, optional
    [N m/rad | N/m] of the curve at its ends. Without them the ends are natural: not bent.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a joint that does not exist or has several coordinates, numbers that are negative or not
    finite, angles that do not ascend.
)";

constexpr auto set_gravity_compensation = R"(Something carries a part of a link's weight.

Gravity pulls at the rest alone: V = -(1 - part) m g.c. The inertia stays. `gravity_forces`, the
energies and steps have it.

Parameters
----------
link : str
part : float
    1 is all of it, 0 nothing.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a link that does not exist, or a part that is not finite.
)";

constexpr auto add_force = R"(Adds a force that is a function of t, q and v.

The function is called inside each step, in the middle of each arc, several times: it must return
the same for the same arguments. An exception in it ends the step, whose state stays as it was. The
work of the force is part of `run.work["applied"]`. A model that has such a force cannot be
pickled, nor added to another.

Parameters
----------
name : str
function : callable
    `function(now)`, `now` a ForceMoment with t, q and v. Returns Q, an array of one number for each
    of `coordinates`, or the tuple `(Q, Q_q, Q_v)`, the last two of shape (coordinates, n_v) or
    None. Derivatives by q are along velocities, as in LagrangianPartials. With Q alone steps take
    more iterations, to the same answer.
coordinates : sequence of str, optional
    Names of the velocities that it pushes, of a joint of one coordinate the joint's; all by
    default.

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a name that is taken; `build` on coordinates that do not exist. Steps where the function
    returns something else, or numbers that are not finite, and the first one of a model where Q_q
    or Q_v is not the derivative (`check_derivatives` looks at more places).
)";

constexpr auto add_potential = R"(Adds a potential V(q), by three functions of q.

It is part of the Lagrangian: of `lagrangian`, the energies, `inverse_dynamics`, and of steps, which
conserve the energy with it. The law `compensated` needs third derivatives and refuses it. A model
that has one cannot be pickled, nor added to another.

Parameters
----------
name : str
value : callable
    q (n_q,) to V [J].
gradient : callable
    q to the derivatives of V along velocities, shape (n_v,) [N m | N].
hessian : callable
    q to the derivatives of the gradient along velocities, shape (n_v, n_v).

)" SALTUS_RETURNS_BUILDER R"(
Raises
------
ModelError
    On a name that is taken. Whatever asks for the potential, where a function returns another
    shape, or numbers that are not finite; the first step of a model, and `equilibrium`, where
    gradient or Hessian is not the derivative (`check_derivatives` looks at more places).
)";

constexpr auto force_moment = R"(When and where a force is asked for: the middle of an arc.

Attributes
----------
t : float
    [s]
q : numpy.ndarray, shape (n_q,)
v : numpy.ndarray, shape (n_v,)
    Read-only, both.
)";

constexpr auto check_derivatives = R"(Compares derivatives that a user wrote with differences.

At three random configurations and rates, the same each time: Q_q and Q_v of a force, gradient and
Hessian of a potential, each entry against central differences of two sizes.

Parameters
----------
force : str or callable
    The name of a force or a potential of the model, or a function as `ModelBuilder.add_force`
    takes it.
model : Model
coordinates : sequence of str, optional
    Of a function, as in `ModelBuilder.add_force`.

Raises
------
ModelError
    Where one is wrong: names the worst entry, what the function says, what differences say, and the
    order in which the two approach each other as differences are refined, 2 where it is right.
    And where a force returns Q alone: there is nothing to compare.

Examples
--------
>>> import saltus
>>> model = saltus.load_urdf(saltus.urdf_dir() / "arm.urdf")
>>> saltus.check_derivatives(lambda now: (-now.v, 0 * model.mass_matrix(now.q), None), model)
)";

}  // namespace saltus::bindings::docs
