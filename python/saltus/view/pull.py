"""A body that is pulled with the mouse: a damped spring from a point of it to the mouse."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from saltus._core import Model, State, Wrench
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


def force_of(model: Model, state: State, pull: Pull) -> Wrench:
    """Return the force of the spring on its point.

    The spring is as stiff as the body is heavy at its point: f = L (w^2 x - 2 w v), where x is the
    way to the mouse, v the point's velocity, and L^-1 = J M^-1 J^T its mobility. Whatever is
    pulled then follows alike, and no step is too long for it.

    Parameters
    ----------
    model : Model
    state : State
    pull : Pull

    Returns
    -------
    Wrench
        [N]
    """
    frames = model.at(state.q)
    J = frames.jacobian(pull.link, pull.at)
    way = PULL**2 * (pull.to - frames.pose(pull.link) * pull.at)
    way -= 2 * PULL * (J @ model.velocity(state))
    if model.n_v > MOST_VELOCITIES:
        return Wrench(model.links[pull.link].mass * way, point=pull.at)
    mobility = J @ np.linalg.solve(frames.mass_matrix(), J.T)
    firm = FIRM * np.trace(mobility) / 3 * np.eye(3)
    if not firm.any():
        return Wrench()  # nothing moves the point
    return Wrench(np.linalg.solve(mobility + firm, way), point=pull.at)
