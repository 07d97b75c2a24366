"""Orbits: motions that repeat, and what becomes of deviations from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, Smoothness, State
from saltus.optimize.iterate import check_numbers
from saltus.optimize.reach import rate_of
from saltus.optimize.shooting import by_newton
from saltus.optimize.system import Array, Rollout, System, difference_slopes, to_rows
from saltus.runs.progress import Progress, progress_bar
from saltus.runs.trajectory import Trajectory


@dataclass(frozen=True, eq=False, repr=False)
class Orbit:
    """What `orbit` found: one period of a motion that repeats.

    Attributes
    ----------
    start : State
    control : numpy.ndarray, shape (N, n_u)
        Of one period.
    states : list of State
        N + 1 of them; the last is the first again, but for `travel`.
    travel : numpy.ndarray, shape (n_v,)
        [rad | m] how far a period moves the coordinates, along velocities: 0 but for those that are
        free.
    miss : float
        The largest difference of the last state from the first.
    misses : list of float
        Before the first iteration, and after each.
    converged : bool
    message : str
        Why it ended.
    monodromy : numpy.ndarray, shape (2 n_v, 2 n_v)
        The derivative of the last state by the first, both (q, p), q along velocities.
    multipliers : numpy.ndarray, shape (2 n_v - free,)
        Floquet's: the eigenvalues of the monodromy without the coordinates that are free, from the
        largest to the least. A period multiplies deviations by them: the orbit attracts where all
        are within the unit circle.
    smoothness : list of Smoothness
        The verdict on the derivative of each step.
    """

    start: State
    control: Array
    states: list[State]
    travel: Array
    miss: float
    misses: list[float]
    converged: bool
    message: str
    monodromy: Array
    multipliers: npt.NDArray[np.complex128]
    smoothness: list[Smoothness]
    _system: System

    def run(self, periods: int = 1, *, record_contacts: bool = False) -> Trajectory:
        """Return the motion as a run, to plot, save and play.

        Parameters
        ----------
        periods : int
        record_contacts : bool
            As in `simulate`.
        """
        check_numbers(self.start, {"periods": periods})
        control = np.tile(self.control, (periods, 1))
        return self._system.run(self.start, len(control), control, record_contacts=record_contacts)

    def __repr__(self) -> str:
        largest = float(np.abs(self.multipliers).max())
        return (
            f"Orbit({len(self.control)} steps of {self._system.h:g} s, miss {self.miss:.1e}, "
            f"largest multiplier {largest:.4g}: {self.message})"
        )


@dataclass
class Return:
    """The problem of an orbit: the start, moved by x, is to come back.

    x and the misses are differences of (q, p) without the coordinates that are free.
    """

    system: System
    start: State
    control: Array
    kept: npt.NDArray[np.intp]

    @property
    def m(self) -> int:
        """How many unknowns there are."""
        return len(self.kept)

    def path(self, x: Array) -> Rollout:
        """Return the motion that unknowns make."""
        dx = np.zeros(2 * self.system.model.n_v)
        dx[self.kept] = x
        return self.system.roll(self.system.shift(self.start, dx), self.control)

    def slopes(self, path: Rollout) -> Array:
        """Return how the difference of last state and first moves with the last."""
        n = self.system.model.n_v
        S = np.eye(2 * n)
        moved = self.system.difference(path.states[0], path.states[-1])
        S[:n, :n] = difference_slopes(self.system.balls, moved[:n])
        return S

    def misses(self, path: Rollout) -> tuple[Array, Array]:
        """Return how far the motion is from its start, and the derivative by the last state."""
        moved = self.system.difference(path.states[0], path.states[-1])
        return moved[self.kept], self.slopes(path)[self.kept]

    def monodromy(self, path: Rollout) -> tuple[Array, list[Smoothness]]:
        """Return the derivative of the last state by the first, and verdicts on steps."""
        slopes = self.system.linearize(path)
        M = np.eye(2 * self.system.model.n_v)
        for A in slopes.A:
            M = A @ M
        return M, slopes.smoothness

    def jacobian(self, path: Rollout) -> tuple[Array, list[Smoothness]]:
        """Return the derivative of the misses by the unknowns, and verdicts on steps."""
        M, verdicts = self.monodromy(path)
        self.check_free(M)
        # d = log(exp(a) exp(d) exp(-b)) moves with a by S(d), with b by -S(-d), which is -S(d)^T.
        S = self.slopes(path)
        return (S @ M - S.T)[np.ix_(self.kept, self.kept)], verdicts

    def check_free(self, M: Array) -> None:
        """Raise ModelError where the motion is not the same all along a coordinate."""
        free = np.setdiff1d(np.arange(len(M)), self.kept)
        by_free = np.abs(M[np.ix_(self.kept, free)])
        if by_free.max(initial=0.0) > 1e-8 * np.abs(M).max():
            i, j = np.unravel_index(int(by_free.argmax()), by_free.shape)
            names = self.system.model.velocity_names
            to = self.kept[i]
            raise ModelError(
                f"{names[free[j]]} is free, but the motion depends on it: in a period it moves "
                f"{'q' if to < len(names) else 'p'} of {names[to % len(names)]} by "
                f"{by_free[i, j]:.1e} for each unit; leave it out of free"
            )


def orbit(
    model: Model,
    start: State,
    controls: npt.ArrayLike | int,
    *,
    h: float = 0.01,
    free: Sequence[str] = (),
    settle: int = 0,
    iterations: int = 50,
    tolerance: float = 1e-10,
    progress: bool | Progress | None = None,
    **options: object,
) -> Orbit:
    """Find a motion that repeats under controls that repeat, and its Floquet multipliers.

    Newton's method on x -> F^N(x) - x, where F^N are the steps of a period, through their impacts.
    Its derivative, the product of the steps' own, is exact, and so are the multipliers.

    Parameters
    ----------
    model : Model
    start : State
        The guess. Let the period begin in flight: a start that a contact holds is taken as held
        wherever it moves.
    controls : array_like, shape (N, n_u), or int
        Of one period, a row for each step; or N, where controls are 0. The period is N h.
    h : float
        [s] time step.
    free : sequence of str
        Coordinates that need not come back, as that along which a gait travels. They stay at the
        start's value; nothing may depend on them.
    settle : int
        Periods that are only simulated, before the first iteration: to come near an orbit that
        attracts.
    iterations : int
        At most.
    tolerance : float
        Of the largest difference of (q, p), last state from first.
    progress : bool or callable, optional
        As in `simulate`; the completed fraction of `iterations`.
    **options
        Further options of `Stepper`.

    Returns
    -------
    Orbit
        The best found, also where it is not `converged`: `message` says why it ended.

    Raises
    ------
    ModelError
        Where arguments do not fit, a coordinate is unknown, part of a quaternion or not free, or a
        step has no derivative: which step, and why.
    StepError
        Where a step from the guess fails.

    Notes
    -----
    Where orbits are a family, as those of a motion without losses, it is the one nearest to the
    guess.
    """
    system = System(model, h, options)
    check_numbers(start, {"iterations": iterations, "tolerance": tolerance})
    if settle < 0:
        raise ModelError(f"settle is {settle}; it is a number of periods, at least 0")
    period = to_rows(model, controls)
    at = [model.coordinate(name) for name in free]
    kept = np.setdiff1d(np.arange(2 * model.n_v), [free_rate(model, i) for i in at])
    back = Return(system, settled(system, start, period, settle, at), period, kept)
    with progress_bar(progress, iterations, "iterations") as report:
        x, misses, message = by_newton(back, iterations, tolerance, report)
    path = back.path(x)
    M, verdicts = back.monodromy(path)
    multipliers = np.linalg.eigvals(M[np.ix_(kept, kept)]).astype(complex)
    last = float(np.abs(back.misses(path)[0]).max())
    return Orbit(
        path.states[0],
        period,
        path.states,
        model.difference(path.states[0].q, path.states[-1].q),
        last,
        misses,
        last <= tolerance,
        message,
        M,
        multipliers[np.argsort(-np.abs(multipliers))],
        verdicts,
        system,
    )


def settled(system: System, start: State, period: Array, periods: int, free: list[int]) -> State:
    """Return the state after some periods, back at the start's time and free coordinates."""
    x = start
    for _ in range(periods):
        end = system.roll(x, period).states[-1]
        q = end.q.copy()
        q[free] = start.q[free]
        x = State(start.t, q, end.p)
    return x


def free_rate(model: Model, i: int) -> int:
    """Return the velocity that is the rate of a coordinate, or raise ModelError."""
    j = rate_of(model, i)
    if j is None:
        raise ModelError(
            f"{model.coordinate_names[i]} is a part of a quaternion; coordinates along lines and "
            "about axes can be free"
        )
    return j
