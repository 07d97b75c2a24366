"""A body that is pulled with the mouse: a damped spring from a point of it to the mouse."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from saltus._core import Model, State
from saltus.records.tables import Array

PULL = 16.0  # rad/s: the point follows within an eighth of a second; its weight keeps it 4 cm below
FIRM = 0.02  # part of the mean mobility that directions without any get
MOST_VELOCITIES = 300  # of models whose mobility is found; those with more use the link's mass


@dataclass(frozen=True)
class Pull:
    """A point of a link, and where the mouse wants it.

    Attributes
    ----------
    link : int
    at : numpy.ndarray, shape (3,)
        [m] in the link's frame.
    to : numpy.ndarray, shape (3,)
        [m] in the world.
    """

    link: int
    at: Array
    to: Array


def pulled(model: Model, state: State, pull: Pull, h: float) -> State:
    """Return a state with the momentum that the spring gives in a step: p + h J^T f.

    The spring is as stiff as the body is heavy at its point: f = L (w^2 x - 2 w v), where x is the
    way to the mouse, v the point's velocity, and L^-1 = J M^-1 J^T its mobility. Whatever is
    pulled then follows alike, and no step is too long for it.

    Parameters
    ----------
    model : Model
    state : State
    pull : Pull
    h : float
        [s]

    Returns
    -------
    State
    """
    q = np.asarray(state.q)
    X = model.pose(q, pull.link)
    arm = X.R @ pull.at
    v = np.asarray(model.velocity(state))
    J = _jacobian(model, q, pull.link, arm)
    way = PULL**2 * (pull.to - X.p - arm) - 2 * PULL * (J @ v)
    if model.n_v > MOST_VELOCITIES:
        force = model.links[pull.link].mass * way
    else:
        mobility = J @ np.linalg.solve(model.mass_matrix(q), J.T)
        firm = FIRM * np.trace(mobility) / 3 * np.eye(3)
        if not firm.any():
            return state  # nothing moves the point
        force = np.linalg.solve(mobility + firm, way)
    return State(state.t, q, np.asarray(state.p) + h * J.T @ force)


def _jacobian(model: Model, q: Array, link: int, arm: Array) -> Array:
    """Return J of a point of a link, shape (3, n_v): its velocity is J v."""
    unit = np.eye(model.n_v)
    twists = model.velocities(np.tile(q, (model.n_v, 1)), unit, link)
    J: Array = (twists[:, 3:] + np.cross(twists[:, :3], arm)).T
    return J
