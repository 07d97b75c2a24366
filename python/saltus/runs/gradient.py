"""The gradient of a cost of a run: the adjoint of its steps, from the last to the first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from saltus._core import ImpactLaw, ModelError, State, Stepper
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
    control : numpy.ndarray, shape (steps, n_u)
        By the controls of each step.
    qfrc : numpy.ndarray, shape (steps, n_v)
        [1/(N m) | 1/N] By forces on the coordinates in each step.
    h : float
        [1/s] By the duration of all steps alike.
    inertia : numpy.ndarray, shape (links, 10)
        By the links' own inertial parameters, as in `ModelGradient`.
    stiffness, rest, damping, armature : numpy.ndarray, shape (n_v,)
        By the joints' own, likewise.
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
    """Return the options of a run's steps but h.

    Raises
    ------
    ModelError
        Where the steps cannot be made again from the rows.
    """
    if run.model is None:
        raise ModelError("the run has no model; saltus.load reads it where the file has one")
    h = run.options.h
    steps = round((run.t[-1] - run.t[0]) / h)
    if steps != len(run.t) - 1:
        raise ModelError(
            f"the run has {len(run.t)} rows of {steps} steps; derivatives need a row each, as "
            "record_every=1 gives"
        )
    if np.any(run.work["applied"]):
        raise ModelError(
            "forces were applied in the run, which it does not record; give them as actuators"
        )
    if run.options.law == ImpactLaw.custom:
        raise ModelError("the run's impact law is a function, whose derivatives are not told")
    return step_arguments(run.options)


def gradient(run: Recording, q_hat: npt.ArrayLike, p_hat: npt.ArrayLike) -> RunGradient:
    """Return the gradient of a cost, see `Trajectory.gradient`."""
    options = step_options(run)
    assert run.model is not None  # step_options asks for one
    stepper = Stepper(run.model, h=run.options.h, record=True, **options)
    model = stepper.model
    rows, n_v, n_u = len(run.t), model.n_v, run.control.shape[1]
    by_q = rows_of(q_hat, "q_hat", rows, n_v)
    by_p = rows_of(p_hat, "p_hat", rows, n_v)
    control, qfrc = np.zeros((rows - 1, n_u)), np.zeros((rows - 1, n_v))
    sums: dict[str, Array] = {"inertia": np.zeros((len(model.links), 10))}
    sums |= {name: np.zeros(n_v) for name in ("stiffness", "rest", "damping", "armature")}
    q, p, h = by_q[-1].copy(), by_p[-1].copy(), 0.0
    for k in reversed(range(rows - 1)):
        start = State(run.t[k], run.q[k], run.p[k])
        stepper.advance(start, control=run.control[k] if n_u > 0 else None)
        of_model = stepper.model_gradient(q, p)
        for name, total in sums.items():
            total += getattr(of_model, name)
        back = stepper.vjp(q, p)
        control[k], qfrc[k] = back.control, back.qfrc
        h += back.h
        q, p = back.q + by_q[k], back.p + by_p[k]
    return RunGradient(q, p, control, qfrc, h, **sums)
