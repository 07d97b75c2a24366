"""A problem of shooting: what is to reach, what is unknown, the misses and their derivative."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, Smoothness, State
from saltus.optimize.system import Array, Rollout, System

MissFunction = Callable[[Array, Array], tuple[npt.ArrayLike, npt.ArrayLike]]


class Reach:
    """How far the last state is from values of some coordinates and velocities.

    Parameters
    ----------
    model : Model
    q : mapping of coordinates' names to values, optional
        [rad | m] not of a quaternion: a function of one's own compares orientations.
    v : mapping of velocities' names to values, optional
        [rad/s | m/s]

    Raises
    ------
    ModelError
        On an unknown name, a part of a quaternion, or where nothing is to reach.
    """

    def __init__(
        self,
        model: Model,
        q: Mapping[str, float] | None = None,
        v: Mapping[str, float] | None = None,
    ) -> None:
        rows, goals = [], []
        for name, value in (q or {}).items():
            i = model.coordinate(name)
            j = rate_of(model, i)
            if j is None:
                raise ModelError(
                    f"q of {name} is a part of a quaternion; a function (q, v) to misses and their "
                    "derivatives compares orientations"
                )
            rows.append((i, j))
            goals.append(float(value))
        self.q, n_q = rows, len(rows)
        self.v = [model.velocity_index(name) for name in (v or {})]
        goals += [float(value) for value in (v or {}).values()]
        if not goals:
            raise ModelError("there is nothing to reach; give q or v, mappings of names to values")
        self.goals = np.array(goals)
        self.slopes = np.zeros((len(goals), 2 * model.n_v))
        for row, (_, j) in enumerate(rows):
            self.slopes[row, j] = 1
        for row, j in enumerate(self.v):
            self.slopes[n_q + row, model.n_v + j] = 1

    def __call__(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Return the misses, (r,), and their derivatives by q and v, (r, 2 n_v)."""
        at = np.concatenate([[q[i] for i, _ in self.q], v[self.v]])
        return at - self.goals, self.slopes


def rate_of(model: Model, i: int) -> int | None:
    """Return which velocity is the rate of coordinate i, None for parts of quaternions."""
    q = model.neutral()
    for j, dv in enumerate(1e-3 * np.eye(model.n_v)):
        if abs(model.integrate(q, dv)[i] - q[i] - 1e-3) < 1e-12:
            return j
    return None


class Problem(Protocol):
    """What Newton's method solves: m unknowns, 0 at the guess, that are to make misses zero."""

    @property
    def m(self) -> int:
        """How many unknowns there are."""
        ...

    def path(self, x: Array) -> Rollout:
        """Return the motion that unknowns make."""
        ...

    def misses(self, path: Rollout) -> tuple[Array, Array]:
        """Return the misses, (r,), and their derivatives by the last state, (r, 2 n_v)."""
        ...

    def jacobian(self, path: Rollout) -> tuple[Array, list[Smoothness]]:
        """Return the derivative of the misses by the unknowns, (r, m), and verdicts on steps."""
        ...


@dataclass(frozen=True)
class Unknowns:
    """How x moves the start and the controls: q along by_q x, v by by_v x, u by by_control x."""

    by_q: Array  # (n_v, m)
    by_v: Array  # (n_v, m)
    by_control: Array  # (N, n_u, m)

    @property
    def m(self) -> int:
        """How many there are."""
        return int(self.by_q.shape[1])


def to_unknowns(
    model: Model,
    N: int,
    by_q: npt.ArrayLike | None,
    by_v: npt.ArrayLike | None,
    by_control: npt.ArrayLike | None,
) -> Unknowns:
    """Return the unknowns; where none are told, every control is one."""
    n, n_u = model.n_v, model.n_u
    if by_q is None and by_v is None and by_control is None:
        by_control = np.eye(N * n_u).reshape(N, n_u, N * n_u)
    shapes = {"by_q": (n,), "by_v": (n,), "by_control": (N, n_u)}
    given = {
        name: np.asarray(x, dtype=float)
        for name, x in (("by_q", by_q), ("by_v", by_v), ("by_control", by_control))
        if x is not None
    }
    for name, x in given.items():
        if x.shape == shapes[name]:
            given[name] = x[..., None]
        elif x.shape[:-1] != shapes[name]:
            raise ModelError(
                f"{name} has shape {x.shape}; it is {(*shapes[name], 'm')}, the last index counts "
                "the unknowns"
            )
    sizes = {name: x.shape[-1] for name, x in given.items()}
    m = next(iter(sizes.values()))
    if m == 0 or set(sizes.values()) != {m}:
        raise ModelError(f"the last index counts the unknowns, and it differs: {sizes}")
    empty = {name: np.zeros((*shape, m)) for name, shape in shapes.items()}
    return Unknowns(**{**empty, **given})


@dataclass
class Shooting:
    """A problem: what the motion starts from and what it is to reach."""

    system: System
    start: State
    control: Array
    unknowns: Unknowns
    miss: MissFunction

    @property
    def m(self) -> int:
        """How many unknowns there are."""
        return self.unknowns.m

    def path(self, x: Array) -> Rollout:
        """Return the motion that unknowns make."""
        model, by = self.system.model, self.unknowns
        start = model.state(
            model.integrate(self.start.q, by.by_q @ x),
            model.velocity(self.start) + by.by_v @ x,
            self.start.t,
        )
        return self.system.roll(start, self.control + by.by_control @ x)

    def misses(self, path: Rollout) -> tuple[Array, Array]:
        """Return the misses, (r,), and their derivatives by q and v of the last state."""
        end = path.states[-1]
        r, J = self.miss(end.q, self.system.model.velocity(end))
        residual, n = np.atleast_1d(np.asarray(r, dtype=float)), 2 * self.system.model.n_v
        slopes = np.asarray(J, dtype=float)
        if slopes.shape != (len(residual), n):
            raise ModelError(
                f"miss returned {len(residual)} misses with derivatives of shape {slopes.shape}; "
                f"they are ({len(residual)}, {n}), columns q, along velocities, then v"
            )
        return residual, slopes

    def jacobian(self, path: Rollout) -> tuple[Array, list[Smoothness]]:
        """Return the derivative of the misses by the unknowns, (r, m), and verdicts on steps."""
        system, by = self.system, self.unknowns
        n = system.model.n_v
        start, end = path.states[0], path.states[-1]
        L = system.model.lagrangian(start.q, system.model.velocity(start))
        slopes = system.linearize(path)
        dx = np.vstack([by.by_q, L.L_vq @ by.by_q + L.L_vv @ by.by_v])
        for A, B, du in zip(slopes.A, slopes.B, by.by_control, strict=True):
            dx = A @ dx + B @ du
        dv = system.velocity_slopes(end)[1] @ dx
        J = self.misses(path)[1]
        return J[:, :n] @ dx[:n] + J[:, n:] @ dv, slopes.smoothness
