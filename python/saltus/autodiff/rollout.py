"""A run as a function of arrays, and its adjoint: what the wrappers share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from saltus._core import (
    ImpactLaw,
    JointType,
    Model,
    ModelError,
    State,
    StepOptions,
    Stepper,
    Trajectory,
    adjoint,
    simulate,
)

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Rollout:
    """The map (q, p, control) -> (all q, all p) of so many steps.

    Attributes
    ----------
    model : Model
    options : StepOptions
    """

    model: Model
    options: StepOptions

    def check(self, q: Array, p: Array, control: Array) -> None:
        """Raise ModelError where shapes are not those of the model."""
        n_q, n_v, n_u = self.model.n_q, self.model.n_v, self.model.n_u
        if q.shape != (n_q,) or p.shape != (n_v,):
            raise ModelError(
                f"q has shape {q.shape} and p {p.shape}; they are ({n_q},) and ({n_v},)"
            )
        if control.ndim != 2 or control.shape[1] != n_u or len(control) == 0:
            raise ModelError(
                f"control has shape {control.shape}; it is (steps, {n_u}), a row for each step"
                + ("; of a model without actuators, np.zeros((steps, 0))" if n_u == 0 else "")
            )

    def run(self, q: Array, p: Array, control: Array) -> tuple[Array, Array]:
        """Return q (steps + 1, n_q) and p (steps + 1, n_v) of all rows."""
        self.check(q, p, control)
        made = Trajectory(self.model)
        simulate(
            made,
            State(0.0, self.unit(q), p),
            len(control) * self.options.h,
            options=self.options,
            control=control if self.model.n_u > 0 else None,
        )
        if not made.complete:  # Ctrl-C
            raise KeyboardInterrupt
        return np.array(made.q), np.array(made.p)

    def pull(
        self, rows: tuple[Array, Array], control: Array, q_hat: Array, p_hat: Array
    ) -> tuple[Array, Array, Array]:
        """Return the covectors of q, p and control at the start, of those of all rows.

        That of a quaternion is along the sphere, as of one of length 1.
        """
        q, p = rows
        along = np.stack([self.slopes(x).T @ hat for x, hat in zip(q, q_hat, strict=True)])
        t = self.options.h * np.arange(len(q))
        last = control[-1:]  # a row more, which is not used
        by_q, by_p, by_control, *_ = adjoint(
            self.model, self.options, t, q, p, np.vstack([control, last]), along, p_hat
        )
        J = self.slopes(q[0])
        return J @ np.linalg.solve(J.T @ J, by_q), by_p, by_control

    def unit(self, q: Array) -> Array:
        """Return q with quaternions of length 1."""
        out = np.array(q)
        for joint in self.model.joints:
            if joint.type in (JointType.spherical, JointType.floating):
                last = list(joint.coordinates)[-4:]
                out[last] /= np.linalg.norm(out[last])
        return out

    def slopes(self, q: Array) -> Array:
        """Return dq/dv, (n_q, n_v): how coordinates move along velocities; 1 but for balls."""
        model = self.model
        J = np.zeros((model.n_q, model.n_v))
        for joint in model.joints:
            places, rates = list(joint.coordinates), list(joint.velocities)
            if joint.type not in (JointType.spherical, JointType.floating):
                J[places, rates] = 1
                continue
            x, y, z, w = q[places[-4:]]
            # R -> exp(eta) R: the quaternion moves by (eta, 0) times it, half
            turn = [[w, z, -y], [-z, w, x], [y, -x, w], [-x, -y, -z]]
            J[np.ix_(places[-4:], rates[-3:])] = 0.5 * np.array(turn)
            if len(rates) > 3:
                J[places[:-4], rates[:-3]] = 1
        return J


def rollout_of(model: Model, h: float, options: Mapping[str, Any]) -> Rollout:
    """Return the rollout of a model's steps, or raise where it is no model or an option is none."""
    if not isinstance(model, Model):
        raise TypeError(f"model is a {type(model).__name__}; saltus.load_urdf makes a Model of it")
    known = dict(options)
    law, collisions = known.pop("law", ImpactLaw.nodal_energy), known.pop("collisions", True)
    Stepper(model, h, law, collisions=collisions, **known)  # refuses what no step can have
    return Rollout(model, StepOptions(h, law, collisions, **known))
