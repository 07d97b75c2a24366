"""Costs: functions of (q, v, u) with their derivatives, and sums of squares with targets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, State
from saltus.optimize.system import Array, Rollout, System, ball_blocks, difference_slopes

Expansion = tuple[float, Array, Array]
StageFunction = Callable[[int, Array, Array, Array], tuple[npt.ArrayLike, npt.ArrayLike]]
FinalFunction = Callable[[Array, Array], tuple[npt.ArrayLike, npt.ArrayLike]]


class Cost(Protocol):
    """What `ilqr` makes small: the sum of `stage` over the steps, and `final`.

    Both return value, gradient and Hessian, by (q, v, u) one after the other, and by (q, v); those
    by q along velocities. A Hessian may be that of Gauss and Newton.
    """

    def stage(self, k: int, q: Array, v: Array, u: Array) -> Expansion:
        """Return the cost of step k, from the state that it starts in, (2 n_v + n_u,)."""
        ...

    def final(self, q: Array, v: Array) -> Expansion:
        """Return the cost of the last state, (2 n_v,)."""
        ...


@dataclass(frozen=True)
class Expansions:
    """A cost along a rollout to second order, by x = (q, p) and u."""

    value: float
    x: Array  # (N + 1, 2 n_v)
    u: Array  # (N, n_u)
    xx: Array  # (N + 1, 2 n_v, 2 n_v)
    uu: Array  # (N, n_u, n_u)
    ux: Array  # (N, n_u, 2 n_v)


def weight_matrix(weight: npt.ArrayLike, n: int, name: str) -> Array:
    """Return a number, a diagonal or a matrix as a matrix, (n, n), or raise ModelError."""
    W = np.asarray(weight, dtype=float)
    if W.ndim == 0:
        W = np.full(n, float(W))
    if W.shape == (n,):
        W = np.diag(W)
    if W.shape != (n, n):
        raise ModelError(
            f"{name} has shape {np.shape(weight)}; it is a number, a diagonal ({n},) or a matrix "
            f"({n}, {n})"
        )
    if not np.allclose(W, W.T):
        raise ModelError(f"{name} is not symmetric")
    least = float(np.linalg.eigvalsh(W).min(initial=0.0))  # of what is not there: 0
    if least < -1e-12 * float(np.abs(W).max(initial=1.0)):
        raise ModelError(f"{name} is not positive: its least eigenvalue is {least:g}")
    return W


class Quadratic:
    """Half of a weighted sum of squares: of distances to a target, and of controls.

    1/2 sum_k (|q_k - q*|^2 + |v_k - v*|^2 + |u_k - u*|^2) + 1/2 (|q_N - q*|^2 + |v_N - v*|^2), each
    square with a weight of its own. Differences of q are along velocities, `Model.difference`.

    Parameters
    ----------
    model : Model
    target : State, or sequence of State
        (q*, v*): one, or one for each of the N + 1 states.
    q, v, final_q, final_v : float or array_like, shape (n_v,) or (n_v, n_v)
        Weights: of all alike, a diagonal or a matrix.
    control : float or array_like, shape (n_u,) or (n_u, n_u)
        Weight of the controls in a step.
    control_target : array_like, shape (n_u,) or (N, n_u)
        u*; default 0.

    Raises
    ------
    ModelError
        Where a weight has another shape, or is not positive semidefinite.
    """

    def __init__(
        self,
        model: Model,
        target: State | list[State],
        *,
        q: npt.ArrayLike = 0.0,
        v: npt.ArrayLike = 0.0,
        control: npt.ArrayLike = 0.0,
        final_q: npt.ArrayLike = 0.0,
        final_v: npt.ArrayLike = 0.0,
        control_target: npt.ArrayLike = 0.0,
    ) -> None:
        n, m = model.n_v, model.n_u
        self.model = model
        self.blocks = ball_blocks(model)
        targets = [target] if isinstance(target, State) else list(target)
        self.targets = [(x.q, model.velocity(x)) for x in targets]
        self.q, self.v = weight_matrix(q, n, "q"), weight_matrix(v, n, "v")
        self.control = weight_matrix(control, m, "control")
        self.final_q = weight_matrix(final_q, n, "final_q")
        self.final_v = weight_matrix(final_v, n, "final_v")
        self.control_target = np.asarray(control_target, dtype=float)
        if self.control_target.ndim < 2:
            self.control_target = np.broadcast_to(self.control_target, (1, m))

    def check(self, steps: int) -> None:
        """Raise ModelError where the targets are those of another number of steps."""
        if len(self.targets) not in (1, steps + 1):
            raise ModelError(
                f"{len(self.targets)} targets for {steps} steps; give one, or one for each of the "
                f"{steps + 1} states"
            )
        if self.control_target.shape not in ((1, len(self.control)), (steps, len(self.control))):
            raise ModelError(
                f"control_target has shape {self.control_target.shape}; it is "
                f"({len(self.control)},), or ({steps}, {len(self.control)}), a row for each step"
            )

    def distance(self, k: int, q: Array, v: Array, W: Array, V: Array) -> Expansion:
        """Return the squares of the state, by (q, v)."""
        q_goal, v_goal = self.targets[min(k, len(self.targets) - 1)]
        dq, dv = self.model.difference(q_goal, q), v - v_goal
        g_q, g_v, n = W @ dq, V @ dv, len(v)
        H = np.zeros((2 * n, 2 * n))
        H[:n, :n], H[n:, n:] = W, V
        value = 0.5 * float(dq @ g_q + dv @ g_v)
        if self.blocks:
            J = difference_slopes(self.blocks, dq)
            g_q, H[:n, :n] = J.T @ g_q, J.T @ W @ J
        return value, np.concatenate([g_q, g_v]), H

    def stage(self, k: int, q: Array, v: Array, u: Array) -> Expansion:
        """Return the cost of step k, see `Cost`."""
        value, g, H = self.distance(k, q, v, self.q, self.v)
        du = u - self.control_target[min(k, len(self.control_target) - 1)]
        g_u, n = self.control @ du, len(g)
        whole = np.zeros((n + len(u), n + len(u)))
        whole[:n, :n], whole[n:, n:] = H, self.control
        return value + 0.5 * float(du @ g_u), np.concatenate([g, g_u]), whole

    def final(self, q: Array, v: Array) -> Expansion:
        """Return the cost of the last state, see `Cost`."""
        return self.distance(len(self.targets) - 1, q, v, self.final_q, self.final_v)


@dataclass(frozen=True)
class Residuals:
    """Half of the sum of squares of residuals that functions give, after Gauss and Newton.

    Parameters
    ----------
    stage : callable, optional
        `(k, q, v, u)` to residuals (r,) and their derivatives (r, 2 n_v + n_u) by q, v and u.
    last : callable, optional
        `(q, v)` of the last state to residuals (r,) and derivatives (r, 2 n_v).
    """

    steps: StageFunction | None = None
    last: FinalFunction | None = None

    def stage(self, k: int, q: Array, v: Array, u: Array) -> Expansion:
        """Return the cost of step k, see `Cost`."""
        n = 2 * len(v) + len(u)
        if self.steps is None:
            return 0.0, np.zeros(n), np.zeros((n, n))
        return squares(*self.steps(k, q, v, u), n, f"the residuals of step {k}")

    def final(self, q: Array, v: Array) -> Expansion:
        """Return the cost of the last state, see `Cost`."""
        n = 2 * len(v)
        if self.last is None:
            return 0.0, np.zeros(n), np.zeros((n, n))
        return squares(*self.last(q, v), n, "the residuals of the last state")


def squares(r: npt.ArrayLike, J: npt.ArrayLike, n: int, what: str) -> Expansion:
    """Return half of |r|^2, its gradient and J^T J."""
    residual = np.atleast_1d(np.asarray(r, dtype=float))
    slopes = np.asarray(J, dtype=float).reshape(-1, n) if np.size(J) else np.zeros((0, n))
    if slopes.shape != (len(residual), n):
        raise ModelError(
            f"{what} are {len(residual)} with derivatives of shape {np.shape(J)}; they are "
            f"({len(residual)}, {n}), columns q, v and, in steps, u"
        )
    return 0.5 * float(residual @ residual), slopes.T @ residual, slopes.T @ slopes


def total(system: System, cost: Cost, path: Rollout) -> float:
    """Return the cost of a rollout."""
    value = 0.0
    for k, u in enumerate(path.control):
        x = path.states[k]
        value += cost.stage(k, x.q, system.model.velocity(x), u)[0]
    x = path.states[-1]
    return float(value + cost.final(x.q, system.model.velocity(x))[0])


def to_state(system: System, x: State, g: Array, H: Array) -> tuple[Array, Array]:
    """Return gradient and Hessian by (q, p, u) of those by (q, v, u)."""
    n = system.model.n_v
    slopes = system.velocity_slopes(x)[1]
    T = np.eye(len(g))
    T[n : 2 * n, : 2 * n] = slopes
    return T.T @ g, T.T @ H @ T


def expand(system: System, cost: Cost, path: Rollout) -> Expansions:
    """Return a cost along a rollout to second order, that of v(q, p) left out."""
    n, m, N = 2 * system.model.n_v, system.model.n_u, len(path)
    out = Expansions(
        0.0,
        np.zeros((N + 1, n)),
        np.zeros((N, m)),
        np.zeros((N + 1, n, n)),
        np.zeros((N, m, m)),
        np.zeros((N, m, n)),
    )
    value = 0.0
    for k, x in enumerate(path.states):
        v = system.model.velocity(x)
        term = cost.stage(k, x.q, v, path.control[k]) if k < N else cost.final(x.q, v)
        check(term, n + m if k < N else n, f"step {k}" if k < N else "the last state")
        g, H = to_state(system, x, term[1], term[2])
        value += term[0]
        out.x[k], out.xx[k] = g[:n], H[:n, :n]
        if k < N:
            out.u[k], out.uu[k], out.ux[k] = g[n:], H[n:, n:], H[n:, :n]
    return Expansions(float(value), out.x, out.u, out.xx, out.uu, out.ux)


def check(term: Expansion, n: int, what: str) -> None:
    """Raise ModelError where a cost's function returned something else than an expansion."""
    if np.ndim(term[0]) != 0 or np.shape(term[1]) != (n,) or np.shape(term[2]) != (n, n):
        raise ModelError(
            f"the cost of {what} is a value, a gradient ({n},) and a Hessian ({n}, {n}); it has "
            f"shapes {[np.shape(each) for each in term]}"
        )
    if not (np.isfinite(term[0]) and np.all(np.isfinite(term[1])) and np.all(np.isfinite(term[2]))):
        raise ModelError(f"the cost of {what} or its derivatives are not finite")


def check_cost(cost: object, steps: int) -> None:
    """Raise where a cost has no functions, or targets of another number of steps."""
    if not (callable(getattr(cost, "stage", None)) and callable(getattr(cost, "final", None))):
        raise TypeError(
            f"cost is a {type(cost).__name__}; it is a Quadratic, Residuals, or has the methods "
            "stage and final of optimize.Cost"
        )
    if isinstance(cost, Quadratic):
        cost.check(steps)
