"""Shooting: a few unknowns that make a miss zero, by Newton's method through impacts."""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, Smoothness, State, StepError
from saltus.optimize.iterate import check_numbers
from saltus.optimize.reach import MissFunction, Problem, Shooting, to_unknowns
from saltus.optimize.system import Array, Rollout, System, iterated, to_rows
from saltus.runs.progress import Progress, progress_bar
from saltus.runs.trajectory import Trajectory


@dataclass(frozen=True, eq=False, repr=False)
class Shot:
    """What `shoot` found.

    Attributes
    ----------
    x : numpy.ndarray, shape (m,)
        The unknowns.
    start : State
    control : numpy.ndarray, shape (N, n_u)
    states : list of State
        N + 1 of them.
    miss : float
        The largest of the last misses.
    misses : list of float
        Before the first iteration, and after each.
    converged : bool
    message : str
        Why it ended.
    smoothness : list of Smoothness
        The verdict on the derivative of each step.
    """

    x: Array
    start: State
    control: Array
    states: list[State]
    miss: float
    misses: list[float]
    converged: bool
    message: str
    smoothness: list[Smoothness]
    _system: System

    def run(self) -> Trajectory:
        """Return the motion as a run, to plot, save and play."""
        return self._system.run(self.start, len(self.control), self.control)

    def __repr__(self) -> str:
        many = iterated(len(self.misses) - 1)
        return f"Shot(miss {self.miss:.1e}, {many}: {self.message})"


def shoot(
    model: Model,
    start: State,
    controls: npt.ArrayLike | int,
    miss: MissFunction,
    *,
    h: float = 0.01,
    by_q: npt.ArrayLike | None = None,
    by_v: npt.ArrayLike | None = None,
    by_control: npt.ArrayLike | None = None,
    iterations: int = 50,
    tolerance: float = 1e-12,
    method: str = "newton",
    bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    progress: bool | Progress | None = None,
    **options: object,
) -> Shot:
    """Find unknowns of a start and of controls that make misses of the last state zero.

    Newton's method on the exact derivatives of the steps: of fewer misses than unknowns the
    shortest step, of more the least squares. Each step is halved until it makes the misses less,
    so that an impact which the motion needs is not lost.

    Parameters
    ----------
    model : Model
    start : State
        The guess.
    controls : array_like, shape (N, n_u), or int
        The guess, a row for each step; or N, where controls are 0.
    miss : callable
        `(q, v)` of the last state to misses (r,) and their derivatives (r, 2 n_v) by q, along
        velocities, and v. `Reach` is one.
    h : float
        [s] time step.
    by_q, by_v : array_like, shape (n_v, m), optional
        How the m unknowns x move the start: q along by_q x, v by by_v x.
    by_control : array_like, shape (N, n_u, m), optional
        Likewise for the controls. Where none of the three is given, every control is an unknown.
    iterations : int
        At most.
    tolerance : float
        Of the largest miss.
    method : str
        "newton", or "least_squares" of SciPy, with `bounds`.
    bounds : tuple of two array_like, shape (m,), optional
        Least and greatest x, which are 0 at the guess. For "least_squares" alone.
    progress : bool or callable, optional
        As in `simulate`; the completed fraction of `iterations`.
    **options
        Further options of `Stepper`.

    Returns
    -------
    Shot
        The best found, also where it is not `converged`: `message` says why it ended.

    Raises
    ------
    ModelError
        Where arguments do not fit, the misses do not depend on the unknowns, or a step has no
        derivative: which step, and why.
    StepError
        Where a step from the guess fails.
    """
    system = System(model, h, options)
    check_numbers(start, {"iterations": iterations, "tolerance": tolerance})
    guess = to_rows(model, controls)
    unknowns = to_unknowns(model, len(guess), by_q, by_v, by_control)
    problem = Shooting(system, start, guess, unknowns, miss)
    if method == "least_squares":
        x, misses, message = by_scipy(problem, bounds, iterations, tolerance)
    elif method == "newton":
        if bounds is not None:
            raise ModelError('bounds are for method="least_squares"; Newton\'s has none')
        with progress_bar(progress, iterations, "iterations") as report:
            x, misses, message = by_newton(problem, iterations, tolerance, report)
    else:
        raise ModelError(f'method is {method!r}; it is "newton" or "least_squares"')
    path = problem.path(x)
    last = float(np.abs(problem.misses(path)[0]).max())
    return Shot(
        x,
        path.states[0],
        path.control,
        path.states,
        last,
        misses,
        last <= tolerance,
        message,
        problem.jacobian(path)[1],
        system,
    )


def by_newton(
    problem: Problem, iterations: int, tolerance: float, report: Progress | None
) -> tuple[Array, list[float], str]:
    """Return the unknowns, the misses on the way, and why it ended."""
    x = np.zeros(problem.m)
    path = problem.path(x)
    r = problem.misses(path)[0]
    misses = [float(np.abs(r).max())]
    message = f"{iterations} iterations were not enough"
    try:
        for i in range(iterations):
            if misses[-1] <= tolerance:
                break
            J = problem.jacobian(path)[0]
            step = np.asarray(-np.linalg.lstsq(J, r, rcond=1e-13)[0], dtype=float)
            if not np.any(J):
                raise ModelError(
                    "the misses do not depend on the unknowns: a motion that hits nothing has no "
                    "derivative by what it would hit; start from one that does"
                )
            found = shorter(problem, x, step, r)
            if found is None:
                message = f"no part of Newton's step makes the miss of {misses[-1]:.1e} less"
                break
            x, path, r = found
            misses.append(float(np.abs(r).max()))
            if report is not None:
                report((i + 1) / iterations)
    except KeyboardInterrupt:
        message = f"stopped after {len(misses) - 1} iterations"
        print(f"saltus: {message}; what it returns is the best so far", file=sys.stderr)
    if misses[-1] <= tolerance:
        message = "converged"
    return x, misses, message


def shorter(
    problem: Problem, x: Array, step: Array, r: Array
) -> tuple[Array, Rollout, Array] | None:
    """Return the longest part 1, 1/2, 1/4 ... of a step that makes the misses less."""
    alpha = 1.0
    while alpha >= 2.0**-20:
        trial = x + alpha * step
        try:
            path = problem.path(trial)
            new = problem.misses(path)[0]
            if np.linalg.norm(new) < (1 - 1e-4 * alpha) * np.linalg.norm(r):
                return trial, path, new
        except (StepError, ModelError):  # as where the start overlaps
            pass  # as a miss
        alpha *= 0.5
    return None


def by_scipy(
    problem: Shooting,
    bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None,
    iterations: int,
    tolerance: float,
) -> tuple[Array, list[float], str]:
    """Return what SciPy's trust regions find."""
    try:
        from scipy.optimize import least_squares
    except ImportError as error:
        raise ImportError(
            'method="least_squares" needs SciPy: pip install scipy; method="newton" needs nothing'
        ) from error
    misses: list[float] = []
    best = np.zeros(problem.unknowns.m)

    def fun(x: Array) -> Array:
        return problem.misses(problem.path(x))[0]

    def jac(x: Array) -> Array:
        best[:] = x
        path = problem.path(x)
        misses.append(float(np.abs(problem.misses(path)[0]).max()))
        if misses[-1] <= tolerance:
            raise Reached
        return problem.jacobian(path)[0]

    limits = (-np.inf, np.inf) if bounds is None else bounds
    try:
        found = least_squares(
            fun,
            best.copy(),
            jac=jac,
            bounds=limits,
            max_nfev=iterations,
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
    except Reached:
        return best, misses, "converged"
    return np.asarray(found.x), misses, str(found.message)


class Reached(Exception):
    """The misses are small enough: SciPy's own tolerances are none of theirs."""
