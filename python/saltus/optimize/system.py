"""A model and its step as an optimiser sees them: states, their differences, A and B."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from saltus._core import JointType, Model, ModelError, Smoothness, State, Stepper, StepReport
from saltus.runs.simulate import Control, simulate
from saltus.runs.trajectory import Trajectory

Array = npt.NDArray[np.float64]


@dataclass
class Rollout:
    """Steps that were made: N controls, N + 1 states.

    Attributes
    ----------
    states : list of State
    control : numpy.ndarray, shape (N, n_u)
    impacts : list of dict
        Impacts done up to each state, by pair.
    """

    states: list[State]
    control: Array
    impacts: list[dict[str, int]] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.control)


@dataclass(frozen=True)
class Slopes:
    """Derivatives of all steps of a rollout; rows and columns q along velocities, then p.

    Attributes
    ----------
    A : numpy.ndarray, shape (N, 2 n_v, 2 n_v)
    B : numpy.ndarray, shape (N, 2 n_v, n_u)
    smoothness : list of Smoothness
        The verdict on each.
    """

    A: Array
    B: Array
    smoothness: list[Smoothness]


class States:
    """What has `states` of a `model`, as arrays."""

    model: Model
    states: list[State]

    @property
    def t(self) -> Array:
        """[s] shape (N + 1,)."""
        return np.array([x.t for x in self.states])

    @property
    def q(self) -> Array:
        """[rad | m] shape (N + 1, n_q)."""
        return np.array([x.q for x in self.states])

    @property
    def v(self) -> Array:
        """[rad/s | m/s] shape (N + 1, n_v)."""
        return np.array([self.model.velocity(x) for x in self.states])


class System:
    """A model with a stepper that records.

    Parameters
    ----------
    model : Model
    h : float
        [s]
    options : mapping
        Further options of `Stepper`.

    Raises
    ------
    ModelError
        Where the model has no actuators.
    """

    def __init__(self, model: Model, h: float, options: Mapping[str, object]) -> None:
        if not isinstance(model, Model):
            raise TypeError(
                f"model is a {type(model).__name__}; saltus.load_urdf makes a Model of it"
            )
        self.model = model
        self.h = h
        self.options = dict(options)
        self.stepper = Stepper(model, h, record=True, **options)  # type: ignore[arg-type]
        self.balls = ball_blocks(model)
        self.range = np.asarray(model.control_limits, dtype=float).reshape(-1, 2).T

    def run(
        self, start: State, steps: int, control: Control, *, record_contacts: bool = False
    ) -> Trajectory:
        """Return so many steps from a start as a run, to plot, save and play."""
        return simulate(
            self.model,
            duration=steps * self.h,
            h=self.h,
            state=start,
            control=control if self.model.n_u > 0 else None,
            record_contacts=record_contacts,
            progress=False,
            **self.options,  # type: ignore[arg-type]
        )

    def advance(self, state: State, u: Array) -> State:
        """Return the state h later."""
        return self.stepper.advance(state, control=u if len(u) else None)

    def hessian(self, state: State, u: Array, q_hat: Array, p_hat: Array) -> Array | None:
        """Return the Hessian of q_hat.q + p_hat.p after a step, by (q, p, u); None: it has none.

        Steps with impacts and contacts have none, nor models with balls.
        """
        if self.balls:
            return None
        self.advance(state, u)
        try:
            return self.stepper.hessian(q_hat, p_hat)[:-1, :-1]
        except ModelError:
            return None

    def inside(self, u: Array, by: float) -> Array:
        """Return controls a little inside the actuators' ranges, beyond which they do nothing more.

        A derivative at the very end of a range would be that of beyond.
        """
        low, high = self.range
        sizes = np.maximum(
            1.0, np.abs(self.range, where=np.isfinite(self.range), out=np.ones((2, len(low))))
        )
        return np.asarray(np.clip(u, low + by * sizes[0], high - by * sizes[1]))

    def roll(self, start: State, control: Array) -> Rollout:
        """Return the steps that controls make from a state."""
        states, impacts = [start], [dict[str, int]()]
        for u in control:
            states.append(self.advance(states[-1], u))
            impacts.append(count_impacts(impacts[-1], self.stepper.report))
        return Rollout(states, control, impacts)

    def linearize(self, path: Rollout) -> Slopes:
        """Return A and B of each step."""
        n, N = 2 * self.model.n_v, len(path)
        A, B = np.empty((N, n, n)), np.empty((N, n, self.model.n_u))
        verdicts = []
        for k, u in enumerate(path.control):
            self.advance(path.states[k], self.inside(u, 1e-13))
            try:
                d = self.stepper.derivative()
            except ModelError as error:
                raise ModelError(f"step {k}, at t = {path.states[k].t:g} s: {error}") from error
            A[k], B[k] = d.A, d.B
            verdicts.append(d.smoothness)
        return Slopes(A, B, verdicts)

    def difference(self, a: State, b: State) -> Array:
        """Return b - a, shape (2 n_v,)."""
        return np.concatenate([self.model.difference(a.q, b.q), b.p - a.p])

    def shift(self, state: State, dx: Array) -> State:
        """Return the state dx from another."""
        n = self.model.n_v
        return State(state.t, self.model.integrate(state.q, dx[:n]), state.p + dx[n:])

    def velocity_slopes(self, state: State) -> tuple[Array, Array]:
        """Return v, shape (n_v,), and its derivative by q and p, (n_v, 2 n_v).

        v = M^-1 p, so M dv = dp - L_vq dq.
        """
        v = self.model.velocity(state)
        L = self.model.lagrangian(state.q, v)
        inverse = np.linalg.inv(L.L_vv)
        return v, np.hstack([-inverse @ L.L_vq, inverse])


def count_impacts(before: Mapping[str, int], report: StepReport) -> dict[str, int]:
    """Return the impacts by pair with those of one step more."""
    if not report.impacts:
        return before if isinstance(before, dict) else dict(before)
    after = dict(before)
    for impact in report.impacts:
        for pair in set(impact.pairs):
            after[pair] = after.get(pair, 0) + 1
    return after


def iterated(count: int) -> str:
    """Return a count of iterations in words."""
    return "1 iteration" if count == 1 else f"{count} iterations"


def ball_blocks(model: Model) -> list[slice]:
    """Return where in v the angular velocities of free and ball joints are."""
    blocks = []
    for joint in model.joints:
        if joint.type in (JointType.spherical, JointType.floating) and joint.velocities:
            last = joint.velocities[-1] + 1
            blocks.append(slice(last - 3, last))
    return blocks


def cross_matrix(a: Array) -> Array:
    """Return [a], (3, 3), with [a] b = a x b."""
    x, y, z = a
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def turn_slopes(theta: Array) -> Array:
    """Return J, (3, 3), with log(exp(eta) exp(theta)) = theta + J eta to first order.

    The inverse of SO(3)'s left Jacobian: 1 - [theta]/2 + c [theta]^2.
    """
    W = cross_matrix(theta)
    angle = float(np.linalg.norm(theta))
    if angle < 1e-3:  # the series; the closed form cancels
        c = 1 / 12 + angle**2 / 720
    else:
        c = (1 - 0.5 * angle / np.tan(0.5 * angle)) / angle**2
    return np.asarray(np.eye(3) - 0.5 * W + c * W @ W)


def difference_slopes(blocks: Sequence[slice], dq: Array) -> Array:
    """Return how a difference dq = q - q* moves with q, (n_v, n_v): 1 but for balls."""
    J = np.eye(len(dq))
    for block in blocks:
        J[block, block] = turn_slopes(dq[block])
    return J


def to_rows(model: Model, controls: npt.ArrayLike | int) -> Array:
    """Return controls as an array (N, n_u), zeros for a number N of steps, or raise ModelError."""
    if not isinstance(controls, int):
        return to_controls(model, controls)
    if not controls > 0:
        raise ModelError(f"controls is {controls}; it is positive")
    return np.zeros((controls, model.n_u))


def to_controls(model: Model, controls: npt.ArrayLike) -> Array:
    """Return controls as an array (N, n_u), or raise ModelError."""
    if model.n_u == 0:
        raise ModelError(
            "the model has no actuators, so there is nothing to choose; "
            "ModelBuilder.add_motor adds one"
        )
    array = np.array(controls, dtype=float)
    if array.ndim == 1 and model.n_u == 1:
        array = array[:, None]
    if array.ndim != 2 or array.shape[1] != model.n_u or len(array) == 0:
        raise ModelError(
            f"controls have shape {array.shape}; they are (steps, n_u), a row for each step, with "
            f"n_u = {model.n_u}: {', '.join(model.control_names)}"
        )
    if not np.all(np.isfinite(array)):
        k = int(np.argmin(np.isfinite(array).all(axis=1)))
        raise ModelError(f"controls of step {k} are not finite: {array[k]}")
    return array


def to_bounds(
    model: Model, bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None
) -> tuple[Array, Array]:
    """Return the least and greatest controls, (n_u,) each: given, else the actuators' ranges."""
    if bounds is None:
        limits = np.asarray(model.control_limits).reshape(-1, 2)
        return limits[:, 0].copy(), limits[:, 1].copy()
    try:
        low, high = (np.broadcast_to(np.asarray(b, float), (model.n_u,)) for b in bounds)
    except ValueError as error:
        raise ModelError(
            f"bounds are two numbers, or two arrays of shape ({model.n_u},), the least and the "
            f"greatest controls: {error}"
        ) from error
    if not np.all(low <= high):
        i = int(np.argmin(low <= high))
        raise ModelError(
            f"bounds of {model.control_names[i]}: the least, {low[i]:g}, is above the greatest, "
            f"{high[i]:g}"
        )
    return low.copy(), high.copy()
