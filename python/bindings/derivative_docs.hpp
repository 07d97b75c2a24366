// Docstrings of derivatives of a step.
#pragma once

/// Of a product forwards.
#define SALTUS_RETURNS_DIRECTION                             \
  "Returns\n-------\ntuple of numpy.ndarray, shape (n_v,)\n" \
  "    Of q, along velocities, and of p.\n"

namespace saltus::bindings {

constexpr auto smoothness_doc = R"(What the derivative of a step is worth.

smooth: one derivative in all directions. selection: several contacts closed at one instant, and
their order changes it; it is that of the order that was taken, others differ by `spread`.
one_sided: contacts touch without pushing, or an impact is at an end of the step, and it holds while
`weak` pairs keep opening; or a contact is at the edge of its friction cone, and it holds while that
sticks. order_dependent: the outcome itself depends on the order, and the
derivative is of one side of a jump. grazing: an impact so weak that it is lost by a change of the
start as small as `depth`.
)";

constexpr auto step_direction_doc = R"(A direction of what a step is made from, or a covector of it.

Attributes
----------
q, p : numpy.ndarray, shape (n_v,)
    Of the state at the step's start; q along velocities, of a ball R -> exp(eta) R.
control : numpy.ndarray, shape (n_u,)
    Of the actuators.
qfrc : numpy.ndarray, shape (n_v,)
    [N m | N] of forces on the coordinates.
h : float
    [s] of the step's duration.
restitution : numpy.ndarray, shape (impacts,)
    Of each impact's restitution.
friction : numpy.ndarray, shape (rubbing,)
    Of the coefficient of each pair in `StepDerivative.rubbing`.
forces, torques : numpy.ndarray, shape (wrenches, 3)
    [N], [N m] of each wrench that was applied, in their order and in the axes that each has.
)";

constexpr auto impact_derivative_doc = R"(An impact as the derivative of its step sees it.

Attributes
----------
t : float
    [s]
pairs : list of str
    Names of the pairs, in the order of the impulses.
spread : float
    How far the derivative by another order is from that by this one, relative to its largest entry.
depth : float
    [m] How far the gap of the weakest impulse would close without it, u^2 / (2 |phi''|): the
    derivative holds for changes of gaps far below.
weak : list of str
    Pairs that touch and are at rest along their normal before the impact or after it.
)";

constexpr auto step_derivative_doc = R"(The dense derivative of a step.

Rows are q, then p, of the state that the step ends in; n_v of them each. Directions of q are along
velocities, of a ball R -> exp(eta) R in its parent's axes.

Attributes
----------
A : numpy.ndarray, shape (2 n_v, 2 n_v)
    By q and p of the start.
B : numpy.ndarray, shape (2 n_v, n_u)
    By the controls.
qfrc : numpy.ndarray, shape (2 n_v, n_v)
    By forces on the coordinates.
h : numpy.ndarray, shape (2 n_v,)
    By the duration. Empty where forces are functions, whose derivatives by time nobody tells.
restitution : numpy.ndarray, shape (2 n_v, impacts)
    By each impact's restitution.
friction : numpy.ndarray, shape (2 n_v, rubbing)
    By the coefficient of friction of each pair in `rubbing`; 0 where it sticks.
rubbing : list of str
    Names of the pairs that pushed with friction, in arcs or impacts.
forces, torques : numpy.ndarray, shape (2 n_v, 3 wrenches)
    By each wrench that was applied, in their order and in the axes that each has.
smoothness : Smoothness
impacts : list of ImpactDerivative
)";

constexpr auto selection_doc =
    R"(The derivative of a step by one order of the impulses of an impact.

Attributes
----------
impact : int
    Its index in `StepDerivative.impacts`.
pairs : list of str
    Names of the pairs in that order.
p : numpy.ndarray, shape (n_v,)
    Momenta after the impact.
A : numpy.ndarray, shape (2 n_v, 2 n_v)
    Empty where the momenta are not those of the step.
)";

constexpr auto jvp_doc = R"(The direction of the state that the last step ended in, in O(n).

The exact derivative, through all impacts of the step in their order; `derivative` tells what it is
worth. Needs `record=True`.

Parameters
----------
dq, dp : mapping of names to values, or array_like, shape (n_v,), optional
    Of the state at the step's start; dq along velocities.
du : mapping of names to values, or array_like, shape (n_u,), optional
    Of the controls.
dqfrc : mapping of names to values, or array_like, shape (n_v,), optional
    [N m | N] of forces on the coordinates.
dh : float
    [s] of the step's duration.
drestitution : array_like, shape (impacts,), optional
    Of each impact's restitution.
dfriction : float or array_like, shape (rubbing,)
    Of all coefficients of friction alike, or of that of each pair in `StepDerivative.rubbing`.
dforces, dtorques : array_like, shape (wrenches, 3), optional
    [N], [N m] of each wrench that was applied, in their order and in the axes that each has.

)" SALTUS_RETURNS_DIRECTION R"(
Raises
------
ModelError
    Where an array does not fit; where no step was recorded; where the step has something that is
    not differentiated: names it.
)";

constexpr auto vjp_doc = R"(The covector of all that the last step was made from, in O(n).

The transpose of `jvp`: q_hat.dq_next + p_hat.dp_next for every direction at once. Needs
`record=True`.

Parameters
----------
q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
    The gradient of a cost by the state that the step ended in, q along velocities.

Returns
-------
StepDirection

Raises
------
ModelError
    As `jvp`.
)";

constexpr auto model_gradient_doc = R"(A covector of what a model is made of.

Attributes
----------
inertia : numpy.ndarray, shape (links, 10)
    By each link's own mass, first moment `mass * c` and inertia about its frame's origin, xx xy xz
    yy yz zz, in its frame. 0 of links fixed to the world. What compensates gravity stays as it is.
stiffness, rest : numpy.ndarray, shape (n_v,)
    By the joints' linear springs.
damping, armature : numpy.ndarray, shape (n_v,)
    By the joints' own.
actuators : numpy.ndarray, shape (n_u, 4)
    By gain, bias, bias_l and bias_v of each, whose force is gain u + bias + bias_l l + bias_v l'
    with its length l; 0 where it pushes all it can. By kp of a position servo, whose gain is kp and
    bias_l -kp: the first less the third; by its kd: less the last.
restitution, friction : dict of str to float
    By what happens between the two shapes of a pair, by the pair's name: of the pairs that rebounded
    and of those that slid. Of all others it is 0. By one number that all pairs have it is the sum.
    A pair whose restitution is 0 does not rebound, and is none of these.
springs : dict of str to tuple of float
    By stiffness and length of each spring between two points, by its name.
dampers : dict of str to float
    By the damping of each damper between two points, likewise.
placements : dict of str to numpy.ndarray, shape (3,)
    [1/m] By where the frame of each joint that moves is in its parent link, `X_PJ.p`, by the joint's
    name; forces that are functions stay as they are. Those of fixed joints are not told.
)";

constexpr auto model_vjp_doc =
    R"(The gradient of a cost of the last step's end by the model, in O(n).

What `vjp` is for the inputs of the step. Needs `record=True`.

Parameters
----------
q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
    As in `vjp`. p is held at the step's start, not v.

Returns
-------
ModelGradient

Raises
------
ModelError
    As `jvp`.
)";

constexpr auto hvp_doc =
    R"(The second derivative of a cost of the last step's end along a direction.

What `vjp(q_hat, p_hat)` changes by as the step's inputs move, with q_hat and p_hat held: the product
of the Hessian of q_hat.q + p_hat.p with a direction, in O(n), to rounding. Of smooth steps, one arc
without impacts and contacts, and of models without ball and free joints. Needs `record=True`.

Parameters
----------
q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
    As in `vjp`.
dq, dp, du, dqfrc, dh
    As in `jvp`.

Returns
-------
StepDirection
    Without impacts, frictions and wrenches.

Raises
------
ModelError
    As `jvp`; and names what of the step or the model has no second derivative.
)";

constexpr auto hessian_doc = R"(The Hessian of a cost of the last step's end, by all directions.

`hvp` for each. Needs `record=True`.

Parameters
----------
q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
    As in `vjp`.

Returns
-------
numpy.ndarray, shape (2 n_v + n_u + 1, 2 n_v + n_u + 1)
    By q, p, the controls and the step's duration; symmetric.

Raises
------
ModelError
    As `hvp`.
)";

constexpr auto directional_doc = R"(The one-sided derivative of the last step along a direction.

Where several contacts close at one instant, a trajectory near by resolves them one after the other,
in an order that depends on the direction: this takes that order. Else it is `jvp`.

Parameters
----------
dq, dp, du, dqfrc, dh, drestitution, dfriction, dforces, dtorques
    As in `jvp`.

)" SALTUS_RETURNS_DIRECTION R"(
Raises
------
ModelError
    As `jvp`.
)";

constexpr auto derivative_doc = R"(The dense derivative of the last step, and what it is worth.

2 n_v + n_u products of `jvp`. Needs `record=True`.

Returns
-------
StepDerivative

Raises
------
ModelError
    As `jvp`.
)";

constexpr auto selections_doc = R"(The derivative by every order of the impacts of one instant.

Depth first: a contact that does not approach cannot be next. The step's own order comes first.

Parameters
----------
most : int
    Orders of each impact; what is beyond is left out.

Returns
-------
list of Selection
    None where no impact has several contacts.

Raises
------
ModelError
    As `jvp`.
)";

}  // namespace saltus::bindings
