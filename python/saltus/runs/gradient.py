"""The gradient of a cost of a run: the adjoint of its steps, from the last to the first."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from saltus._core import ImpactLaw, ModelError, Wrench, adjoint
from saltus.records.options import step_arguments
from saltus.records.recording import Recording

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class RunGradient:
    """The gradient of a cost of a run by what the run was made from.

    Attributes
    ----------
    q, p : numpy.ndarray, shape (n_v,)
        By the state that the run started from; q along velocities.
    control : numpy.ndarray, shape (rows - 1, n_u)
        By the controls of each step; of rows that are some steps apart, by those that were held
        from row to row, or (steps, n_u) where they were told by step.
    qfrc : numpy.ndarray, shape (rows - 1, n_v)
        [1/(N m) | 1/N] By forces on the coordinates in each step, or from row to row.
    h : float
        [1/s] By the duration of all steps alike.
    inertia : numpy.ndarray, shape (links, 10)
        By the links' own inertial parameters, as in `ModelGradient`.
    stiffness, rest, damping, armature : numpy.ndarray, shape (n_v,)
        By the joints' own, likewise.
    actuators : numpy.ndarray, shape (n_u, 4)
        By what the actuators have, likewise.
    restitution, friction : dict of str to float
        By the restitution and the coefficient of friction of each pair that rebounded or slid,
        likewise; by one number that all pairs have: the sum.
    springs : dict of str to tuple of float
        By stiffness and length of each spring between two points, likewise.
    dampers : dict of str to float
        By the damping of each damper between two points, likewise.
    placements : dict of str to numpy.ndarray, shape (3,)
        [1/m] By where the frame of each joint that moves is in its parent link, likewise.
    forces, torques : dict of str to numpy.ndarray, shape (rows - 1, 3)
        [1/N], [1/(N m)] By each wrench that was applied, by its link, in the axes that it has,
        likewise.
    """

    q: Array
    p: Array
    control: Array
    qfrc: Array
    h: float
    inertia: Array
    stiffness: Array
    rest: Array
    damping: Array
    armature: Array
    actuators: Array
    restitution: dict[str, float]
    friction: dict[str, float]
    springs: dict[str, tuple[float, float]]
    dampers: dict[str, float]
    placements: dict[str, Array]
    forces: dict[str, Array]
    torques: dict[str, Array]


BY_MODEL = (
    "inertia",
    "stiffness",
    "rest",
    "damping",
    "armature",
    "actuators",
    "restitution",
    "friction",
    "springs",
    "dampers",
    "placements",
)


def rows_of(x: npt.ArrayLike, name: str, rows: int, n: int) -> Array:
    """Return a covector for each row; one row is that of the last."""
    array = np.asarray(x, dtype=float)
    if array.shape == (n,):
        out = np.zeros((rows, n))
        out[-1] = array
        return out
    if array.shape == (rows, n):
        return array
    raise ModelError(
        f"{name} has shape {array.shape}; it is ({rows}, {n}), a row for each of the run's, or "
        f"({n},) for the last"
    )


def step_options(run: Recording) -> dict[str, Any]:
    """Return the options of a run's steps but h, or raise as `check_run`."""
    check_run(run)
    return step_arguments(run.options)


def check_run(run: Recording) -> None:
    """Raise ModelError where the steps of a run are not told by its rows."""
    check_origin(run, is_told=False)
    steps = steps_of(run)
    if steps != len(run.t) - 1:
        raise ModelError(
            f"the run has {len(run.t)} rows of {steps} steps; derivatives need a row each, as "
            "record_every=1 gives"
        )


def steps_of(run: Recording) -> int:
    """Return the number of steps of a run."""
    return round(float(run.t[-1] - run.t[0]) / run.options.h)


def check_origin(run: Recording, *, is_told: bool) -> None:
    """Raise ModelError where a run has no model, or was made by what nobody tells.

    `is_told`: what was applied is told beside the rows.
    """
    if run.model is None:
        raise ModelError("the run has no model; saltus.load reads it where the file has one")
    # what moves prescribed joints does work, too; steps made again tell other forces apart
    is_told = is_told or any(name.endswith(" prescribed") for name in run.model.loop_names)
    if np.any(run.work["applied"]) and not is_told:
        raise ModelError(
            "forces were applied in the run, which it does not record; give them as actuators, or "
            "tell run.gradient what simulate had as forces= and qfrc="
        )
    if run.options.law == ImpactLaw.custom:
        raise ModelError("the run's impact law is a function, whose derivatives are not told")


def rows_apart(run: Recording) -> int:
    """Return how many steps lie between two rows, or raise ModelError where rows do not tell."""
    steps, parts = steps_of(run), len(run.t) - 1
    every = round((run.t[1] - run.t[0]) / run.options.h) if parts > 0 else 1
    at = run.t[0] + run.options.h * np.minimum(np.arange(parts + 1) * every, steps)
    if every < 1 or np.abs(run.t - at).max() > 1e-6 * run.options.h * max(1, steps):
        raise ModelError(
            f"the run has {parts + 1} rows of {steps} steps, which are not as many steps apart; "
            "derivatives need rows as record_every gives them"
        )
    return every


def control_of(run: Recording, control: npt.ArrayLike | None) -> Array | None:
    """Return the controls of each step, where they are told."""
    if control is None:
        return None
    array = np.asarray(control, dtype=float)
    return array[:, None] if array.ndim == 1 and run.control.shape[1] == 1 else array


def gradient(
    run: Recording,
    q_hat: npt.ArrayLike,
    p_hat: npt.ArrayLike,
    forces: Mapping[str, Wrench] | None,
    qfrc: Mapping[str, npt.ArrayLike] | npt.ArrayLike | None,
    control: npt.ArrayLike | None,
) -> RunGradient:
    """Return the gradient of a cost, see `Trajectory.gradient`."""
    check_origin(run, is_told=forces is not None or qfrc is not None)
    assert run.model is not None  # check_origin asks for one
    rows, n_v = len(run.t), run.model.n_v
    by_q = rows_of(q_hat, "q_hat", rows, n_v)
    by_p = rows_of(p_hat, "p_hat", rows, n_v)
    rows_told = (run.model, run.options, run.t, run.q, run.p, run.control)
    q, p, by_control, by_qfrc, *by_wrenches, h, of_model = adjoint(
        *rows_told,
        by_q,
        by_p,
        forces,
        qfrc,
        every=rows_apart(run),
        steps=steps_of(run),
        by_step=control_of(run, control),
    )
    by_link = [
        {str(link): by[:, 3 * k : 3 * k + 3] for k, link in enumerate(forces or ())}
        for by in by_wrenches
    ]
    parts = {name: getattr(of_model, name) for name in BY_MODEL}
    return RunGradient(q, p, by_control, by_qfrc, h, **parts, forces=by_link[0], torques=by_link[1])
