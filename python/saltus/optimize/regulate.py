"""Linear-quadratic feedback: about an equilibrium, and along a motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, State
from saltus.optimize.costs import Quadratic, expand
from saltus.optimize.plan import Plan, Policy
from saltus.optimize.riccati import backward
from saltus.optimize.system import (
    Array,
    Rollout,
    System,
    count_impacts,
    to_bounds,
    to_controls,
)
from saltus.runs.gradient import step_options
from saltus.runs.moment import Moment
from saltus.runs.trajectory import Trajectory


@dataclass(frozen=True, eq=False, repr=False)
class Regulator:
    """u = u* + gain (x - x*), x = (q, p), within bounds: a control for `simulate`.

    Attributes
    ----------
    target : State
    control : numpy.ndarray, shape (n_u,)
        u*, that holds the target.
    gain : numpy.ndarray, shape (n_u, 2 n_v)
    to_go : numpy.ndarray, shape (2 n_v, 2 n_v)
        The cost to go is half of x . to_go x.
    multipliers : numpy.ndarray, shape (2 n_v,)
        Of a step with feedback: what deviations are multiplied by; all within the unit circle.
    """

    target: State
    control: Array
    gain: Array
    to_go: Array
    multipliers: npt.NDArray[np.complex128]
    _system: System
    _bounds: tuple[Array, Array]

    def at(self, state: State) -> Array:
        """Return u at a state, shape (n_u,)."""
        u = self.control + self.gain @ self._system.difference(self.target, state)
        return np.asarray(np.clip(u, *self._bounds))

    def __call__(self, moment: Moment) -> Array:
        """Return u for `simulate`, which asks before each step."""
        return self.at(moment.state)

    def __repr__(self) -> str:
        slowest = float(np.abs(self.multipliers).max())
        return (
            f"Regulator({self.gain.shape[0]} controls, a step takes the slowest to {slowest:.4g})"
        )


def lqr(
    model: Model,
    target: State,
    *,
    q: npt.ArrayLike = 1.0,
    v: npt.ArrayLike = 0.0,
    control: npt.ArrayLike = 1.0,
    hold: npt.ArrayLike | None = None,
    h: float = 0.01,
    bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    **options: object,
) -> Regulator:
    """Return the feedback that keeps a model at an equilibrium at the least cost.

    Of the discrete steps: A and B are `Stepper.derivative`'s at the target, and the feedback the
    limit of Riccati's recursion for 1/2 sum (|dq|^2 + |dv|^2 + |du|^2), with these weights.

    Parameters
    ----------
    model : Model
        With actuators.
    target : State
        At rest; it may be unstable.
    q, v : float or array_like, shape (n_v,) or (n_v, n_v)
        Weights: of all alike, a diagonal or a matrix.
    control : float or array_like, shape (n_u,) or (n_u, n_u)
        Likewise.
    hold : array_like, shape (n_u,), optional
        Controls that hold the target; default 0.
    h : float
        [s] time step.
    bounds : tuple of two array_like, shape (n_u,), optional
        Least and greatest controls; default: `Model.control_limits`.
    **options
        Further options of `Stepper`.

    Returns
    -------
    Regulator

    Raises
    ------
    ModelError
        Where the target is no equilibrium, a weight does not fit, the controls' is not positive
        definite, or what is unstable cannot be reached by the controls, or is not seen by the cost.

    Notes
    -----
    The recursion by doubling (SDA), 2^k steps in k: Chu, Fan and Lin 2005.
    """
    system = System(model, h, options)
    given = np.zeros(model.n_u) if hold is None else np.atleast_1d(np.asarray(hold, dtype=float))
    if given.shape != (model.n_u,):
        raise ModelError(
            f"hold has shape {given.shape}; it is ({model.n_u},): {', '.join(model.control_names)}"
        )
    u = to_controls(model, given[None])
    cost = Quadratic(model, target, q=q, v=v, control=control, control_target=u[0])
    least = float(np.linalg.eigvalsh(cost.control)[0])
    if not least > 0:
        raise ModelError(f"control is not positive definite: its least eigenvalue is {least:g}")
    path = system.roll(target, u)
    moved = system.difference(target, path.states[1])
    if float(np.abs(moved).max()) > 1e-9 * max(1.0, h):
        i = int(np.abs(moved).argmax())
        name = model.velocity_names[i % model.n_v]
        raise ModelError(
            f"the target is no equilibrium: a step moves {'q' if i < model.n_v else 'p'} of {name} "
            f"by {moved[i]:.1e}; give the controls that hold it as hold, Model.inverse_dynamics "
            "tells the forces"
        )
    slopes, terms = system.linearize(path), expand(system, cost, path)
    A, B, Q, R = slopes.A[0], slopes.B[0], terms.xx[0], terms.uu[0]
    P = doubled_riccati(A, B, Q, R)
    gain = -np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    multipliers = np.linalg.eigvals(A + B @ gain)
    worst = float(np.abs(multipliers).max())
    if not worst < 1:
        raise ModelError(
            f"no feedback of these controls and weights keeps the target: a step takes a deviation "
            f"to {worst:.6g} of it; a mode that is unstable is not reached, or has no weight"
        )
    return Regulator(target, u[0], gain, P, multipliers, system, to_bounds(model, bounds))


def doubled_riccati(A: Array, B: Array, Q: Array, R: Array) -> Array:
    """Return P = Q + A^T P (1 + G P)^-1 A with G = B R^-1 B^T."""
    G, H, one = B @ np.linalg.solve(R, B.T), Q.copy(), np.eye(len(A))
    for _ in range(60):  # 2^60 steps
        before = H
        try:
            with np.errstate(over="ignore", invalid="ignore"):
                W = np.linalg.inv(one + G @ H)
                H = H + A.T @ H @ W @ A
                G = G + A @ W @ G @ A.T
                A = A @ W @ A
                H, G = 0.5 * (H + H.T), 0.5 * (G + G.T)
        except np.linalg.LinAlgError:
            break
        if not np.all(np.isfinite(H)):
            break
        if np.abs(H - before).max() <= 1e-15 * np.abs(H).max():
            return np.asarray(H)
    raise ModelError(
        "Riccati's equation has no solution: a mode that is unstable is not reached by the "
        "controls, or a mode that does not die out has no weight"
    )


def lqr_along(
    motion: Trajectory | Plan,
    *,
    q: npt.ArrayLike = 1.0,
    v: npt.ArrayLike = 0.0,
    control: npt.ArrayLike = 1.0,
    final_q: npt.ArrayLike = 0.0,
    final_v: npt.ArrayLike = 0.0,
    bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
) -> Policy:
    """Return the feedback that keeps a model to a motion, through its impacts.

    Riccati's recursion along the steps' exact derivatives.

    Parameters
    ----------
    motion : Trajectory or Plan
        A run with a row for each step, of a model with actuators.
    q, v, control, final_q, final_v : float or array_like
        Weights of deviations as in `Quadratic`.
    bounds : tuple of two array_like, shape (n_u,), optional
        As in `lqr`.

    Returns
    -------
    Policy
        A control for `simulate`.

    Raises
    ------
    ModelError
        Where a weight does not fit, the run has no row for each step, or a step has no derivative.
    """
    system, path = path_of(motion)
    cost = Quadratic(
        system.model,
        path.states,
        q=q,
        v=v,
        control=control,
        final_q=final_q,
        final_v=final_v,
        control_target=path.control,
    )
    limits = to_bounds(system.model, bounds)
    everywhere = np.full(system.model.n_u, np.inf)
    found = backward(
        expand(system, cost, path),
        system.linearize(path),
        path.control,
        (-everywhere, everywhere),
        0.0,
    )
    if found is None:
        raise ModelError("some control changes no cost; give control a positive weight")
    return Policy(system, path, found.gain, limits)


def path_of(motion: Trajectory | Plan) -> tuple[System, Rollout]:
    """Return the steps of a motion."""
    if isinstance(motion, Plan):
        return motion._system, motion._path
    if not isinstance(motion, Trajectory):
        raise TypeError(f"motion is a {type(motion).__name__}; it is a Trajectory or a Plan")
    options = step_options(motion)
    assert motion.model is not None  # step_options asks for one
    system = System(motion.model, motion.options.h, options)
    control = to_controls(motion.model, motion.control[:-1])
    states = [State(*row) for row in zip(motion.t, motion.q, motion.p, strict=True)]
    done = [dict[str, int]()]
    for x, u in zip(states, control, strict=False):
        system.advance(x, u)
        done.append(count_impacts(done[-1], system.stepper.report))
    return system, Rollout(states, control, done)
