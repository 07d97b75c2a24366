"""iLQR: controls that make a cost small, by Newton steps of Gauss's kind through impacts."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, State, StepError
from saltus.optimize.costs import Cost, Expansions, check_cost, expand, total
from saltus.optimize.curvature import Curvature
from saltus.optimize.plan import Plan
from saltus.optimize.riccati import Feedback, backward
from saltus.optimize.system import (
    Array,
    Rollout,
    Slopes,
    System,
    count_impacts,
    to_bounds,
    to_controls,
)
from saltus.runs.progress import Progress, progress_bar

SHORTEST = 2.0**-12  # of the line search
LEAST_DAMPING, MOST_DAMPING = 1e-8, 1e10  # relative to the cost's curvature by u


def follow(
    system: System, path: Rollout, by: Feedback, alpha: float, bounds: tuple[Array, Array]
) -> Rollout | None:
    """Return the steps with feedback about a rollout, None where a step fails.

    Where the motion has done other impacts than the rollout at the same step, they differ by a
    jump, and the feedback is left out.
    """
    x, done = path.states[0], dict[str, int]()
    out = Rollout([x], np.empty_like(path.control), [done])
    for k, u in enumerate(path.control):
        own = u + alpha * by.open[k]
        if done == path.impacts[k]:
            own = own + by.gain[k] @ system.difference(path.states[k], x)
        own = np.clip(own, *bounds)
        try:
            x = system.advance(x, own)
        except (StepError, ModelError):
            return None
        if not (np.all(np.isfinite(x.q)) and np.all(np.isfinite(x.p))):
            return None
        done = count_impacts(done, system.stepper.report)
        out.control[k] = own
        out.states.append(x)
        out.impacts.append(done)
    return out


@dataclass
class Search:
    """The best controls so far, and how they were reached."""

    path: Rollout
    cost: float
    costs: list[float]
    decrements: list[float] = field(default_factory=list)
    damping: float = 0.0
    gain: Array | None = None
    slopes: Slopes | None = None
    message: str = ""
    converged: bool = False

    def enough(self, tolerance: float) -> float:
        """Return what is too little to gain: a part of the cost, and rounding of squares."""
        return max(tolerance * abs(self.cost), 1e-28 * abs(self.costs[0]))

    def damp(self, factor: float, unit: float) -> bool:
        """Raise the damping; whether it may still grow."""
        self.damping = max(self.damping * factor, LEAST_DAMPING * unit)
        return self.damping <= MOST_DAMPING * unit


def curvature_unit(cost: Expansions, slopes: Slopes) -> float:
    """Return a typical curvature of the cost by a control, the unit of the damping."""
    uu = float(np.abs(cost.uu).max(initial=0.0))
    last = np.einsum("kij,il,klm->kjm", slopes.B, cost.xx[-1], slopes.B)
    return max(uu, float(np.abs(last).max(initial=0.0)), 1e-12)


def find_feedback(
    system: System,
    cost: Cost,
    terms: Expansions,
    search: Search,
    bounds: tuple[Array, Array],
    second_order: bool,
) -> Feedback | None:
    """Return the step of this iteration: Newton's where the cost is convex, else Gauss-Newton's."""
    assert search.slopes is not None
    unit = curvature_unit(terms, search.slopes)
    path = search.path
    if second_order:
        bent = Curvature(system, cost, path)
        found = backward(terms, search.slopes, path.control, bounds, search.damping, bent)
        if found is not None:
            return found
    while True:
        found = backward(terms, search.slopes, path.control, bounds, search.damping)
        if found is not None:
            return found
        if not search.damp(10.0, unit):
            return None


def improve(
    system: System,
    cost: Cost,
    search: Search,
    bounds: tuple[Array, Array],
    tolerance: float,
    second_order: bool,
) -> bool:
    """Make one iteration; whether another is worth while."""
    terms = expand(system, cost, search.path)
    search.slopes = system.linearize(search.path)
    unit = curvature_unit(terms, search.slopes)
    while True:
        by = find_feedback(system, cost, terms, search, bounds, second_order)
        if by is None:
            search.message = "the cost's second derivatives have no minimum, damped or not"
            return False
        if search.gain is None:
            search.gain = by.gain
        is_damped = search.damping > 1e-6 * unit  # promises less than there is to gain
        if by.decrement <= 0 or (not is_damped and by.decrement <= search.enough(tolerance)):
            search.gain, search.converged = by.gain, True
            search.decrements.append(by.decrement)
            search.message = f"converged: {by.decrement:.1e} of the cost is left to gain"
            if by.decrement == 0 and search.cost > 0 and len(search.costs) == 1:
                search.message = (
                    "the controls do not change the cost, to first order: a motion that hits "
                    "nothing has no derivative by what it would hit"
                )
            return False
        alpha = 1.0
        while alpha >= SHORTEST:
            trial = follow(system, search.path, by, alpha, bounds)
            value = total(system, cost, trial) if trial is not None else np.inf
            promised = alpha * by.linear + alpha**2 * by.square
            if trial is not None and value - search.cost <= 1e-4 * promised:
                search.decrements.append(by.decrement)
                search.path, search.cost, search.gain = trial, value, by.gain
                search.costs.append(value)
                search.damping = (
                    0.0
                    if search.damping <= LEAST_DAMPING * unit
                    else (search.damping * (0.03 if alpha == 1.0 else 1.0))
                )
                return True
            alpha *= 0.5
        if not is_damped and by.decrement <= 1e-9 * abs(search.cost):
            search.gain, search.converged = by.gain, True
            search.message = f"converged to rounding: {by.decrement:.1e} was to gain"
            return False
        if not search.damp(10.0, unit):
            search.message = (
                "no step along the gradient makes the cost less: it has a kink or a jump there, "
                "see Plan.smoothness"
            )
            return False


def ilqr(
    model: Model,
    start: State,
    cost: Cost,
    controls: npt.ArrayLike,
    *,
    h: float = 0.01,
    bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    iterations: int = 200,
    tolerance: float = 1e-10,
    second_order: bool = False,
    progress: bool | Progress | None = None,
    **options: object,
) -> Plan:
    """Find controls that make a cost of the motion small, through its impacts.

    Differential dynamic programming (iLQR): the steps' exact derivatives, the cost's Hessian of
    Gauss and Newton, Riccati's recursion with bounds on u (a box QP each step), and a line search
    on true steps. A step's derivative has the instants and impulses of its impacts in it, so a
    motion may gain, lose and shift impacts while it improves.

    Parameters
    ----------
    model : Model
        With actuators.
    start : State
    cost : Cost
        `Quadratic`, `Residuals` or a class with `stage` and `final`.
    controls : array_like, shape (N, n_u)
        The guess, a row for each step.
    h : float
        [s] time step.
    bounds : tuple of two array_like, shape (n_u,), optional
        Least and greatest controls; default: the ranges of the actuators, `Model.control_limits`.
    iterations : int
        At most.
    tolerance : float
        It ends where the next iteration promises less than this part of the cost.
    second_order : bool
        Newton's method, with the curvature of steps and costs: exact of smooth steps without balls
        (`Stepper.hessian`), else by differences of gradients, for 4 n_v + 2 n_u more steps a step.
        It converges quadratically where the cost that remains is not small; Gauss and Newton's way
        then converges linearly.
    progress : bool or callable, optional
        As in `simulate`; the completed fraction of `iterations`.
    **options
        Further options of `Stepper`.

    Returns
    -------
    Plan
        The best controls, also where it is not `converged`: `message` says why it ended. Ctrl-C
        ends it early.

    Raises
    ------
    ModelError
        Where arguments do not fit the model, or a step has no derivative: which step, and why.
    StepError
        Where a step from the guess fails.

    Notes
    -----
    An impact that the guess does not have has no derivative: start from a motion that hits.
    After Tassa, Mansard and Todorov, "Control-limited differential dynamic programming", 2014.
    """
    system = System(model, h, options)
    limits = to_bounds(model, bounds)
    guess = np.clip(to_controls(model, controls), *limits)
    check_numbers(start, {"iterations": iterations, "tolerance": tolerance})
    check_cost(cost, len(guess))
    path = system.roll(start, guess)
    value = total(system, cost, path)
    search = Search(path, value, [value])
    with progress_bar(progress, iterations, "iterations") as report:
        try:
            for i in range(iterations):
                if not improve(system, cost, search, limits, tolerance, second_order):
                    break
                if report is not None:
                    report((i + 1) / iterations)
            else:
                search.message = f"{iterations} iterations were not enough"
        except KeyboardInterrupt:
            search.message = f"stopped after {len(search.costs) - 1} iterations"
            print(f"saltus: {search.message}; the plan is the best so far", file=sys.stderr)
    return to_plan(system, search, limits)


def to_plan(system: System, search: Search, bounds: tuple[Array, Array]) -> Plan:
    """Return what a search has found."""
    path = search.path
    gain = search.gain
    if gain is None:  # stopped before there was one
        gain = np.zeros((len(path), system.model.n_u, 2 * system.model.n_v))
    return Plan(
        system.model,
        system.h,
        path.states,
        path.control,
        gain,
        search.cost,
        search.costs,
        search.decrements,
        search.converged,
        search.message,
        search.slopes.smoothness if search.slopes is not None else [],
        system,
        path,
        bounds,
    )


def check_numbers(start: object, positive: Mapping[str, float]) -> None:
    """Raise on a start that is no State, and on numbers that are not positive."""
    if not isinstance(start, State):
        raise TypeError(f"start is a {type(start).__name__}; Model.state makes a State")
    for name, value in positive.items():
        if not value > 0:
            raise ModelError(f"{name} is {value}; it is positive")
