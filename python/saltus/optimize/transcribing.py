"""DMOC: optimal control with the states of all steps as unknowns, through planned impacts."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError, State, StepError
from saltus.optimize.costs import Cost, check_cost
from saltus.optimize.iterate import check_numbers
from saltus.optimize.pieces import Setting
from saltus.optimize.planned import Planner, instants, moved_plan, plan_of, planned_steps
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
    An impact that comes to an end of its step goes on in the next, and gaps that have closed
    without a plan are held open at these states: then it is solved again. After Leyendecker,
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
        program, found, costs = in_rounds(setting, solve, tolerance, iterations, report)
    return to_transcription(program, found, costs)


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


def in_rounds(
    setting: Setting,
    solve: Solver,
    tolerance: float,
    iterations: int,
    report: Progress | None,
) -> tuple[Program, Solution, list[float]]:
    """Return the problem with the plan as it ended, what its solver found, and all costs."""
    seen, costs = [setting.hits], list[float]()
    best: tuple[Program, Solution] | None = None
    for _ in range(MOST_ROUNDS):
        program = Program(setting, tolerance, iterations, report, len(costs))
        found = one_round(program, solve)
        costs += [cost for cost, _ in program.noted]
        if best is None or program.key(found.z) < best[0].key(best[1].z) or setting.clear:
            best = program, found
        ended = len(costs) >= iterations or found.message.startswith("stopped")
        N, h = program.N, setting.planner.h
        taus = found.z[program.first_tau :]
        moved = moved_plan(setting.hits, taus, N, h)
        if moved is not None and moved[0] in seen:
            moved = None  # it is best at the end of a step, from both sides
        closed = [each for each in overlaps(program, found.z) if each not in setting.clear]
        if ended or (moved is None and not closed):
            break
        hits, taus = moved if moved is not None else (setting.hits, taus)
        seen.append(hits)
        setting = replace(
            setting,
            states=program.states(found.z),
            control=program.control(found.z),
            hits=hits,
            taus=taus,
            clear=setting.clear + closed,
        )
    assert best is not None  # there was a round
    return *best, costs


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
