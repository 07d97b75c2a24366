"""DMOC: optimal control with the states of all steps as unknowns, through planned impacts."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, State, StepError
from saltus.optimize.costs import Cost, check_cost
from saltus.optimize.iterate import check_numbers
from saltus.optimize.pieces import Setting
from saltus.optimize.planned import Hit, Planner, instants, neighbours, plan_of, planned_steps
from saltus.optimize.program import Program, overlaps
from saltus.optimize.reach import MissFunction
from saltus.optimize.solvers import Solution, Solver, solver_of
from saltus.optimize.system import Array, System, to_bounds, to_controls
from saltus.optimize.transcription import Transcription
from saltus.runs.progress import Progress, progress_bar

MOST_ROUNDS = 200  # of plans that are solved one after the other


def transcribe(
    model: Model,
    start: State,
    cost: Cost,
    controls: npt.ArrayLike,
    *,
    h: float = 0.01,
    impacts: Sequence[tuple[str, float]] | None = None,
    reach: MissFunction | None = None,
    states: Sequence[State] | None = None,
    bounds: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    clearance: float = 0.0,
    solver: str | Solver | None = None,
    iterations: int = 500,
    tolerance: float = 1e-8,
    progress: bool | Progress | None = None,
    **options: object,
) -> Transcription:
    """Find controls of least cost with all states as unknowns, through impacts that are planned.

    Discrete mechanics and optimal control (DMOC): the steps are constraints between states, and so
    are the gaps at planned impacts, whose instants are unknowns. A guess need not hit anything, nor
    be a motion at all. What a step with a planned impact does is what `Stepper` does, so the run of
    the controls is the motion found.

    Parameters
    ----------
    model : Model
        With actuators.
    start : State
    cost : Cost
        As in `ilqr`.
    controls : array_like, shape (N, n_u)
        The guess, a row for each step.
    h : float
        [s] time step.
    impacts : sequence of (str, float), optional
        The plan: which gap closes when, the pair's name and a guess of the time [s], in order.
        Pairs without friction, one at an instant. Default: the impacts of the guess's own run.
    reach : callable, optional
        What the last state must be, as `shoot`'s miss: `(q, v)` to misses and their derivatives.
        `Reach` is one.
    states : sequence of State, optional
        A guess of the N + 1 states; default: those that the controls and the planned impacts make.
    bounds : tuple of two array_like, shape (n_u,), optional
        Least and greatest controls; default: the ranges of the actuators, `Model.control_limits`.
    clearance : float
        [m] that gaps of pairs without a planned impact must have at the states, but the start.
        Between states they may close a little more.
    solver : str or callable, optional
        "slsqp", dense, or "trust-constr", sparse and with second derivatives, of SciPy; or a
        function from `Program` to `Solution`. Default: "slsqp" up to 400 unknowns.
    iterations : int
        At most.
    tolerance : float
        Of constraints and of the Lagrangian's gradient.
    progress : bool or callable, optional
        As in `simulate`; the completed fraction of `iterations`.
    **options
        Further options of `Stepper`.

    Returns
    -------
    Transcription
        The best found, also where it is not `converged`: `message` says why it ended. Ctrl-C ends
        it early.

    Raises
    ------
    ModelError
        Where arguments do not fit the model, an impact cannot be planned, or a step has no
        derivative: which step, and why.
    StepError
        Where a step from the guess fails.
    ImportError
        Without SciPy, where no solver of one's own is given.

    Notes
    -----
    An impact that comes to an end of its step is tried in the next, and gaps that have closed
    without a plan are held open at these states: then it is solved again, for as long as that is
    better. After Leyendecker,
    Ober-Blöbaum, Marsden and Ortiz, "Discrete mechanics and optimal control for constrained
    systems", Optimal Control Applications and Methods 31, 2010.
    """
    system, planner = System(model, h, options), Planner(model, h, options)
    limits = to_bounds(model, bounds)
    guess = np.clip(to_controls(model, controls), *limits)
    check_numbers(start, {"iterations": iterations, "tolerance": tolerance})
    check_cost(cost, len(guess))
    if not 0 <= clearance < np.inf:
        raise ModelError(f"clearance is {clearance}; it is a length, at least 0")
    solve = solver_of(solver)
    if impacts is None:
        impacts = impacts_of(system, start, guess, "the guess")
    hits, taus = plan_of(planner, start, len(guess), impacts)
    if states is None:
        states = planned_steps(planner, start, guess, hits, taus)
    elif len(states) != len(guess) + 1:
        raise ModelError(f"states are {len(states)}; of {len(guess)} steps it is one more")
    first = [start, *states[1:]]
    setting = Setting(system, planner, cost, reach, limits, first, guess, hits, taus, [], clearance)
    with progress_bar(progress, iterations, "iterations") as report:
        rounds = Rounds(solve, tolerance, iterations, report)
        program, found = rounds.best(setting)
    return to_transcription(program, found, rounds.costs)


def impacts_of(system: System, start: State, control: Array, whose: str) -> list[tuple[str, float]]:
    """Return pairs and times of the impacts of a run, or raise where none can be planned so."""
    found, x = [], start
    for k, u in enumerate(control):
        x = system.advance(x, u)
        report = system.stepper.report
        if report.sustained > 0:
            held = sorted({contact.pair for contact in report.contacts})
            raise ModelError(
                f"in step {k} of {whose} contacts stay closed: {', '.join(held)}. Impacts are "
                "planned, contacts are not; ilqr and shoot take both"
            )
        for impact in report.impacts:
            if len(set(impact.pairs)) > 1:
                raise ModelError(
                    f"in step {k} of {whose} several gaps close at once: "
                    f"{', '.join(impact.pairs)}. Impacts are planned one at an instant; ilqr and "
                    "shoot take others"
                )
            found.append((impact.pairs[0], impact.t))
    return found


@dataclass
class Rounds:
    """Plans that are solved one after the other, and the best so far."""

    solve: Solver
    tolerance: float
    iterations: int
    report: Progress | None
    costs: list[float] = field(default_factory=list)
    rounds: int = 0
    is_stopped: bool = False

    def round(self, setting: Setting) -> tuple[Program, Solution]:
        """Return the problem of a setting, and what the solver finds."""
        program = Program(setting, self.tolerance, self.iterations, self.report, len(self.costs))
        found = one_round(program, self.solve)
        self.costs += [cost for cost, _ in program.noted]
        self.rounds += 1
        self.is_stopped = (
            self.rounds >= MOST_ROUNDS
            or len(self.costs) >= self.iterations
            or found.message.startswith("stopped")
        )
        return program, found

    def cleared(self, setting: Setting) -> tuple[Program, Solution]:
        """Return what a plan comes to with gaps held open that had closed without a plan."""
        while True:
            program, found = self.round(setting)
            setting = program.setting
            closed = [each for each in overlaps(program, found.z) if each not in setting.clear]
            if self.is_stopped or not closed:
                return program, found
            setting = continued(program, found, setting.hits, found.z[program.first_tau :])
            setting = replace(setting, clear=setting.clear + closed)

    def best(self, setting: Setting) -> tuple[Program, Solution]:
        """Return the plan that no neighbour of it betters, and what it comes to."""
        program, found = self.cleared(setting)
        tried = [[(hit, 0.5) for hit in setting.hits]]
        while not self.is_stopped:
            taus, h = found.z[program.first_tau :], setting.planner.h
            least = program.key(found.z)
            for hits, durations in neighbours(program.setting.hits, taus, program.N, h):
                start = [
                    (hit, round(float(tau) / h, 1))
                    for hit, tau in zip(hits, durations, strict=True)
                ]
                if start in tried or self.is_stopped:
                    continue
                tried.append(start)
                other = self.cleared(continued(program, found, hits, durations))
                if is_as_good(other[0].key(other[1].z), least):
                    program, found = other
                    break
            else:
                break
        return program, found


def is_as_good(key: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether a result is not worse: two plans may meet at an end of a step, to rounding."""
    return (key[0], key[1] - 1e-9 * abs(key[1])) <= other


def continued(program: Program, found: Solution, hits: list[Hit], taus: Array) -> Setting:
    """Return a setting that begins where a solver ended, with another plan."""
    states, control = program.states(found.z), program.control(found.z)
    return replace(program.setting, states=states, control=control, hits=hits, taus=taus)


def one_round(program: Program, solve: Solver) -> Solution:
    """Return what a solver finds, or the best before it was stopped or failed."""
    try:
        found = solve(program)
    except KeyboardInterrupt:
        message = f"stopped after {program.done + len(program.noted)} iterations"
        print(f"saltus: {message}; what it returns is the best so far", file=sys.stderr)
        return Solution(program.best, False, message)
    except (StepError, ModelError) as error:
        if not program.noted:
            raise
        return Solution(program.best, False, f"stopped by an error: {error}")
    z = np.clip(found.z, program.low, program.high)
    return Solution(z, found.converged, found.message)


def to_transcription(program: Program, found: Solution, costs: list[float]) -> Transcription:
    """Return what was found, with a look at the run that the controls make."""
    setting, z = program.setting, found.z
    system, start = setting.system, setting.states[0]
    states, control, defect = program.states(z), program.control(z).copy(), program.defect(z)
    h = setting.planner.h
    states = [State(start.t + k * h, x.q, x.p) for k, x in enumerate(states)]
    names = [system.model.pair_name(hit.pair) for hit in setting.hits]
    times = instants(start, h, setting.hits, z[program.first_tau :])
    converged, message, drift = found.converged, found.message, np.inf
    try:
        end = system.roll(start, control).states[-1]
        drift = float(np.abs(system.difference(states[-1], end)).max())
        made = [pair for pair, _ in impacts_of(system, start, control, "this run")]
        other = made != names
        told = f"the run of the controls hits {', '.join(made) or 'nothing'}"
    except (StepError, ModelError) as error:
        other, told = True, f"the run of the controls fails: {error}"
    if defect > 10 * program.tolerance:
        converged, message = False, f"constraints are missed by {defect:.1e}: {message}"
    elif other:
        converged = False
        message = f"{told}, the plan {', '.join(names) or 'nothing'}: {message}"
    return Transcription(
        system.model,
        h,
        states,
        control,
        list(zip(names, times, strict=True)),
        program.cost(z),
        costs,
        defect,
        drift,
        converged,
        message,
        system,
    )
