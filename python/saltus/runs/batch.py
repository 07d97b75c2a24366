"""Running a model from many starts at once."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from saltus import _core
from saltus._core import (
    ImpactLaw,
    Model,
    ModelError,
    OnFailure,
    State,
    StepOptions,
    Wrench,
)
from saltus.records.tables import counted
from saltus.runs.batch_trajectory import BatchTrajectory
from saltus.runs.progress import Progress, progress_bar
from saltus.runs.simulate import Law, StepBounds, StepWarning, check_types, keep_rows
from saltus.runs.starts import Starts, to_controls, to_states
from saltus.runs.trajectory import Trajectory

if TYPE_CHECKING:
    from typing_extensions import Unpack


def simulate_batch(
    model: Model,
    q: Starts = None,
    v: Starts = None,
    *,
    duration: float,
    h: float = 0.01,
    law: Law = ImpactLaw.nodal_energy,
    collisions: bool = True,
    record_every: int = 1,
    record_contacts: bool = False,
    control: ArrayLike | Mapping[str, float] | None = None,
    forces: Mapping[str, Wrench] | None = None,
    qfrc: Mapping[str, ArrayLike] | ArrayLike | None = None,
    states: Sequence[State] | None = None,
    threads: int | None = None,
    on_failure: OnFailure | str = OnFailure.go_on,
    progress: bool | Progress | None = None,
    **bounds: Unpack[StepBounds],
) -> BatchTrajectory:
    """Run a model from many starts, on several threads, and record all runs.

    Every run is bitwise equal to that of `simulate` from its start, for any number of threads. The
    interpreter's lock is released meanwhile.

    Parameters
    ----------
    model : Model
    q : array_like, shape (B, n_q), or mapping of names to arrays of shape (B,), optional
        [rad | m] coordinates at the starts, a row for each run; those not named are as in
        `Model.neutral`. A value with one dimension less, (n_q,) or a number, is that of all runs.
        A free or ball joint takes all its coordinates by its name, shape (B, 7) or (B, 4), or a
        ball joint a SciPy Rotation.
    v : array_like, shape (B, n_v), or mapping of names to arrays of shape (B,), optional
        [rad/s | m/s] velocities at the starts, likewise, those not named 0.
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
        Steps between recorded rows; start and end are always recorded, and nothing else if it is
        at least duration / h.
    record_contacts : bool
        Whether to record every impulse between bodies, as `contacts` of each run `batch[i]`.
    control : mapping of names to values, or array_like, optional
        What actuators are told: the same in all runs and steps, as a mapping or shape (n_u,); of
        each run, shape (B, n_u); of each run and step, shape (B, steps, n_u), the last in all steps
        after it.
    forces : mapping of links' names to Wrench, optional
        Forces and torques on links, in all runs and steps.
    qfrc : mapping of names to values, or array_like, shape (n_v,), optional
        [N m | N] forces on the coordinates, in all runs and steps.
    states : sequence of State, optional
        The starts in place of `q` and `v`, all at the same time.
    threads : int, optional
        Number of threads; None: as many as the machine runs at once.
    on_failure : OnFailure or str
        `OnFailure.go_on`: a run with a failed step or overlapping bodies at its start is not
        `complete`; `failures` has its message, and a RuntimeWarning reports it.
        `OnFailure.stop`: its error is raised; if several runs fail, that of the lowest index.
    progress : bool or callable, optional
        None: a progress bar on a terminal when the batch takes longer than 2 s; True, False:
        always, never; a callable takes the completed fraction in [0, 1] about ten times a second.
    **bounds
        `order`, `certify`, `max_iterations`, `max_impacts`, `max_halvings`, `max_impulses`, `rest`,
        `simultaneous`, `strict`: as in `StepOptions`.

    Returns
    -------
    BatchTrajectory
        Ctrl-C ends the batch early; it then has the rows computed so far, and unfinished runs are
        not `complete`.

    Raises
    ------
    ModelError
        Before anything runs, on starts that do not fit the model or are NaN or infinite, no starts,
        a duration or h that is not positive, a duration that is no whole number of steps,
        threads < 1, more than 16 GB of rows. A run fails if its `contacts` take more than its share
        of the memory left. With `OnFailure.stop` also on overlapping bodies at a start.
    StepError, JammedError
        With `OnFailure.stop`, as `simulate`, with "run <index>: " before the message. The rows
        computed so far are `error.trajectory`.
    """
    check_types(model, bounds, "simulate_batch")
    if threads is not None and threads < 1:
        raise ModelError(f"threads = {threads}; it must be at least 1, or None for all there are")
    states = _starts(model, q, v, states)
    options = StepOptions(h, law, collisions, **bounds)
    core = _core.BatchTrajectory(model)
    with progress_bar(progress, len(states), "runs") as report:
        try:
            _core.simulate_batch(
                core,
                states,
                duration,
                options=options,
                record_every=record_every,
                record_contacts=record_contacts,
                control=to_controls(model, control, len(states)),
                forces=forces,
                qfrc=qfrc,
                threads=threads or 0,
                on_failure=on_failure,
                progress=report,
            )
        except Exception as error:  # of a run: it has its rows, as in simulate
            if core.failures:
                keep_rows(error, Trajectory.from_core(core.run(min(core.failures))))
            raise
    batch = BatchTrajectory.from_core(core)
    _tell(batch)
    if core.stepped:
        warnings.warn(
            f"{len(core.stepped)} of {counted(len(batch), 'run')} have arcs by time stepping, "
            f"which lose order and energy, run {core.stepped[0]} for one; see `fallbacks` of the "
            "run, and strict=True makes such steps errors",
            StepWarning,
            stacklevel=2,
        )
    return batch


def _starts(model: Model, q: Starts, v: Starts, states: Sequence[State] | None) -> Sequence[State]:
    """Return the states that are given in either way."""
    if states is None:
        return to_states(model, q, v)
    if q is not None or v is not None:
        raise ModelError("give either states or q and v, not both")
    for i, state in enumerate(states):
        if not isinstance(state, State):
            raise TypeError(f"states[{i}] is a {type(state).__name__}; model.state makes a State")
    return states


def _tell(batch: BatchTrajectory) -> None:
    """Say what did not end, so that nobody takes NaN for numbers."""
    runs, failures = counted(len(batch), "run"), batch.failures
    stopped = len(batch) - int(batch.complete.sum()) - len(failures)
    if stopped:
        print(
            f"saltus: stopped; {stopped} of {runs} had not ended, the batch holds what was done",
            file=sys.stderr,
        )
    if failures:
        first, message = next(iter(failures.items()))
        warnings.warn(
            f"{len(failures)} of {runs} failed, see failures; run {first}: {message}",
            RuntimeWarning,
            stacklevel=3,
        )
