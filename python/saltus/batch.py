"""Running a model from many starts at once."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._core import (
    ImpactLaw,
    Model,
    ModelError,
    OnFailure,
    State,
    StepError,
    StepOptions,
)
from saltus.batch_trajectory import BatchTrajectory
from saltus.rollout import Law, Progress, StepBounds, check_types, keep_rows, progress_bar
from saltus.trajectory import Array, Trajectory

if TYPE_CHECKING:
    from typing_extensions import Unpack

Starts = Mapping[str, ArrayLike] | ArrayLike | None


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
    states: Sequence[State] | None = None,
    threads: int | None = None,
    on_failure: OnFailure = OnFailure.go_on,
    progress: bool | Progress | None = None,
    **bounds: Unpack[StepBounds],
) -> BatchTrajectory:
    """Run a model from many starts, over threads, and record all runs.

    Every run has the bits that `simulate` gives for its start, on however many threads. The
    interpreter's lock is released meanwhile.

    Parameters
    ----------
    model : Model
    q : array_like, shape (B, n_q), or mapping of names to arrays of shape (B,), optional
        [rad | m] coordinates at the starts, a row a run; those not named are as in
        `Model.neutral`. What has one dimension less, (n_q,) or a number, is the same for all runs.
        A free or ball joint's name takes all of its numbers, shape (B, 7) or (B, 4), or a SciPy
        Rotation of a ball.
    v : array_like, shape (B, n_v), or mapping of names to arrays of shape (B,), optional
        [rad/s | m/s] velocities at the starts, likewise, those not named 0.
    duration : float
        [s] a whole number of steps.
    h : float
        [s] step.
    law : ImpactLaw or callable
        Which energy impacts conserve: `nodal_energy`, `discrete_energy`, `shadow_energy`,
        `compensated`. A callable is given an `ImpactProblem` and returns the momenta after.
    collisions : bool
        False: bodies pass through each other.
    record_every : int
        Steps between recorded rows; start and end are always recorded, and a number of at least
        duration / h leaves these two.
    record_contacts : bool
        Whether to keep every impulse between bodies, as `contacts` of each run `batch[i]`.
    states : sequence of State, optional
        The starts in place of `q` and `v`, all at the same time.
    threads : int, optional
        How many; None: as many as the machine runs at once.
    on_failure : OnFailure
        `OnFailure.go_on`: a run whose step cannot be made, or whose start overlaps, is not
        `complete`, its message is in `failures`, and a RuntimeWarning tells of it.
        `OnFailure.stop`: its error is raised; where several runs fail, that of the first of them.
    progress : bool or callable, optional
        None: a progress bar on a terminal when the batch takes longer than 2 s; True, False:
        always, never; a callable is given the part done in [0, 1] about ten times a second.
    **bounds
        `order`, `certify`, `max_iterations`, `max_impacts`, `max_impulses`, `rest`,
        `simultaneous`: as in `StepOptions`.

    Returns
    -------
    BatchTrajectory
        Ctrl-C ends the batch early; it then holds what is done so far, and runs that had not ended
        are not `complete`.

    Raises
    ------
    ModelError
        Before anything runs, on starts that do not fit the model or are not finite, none at all,
        a duration or h that is not positive, a duration that is no whole number of steps,
        threads < 1, more than 16 GB of rows; a run whose `contacts` would take more than its share
        of what rows leave of these fails. With `OnFailure.stop` also on a start that overlaps.
    StepError, JammedError
        With `OnFailure.stop`, as `simulate`, with "run <index>: " before the message. The rows
        before it are `error.trajectory`.
    """
    check_types(model, bounds, "simulate_batch")
    if not isinstance(on_failure, OnFailure):
        raise TypeError(
            f"on_failure = {on_failure!r} is no OnFailure; there are saltus.OnFailure.go_on, "
            "saltus.OnFailure.stop"
        )
    if threads is not None and threads < 1:
        raise ModelError(f"threads = {threads}; it must be at least 1, or None for all there are")
    if states is None:
        states = _states(model, q, v)
    elif q is not None or v is not None:
        raise ModelError("give either states or q and v, not both")
    for i, state in enumerate(states):
        if not isinstance(state, State):
            raise TypeError(f"states[{i}] is a {type(state).__name__}; model.state makes a State")
    options = StepOptions(h, law, collisions, **bounds)
    core = _core.BatchTrajectory(model)
    with progress_bar(progress, len(states), "runs") as report, keeping_run(core):
        _core.simulate_batch(
            core,
            states,
            duration,
            options=options,
            record_every=record_every,
            record_contacts=record_contacts,
            threads=threads or 0,
            on_failure=on_failure,
            progress=report,
        )
    batch = BatchTrajectory.from_core(core)
    _tell(batch)
    return batch


@contextmanager
def keeping_run(core: _core.BatchTrajectory) -> Iterator[None]:
    """Give the error of a run the rows before it, as `simulate` does."""
    try:
        yield
    except (ModelError, StepError) as error:
        if core.failures:
            keep_rows(error, Trajectory.from_core(core.run(min(core.failures))))
        raise


class _Space(NamedTuple):
    """What is asked of q or v: names of the columns, and values that are not given."""

    what: str
    kind: str
    names: list[str]
    joints: dict[str, list[int]]  # of several columns
    default: Array


def _spaces(model: Model) -> tuple[_Space, _Space]:
    def several(columns: dict[str, list[int]]) -> dict[str, list[int]]:
        return {name: own for name, own in columns.items() if len(own) > 1}

    q = several({joint.name: joint.coordinates for joint in model.joints})
    v = several({joint.name: joint.velocities for joint in model.joints})
    return (
        _Space("q", "coordinate", model.coordinate_names, q, model.neutral()),
        _Space("v", "velocity", model.velocity_names, v, np.zeros(model.n_v)),
    )


def _states(model: Model, q: Starts, v: Starts) -> list[State]:
    spaces = _spaces(model)
    arrays = [_to_array(space, x) for space, x in zip(spaces, (q, v), strict=True)]
    rows = {s.what: len(x) for s, x in zip(spaces, arrays, strict=True) if x.ndim == 2}
    if not rows:
        raise ModelError(
            "q and v hold a single start; a batch takes a row a run, shape (runs, n); a single "
            "start is for simulate"
        )
    runs = max(rows.values())
    if min(rows.values()) != runs:
        raise ModelError(f"q has {rows['q']} rows and v has {rows['v']}; a row is a run")
    return _core.states(model, *(np.broadcast_to(x, (runs, x.shape[-1])) for x in arrays))


def _to_array(space: _Space, x: Starts) -> Array:
    """Return the array (B, n) that is meant, (n,) where it is the same for all runs."""
    n = len(space.names)
    if x is None:
        return space.default
    if isinstance(x, Mapping):
        return _from_mapping(space, x)
    array = _numbers(space.what, x)
    if array.ndim not in (1, 2) or array.shape[-1] != n:
        raise ModelError(
            f"{space.what} has shape {array.shape}; it must have shape (runs, {n}), a column for "
            f"each of {', '.join(space.names)}"
        )
    return array


def _columns(space: _Space, name: str) -> list[int]:
    if name in space.names:
        return [space.names.index(name)]
    if name in space.joints:
        return space.joints[name]
    known = ", ".join([*space.names, *space.joints])
    raise ModelError(f'no {space.kind} "{name}"; there are {known}')


def _from_mapping(space: _Space, x: Mapping[str, ArrayLike]) -> Array:
    """Fill columns by names: (runs,) or () of one number, (runs, k) or (k,) of a joint of k."""
    own = {name: _columns(space, name) for name in x}
    values = {}
    for name, columns in own.items():
        value = _numbers(f'{space.what}["{name}"]', _plain(x[name]))
        if len(columns) == 1 and name in space.names:
            value = value[..., np.newaxis]
        if value.ndim not in (1, 2) or value.shape[-1] != len(columns):
            taken = "(runs,) or ()" if len(columns) == 1 else f"(runs, {len(columns)}) or less"
            shown = np.shape(_plain(x[name]))
            raise ModelError(f'{space.what}["{name}"] has shape {shown}; it must be {taken}')
        values[name] = value
    lengths = {len(value) for value in values.values() if value.ndim == 2}
    if len(lengths) > 1:
        listed = ", ".join(f'"{name}": {np.shape(_plain(x[name]))}' for name in x)
        raise ModelError(f"{space.what} has arrays of shapes {{{listed}}}; all must have the runs")
    out = np.empty((*lengths, len(space.names)))
    out[...] = space.default
    for name, value in values.items():
        out[..., own[name]] = value
    return out


def _plain(x: Any) -> Any:
    """Return the quaternions x y z w of a SciPy Rotation; other values as they are."""
    return x.as_quat() if hasattr(x, "as_quat") else x


def _numbers(what: str, x: ArrayLike) -> Array:
    try:
        return np.asarray(x, dtype=float)
    except (TypeError, ValueError) as error:
        raise ModelError(f"{what} is no array of numbers: {error}") from None


def _tell(batch: BatchTrajectory) -> None:
    """Say what did not end, so that nobody takes NaN for numbers."""
    runs, failures = len(batch), batch.failures
    stopped = runs - int(batch.complete.sum()) - len(failures)
    if stopped:
        print(
            f"saltus: stopped; {stopped} of {runs} runs had not ended, the batch holds what was "
            "done",
            file=sys.stderr,
        )
    if failures:
        first, message = next(iter(failures.items()))
        warnings.warn(
            f"{len(failures)} of {runs} runs failed, see failures; run {first}: {message}",
            RuntimeWarning,
            stacklevel=3,
        )
