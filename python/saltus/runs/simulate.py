"""Running a model for a while."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, TypedDict

from numpy.typing import ArrayLike

from saltus import _core
from saltus._core import (
    ImpactLaw,
    ImpactOrder,
    ImpactProblem,
    Model,
    ModelError,
    State,
    StepError,
    StepOptions,
    Wrench,
)
from saltus.records.tables import counted
from saltus.runs.moment import Moment
from saltus.runs.progress import Progress, progress_bar
from saltus.runs.trajectory import Trajectory

if TYPE_CHECKING:
    from typing_extensions import Unpack

Control = (
    Mapping[str, float]
    | ArrayLike
    | Callable[[Moment], Mapping[str, float] | ArrayLike | None]
    | None
)
Law = ImpactLaw | str | Callable[[ImpactProblem], ArrayLike]


class StepWarning(UserWarning):
    """Steps of a run lost order and energy to end at all; see `Trajectory.fallbacks`."""


class StepBounds(TypedDict, total=False):
    """The order, bounds and tolerances of `StepOptions`, as keywords."""

    order: ImpactOrder | str
    certify: bool
    max_iterations: int
    max_impacts: int
    max_halvings: int
    max_impulses: int
    rest: float
    simultaneous: float
    strict: bool


def simulate(
    model: Model,
    q: Mapping[str, object] | ArrayLike | None = None,
    v: Mapping[str, ArrayLike] | ArrayLike | None = None,
    *,
    duration: float,
    h: float = 0.01,
    law: Law = ImpactLaw.nodal_energy,
    collisions: bool = True,
    record_every: int = 1,
    record_contacts: bool = False,
    control: Control = None,
    control_every: int = 1,
    forces: Mapping[str, Wrench] | None = None,
    qfrc: Mapping[str, ArrayLike] | ArrayLike | None = None,
    state: State | None = None,
    progress: bool | Progress | None = None,
    **bounds: Unpack[StepBounds],
) -> Trajectory:
    """Run a model from a state and record it.

    Parameters
    ----------
    model : Model
    q : array_like, shape (n_q,), or mapping of names to values, or str, optional
        [rad | m] coordinates at the start; those not named are as in `Model.neutral`. A free or
        ball joint takes a Pose, a quaternion, or a SciPy Rotation by its name: see `Model`. A str
        is the name of a state of the model, `Model.state_names`.
    v : array_like, shape (n_v,), or mapping of names to values, optional
        [rad/s | m/s] velocities at the start; those not named are 0.
    duration : float
        [s] a whole number of steps.
    h : float
        [s] time step.
    law : ImpactLaw, str or callable
        Which energy impacts conserve, see `ImpactLaw`. A callable is given an `ImpactProblem` and
        returns the momenta after.
    collisions : bool
        False: bodies pass through each other.
    record_every : int
        Steps between recorded rows.
    record_contacts : bool
        Whether to record every impulse between bodies, of all steps, as `contacts` of the run:
        its point, its normal and its size.
    control : mapping of names to values, array_like or callable, optional
        What actuators are told: the same in all steps, as a mapping (those not named are 0) or an
        array of shape (n_u,); an array of shape (steps, n_u), row k in step k, the last row in all
        after it; or a function of a `Moment` that returns one of the first two, or None for no
        change. A function is asked before steps, as a digital controller is; servos of the model
        act within steps.
    control_every : int
        Steps between the times that the function is asked.
    forces : mapping of links' names to Wrench, optional
        Forces and torques on links, in all steps.
    qfrc : mapping of names to values, or array_like, shape (n_v,), optional
        [N m | N] forces on the coordinates, in all steps.
    state : State, optional
        The start in place of `q` and `v`, for instance `run.state(-1)` to continue a run.
    progress : bool or callable, optional
        None: a progress bar on a terminal when the run takes longer than 2 s; True, False: always,
        never; a callable takes the completed fraction in [0, 1] about ten times a second.
    **bounds
        `order`, `certify`, `max_iterations`, `max_impacts`, `max_halvings`,
        `max_impulses`, `rest`, `simultaneous`, `strict`: as in `StepOptions`.

    Returns
    -------
    Trajectory
        Ctrl-C ends the run early; the trajectory then has the rows computed so far and is not
        `complete`.

    Raises
    ------
    ModelError
        On a start that does not fit the model or has overlapping bodies, a duration or h that is
        not positive, a duration that is no whole number of steps, more than 16 GB of rows and
        contacts.
    StepError
        If a step does not converge or its impacts do not end.
    JammedError
        If the impulses at one instant do not end.

    Notes
    -----
    An exception that ends a run, also one that `law` or `progress` raises, has the rows computed so
    far as `error.trajectory`, a `Trajectory` that is not `complete`.
    """
    check_types(model, bounds, "simulate")
    if state is None:
        state = model.state(q, v)
    elif q is not None or v is not None:
        raise ModelError("give either state or q and v, not both")
    options = StepOptions(h, law, collisions, **bounds)
    core = _core.Trajectory(model)
    with progress_bar(progress, duration, "s") as report:
        try:
            _core.simulate(
                core,
                state,
                duration,
                options=options,
                record_every=record_every,
                record_contacts=record_contacts,
                control=control,
                control_every=control_every,
                forces=forces,
                qfrc=qfrc,
                progress=report,
            )
        except BaseException as error:
            if len(core.t):  # else nothing ran
                keep_rows(error, Trajectory.from_core(core))
            raise
    if not core.complete:
        done, end = core.t[-1] - state.t, duration
        print(
            f"saltus: stopped after {done:g} s of {end:g} s; the trajectory holds these",
            file=sys.stderr,
        )
    run = Trajectory.from_core(core)
    warn_of_time_stepping([run])
    return run


def warn_of_time_stepping(runs: Sequence[Trajectory]) -> None:
    """Warn once of arcs that lost order and energy, so that nobody takes them for others."""
    lossy = [run.fallbacks[run.fallbacks["rung"] != "halved"] for run in runs]
    arcs = sum(map(len, lossy))
    if arcs == 0:
        return
    k = next(i for i, rows in enumerate(lossy) if len(rows))
    first, energy = lossy[k][0], sum(float(rows["energy"].sum()) for rows in lossy)
    at = f" of run {k}" if len(runs) > 1 else ""
    of = f", {runs[k].pair_names[first['pair']]}" if first["pair"] >= 0 else ""
    warnings.warn(
        f"{counted(arcs, 'arc')} by time stepping, which took {-energy:.2g} J: the first at "
        f"t = {first['t']:g} s{at}{of}; see fallbacks, and "
        "strict=True makes such steps errors",
        StepWarning,
        stacklevel=3,
    )


def keep_rows(error: BaseException, run: Trajectory) -> None:
    """Set `error.trajectory`, and say so in its message if it is one of ours, else in a note."""
    with suppress(AttributeError):  # exceptions of others may refuse attributes
        error.trajectory = run  # type: ignore[attr-defined]
        text = f"the rows up to t = {run.t[-1]:g} s are its attribute `trajectory`"
        if len(run) == 1:
            return  # the start, which is known
        if isinstance(error, ModelError | StepError):
            error.args = (f"{error}; {text}",)
        elif hasattr(error, "add_note"):  # from Python 3.11 on
            error.add_note(f"saltus: {text}")


def check_types(model: object, bounds: Mapping[str, object], caller: str) -> None:
    """Raise TypeError in words; the compiled part would print all its signatures."""
    if not isinstance(model, Model):
        raise TypeError(f"model is a {type(model).__name__}; saltus.load_urdf makes a Model of it")
    for name in bounds:
        if name not in StepBounds.__annotations__:
            names = ", ".join(StepBounds.__annotations__)
            raise TypeError(f'{caller}() has no argument "{name}"; bounds of a step are {names}')
