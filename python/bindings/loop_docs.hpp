// Docstrings of loops.
#pragma once

namespace saltus::bindings::docs {

constexpr auto loop_type = R"(What a loop holds of its two ends, frames on two links.

`point`: their origins are one. `weld`: their axes as well. `distance`: their origins are a fixed
distance apart. `on_plane`: the origin of a is on the plane through the origin of b that b's z axis
is normal to. `coupling`: of two joints, see `add_coupling`. `prescribed`: of one, see `set_prescribed`.
)";

constexpr auto at = R"(A frame on a link: where a spring or a loop is attached.

Parameters
----------
link : str
p : array_like, shape (3,)
    [m] its origin in the link's frame.
R : array_like, shape (3, 3), optional
    Its axes there; those of the link where not given.
)";

constexpr auto add_loop =
    R"(Holds two links together beyond the tree, as the last pin of a four-bar.

The loop is exact: a step ends with it closed to rounding, impacts respect it, and its forces are
in `Stepper.report.loops`. Loops that say the same twice share the load. No gap is watched
between links that a `point` or `weld` holds together. A run starts from a configuration that
closes all loops: `close_loops` finds one. (RATTLE, as Hairer, Lubich, Wanner, VII.1.)

Parameters
----------
name : str
type : LoopType or str
    "point", "weld", "distance" or "on_plane".
a, b : At or str
    Its ends, frames on two links, or links for their own frames.
distance : float
    [m] of type "distance".

Returns
-------
ModelBuilder

Raises
------
ModelError
    On a name that another loop has, ends on one link, and a distance that is none.
)";

constexpr auto add_coupling = R"(Makes the displacement of a joint a polynomial of another's.

A joint that mimics another (`mimic`) is the same of degree 1, and costs nothing: it has no
coordinate. The coupling is named "<joint> coupling" where loops are listed.

Parameters
----------
joint, of : str
    Both of one coordinate.
polynomial : array_like
    Coefficients by rising powers: (0, 1, 0.1) is x + 0.1 x^2.

Returns
-------
ModelBuilder
)";

constexpr auto set_prescribed = R"(Makes a joint move as it is told, whatever that takes.

The joint goes by a cubic spline through the values, whose ends are not bent and go on as lines, or
by a function. Its arcs go by the secant of the motion, its rate at nodes is that of the motion.
Impacts find it infinitely heavy. What moves it does work: part of `run.work["applied"]`. A run
starts where the motion is: `close_loops(model, t=t)` gives that state. The joint is named "<joint>
prescribed" where loops are listed.

Parameters
----------
joint : str
    Of one coordinate. The link that it moves may be without mass of
    its own, where what hangs on it leaves the mass matrix regular.
times, values : array_like, shape (k,), optional
    [s] ascending, [rad | m]; k is 2 at least.
function : callable, optional
    function(t) returns the displacement [rad | m] and its rate, or the acceleration as well, which
    `accelerations` and `inverse_dynamics` ask for. A model that has one cannot be pickled, and files
    do not hold it.

Returns
-------
ModelBuilder
)";

constexpr auto loop_gaps = R"(How far each loop is open.

Parameters
----------
q : array_like, shape (n_q,), or mapping
t : float
    [s] of prescribed motions.

Returns
-------
dict of str to numpy.ndarray
    By loop, [m]; of a weld three of the position and three of the orientation (twice the vector of
    the quaternion: [rad] where small).
)";

constexpr auto close_loops = R"(Finds the state nearest to a configuration that closes all loops.

Newton's method goes from q by the shortest steps in the metric of the mass matrix; velocities are
the nearest, in the same metric, that keep the loops closed. Joints' limits have no say.

Parameters
----------
model : Model
q : array_like, shape (n_q,), or mapping, optional
    Where to start: the closer, the likelier is the branch that you mean.
v : array_like, shape (n_v,), or mapping, optional
keep : list of str
    Joints, or velocities, that stay exactly as they are in q and v.
t : float
    [s] of the state, and of prescribed motions.

Returns
-------
State

Raises
------
ModelError
    Where no such state is found: the loop that stays open, and by how much.
)";

constexpr auto equilibrium =
    R"(Finds where a model rests under springs, weights and constant controls.

The minimum of V minus the work of the controls near q, on the loops and within joints' limits.
Contacts of shapes, damping and dry friction have no say.

Parameters
----------
model : Model
q : array_like, shape (n_q,), or mapping, optional
    Where to start.
control : array_like, shape (n_u,), or mapping, optional
    What actuators are told.
keep : list of str
    Joints, or velocities, that stay as they are.

Returns
-------
State
    At rest.

Raises
------
ModelError
    Where nothing holds what moves, and where the equilibrium that is found is no minimum: which
    coordinate would fall away from it.
)";

}  // namespace saltus::bindings::docs
