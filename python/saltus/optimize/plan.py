"""Controls found, the motion that they make, and the feedback that keeps to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from saltus._core import Model, ModelError, Smoothness, State
from saltus.optimize.system import Array, Rollout, States, System, count_impacts, iterated
from saltus.runs.moment import Moment
from saltus.runs.trajectory import Trajectory


class Policy:
    """u = u_k + K_k (x - x_k) within bounds: a control for `simulate`.

    A body that hits a wall a little early or late is for that while far from the plan, by an
    impact, and no feedback mends that. So where the run has done other impacts than the plan at
    the same step, the feedback is left out there. After the last step it goes on with the last.

    Parameters
    ----------
    system : System
    path : Rollout
        The plan: u_k and x_k.
    gain : numpy.ndarray, shape (N, n_u, 2 n_v)
    bounds : tuple of numpy.ndarray, shape (n_u,)
    """

    def __init__(
        self, system: System, path: Rollout, gain: Array, bounds: tuple[Array, Array]
    ) -> None:
        self.system, self.path, self.gain, self.bounds = system, path, gain, bounds
        self.done: dict[str, int] = {}

    def at(self, k: int, state: State, done: dict[str, int] | None = None) -> Array:
        """Return u of step k, shape (n_u,); `done` are the impacts up to there, by pair."""
        k = min(k, len(self.gain) - 1)
        u = self.path.control[k]
        if done is None or done == self.path.impacts[k]:
            u = u + self.gain[k] @ self.system.difference(self.path.states[k], state)
        return np.asarray(np.clip(u, *self.bounds))

    def __call__(self, moment: Moment) -> Array:
        """Return u for `simulate`, which asks before each step."""
        self.done = {} if moment.step == 0 else count_impacts(self.done, moment.report)
        return self.at(moment.step, moment.state, self.done)

    def __repr__(self) -> str:
        return f"Policy({len(self.gain)} steps of {self.system.h:g} s)"


@dataclass(frozen=True, eq=False, repr=False)
class Plan(States):
    """What an optimiser found.

    Attributes
    ----------
    model : Model
    h : float
        [s]
    states : list of State
        N + 1 of them.
    control : numpy.ndarray, shape (N, n_u)
    gain : numpy.ndarray, shape (N, n_u, 2 n_v)
        Feedback by x = (q, p), differences of q along velocities.
    cost : float
    costs : list of float
        Before the first iteration, and after each.
    decrements : list of float
        What the quadratic model of the cost promised at each iteration, before damping takes from
        it. It goes to 0 at a minimum.
    converged : bool
    message : str
        Why it ended.
    smoothness : list of Smoothness
        The verdict on the derivative of each step.
    """

    model: Model
    h: float
    states: list[State]
    control: Array
    gain: Array
    cost: float
    costs: list[float]
    decrements: list[float]
    converged: bool
    message: str
    smoothness: list[Smoothness]
    _system: System
    _path: Rollout
    _bounds: tuple[Array, Array]

    @property
    def impacts(self) -> dict[str, int]:
        """How many impacts the motion has, by pair."""
        return dict(self._path.impacts[-1])

    @property
    def policy(self) -> Policy:
        """The feedback as a control for `simulate`."""
        return Policy(self._system, self._path, self.gain, self._bounds)

    def run(self, start: State | None = None) -> Trajectory:
        """Return the motion as a run, to plot, save and play.

        Parameters
        ----------
        start : State, optional
            Another start than the plan's: then the feedback acts.
        """
        if start is not None and not isinstance(start, State):
            raise ModelError(f"start is a {type(start).__name__}; Model.state makes a State")
        steps = len(self.control)
        if start is None:
            return self._system.run(self.states[0], steps, self.control)
        return self._system.run(start, steps, self.policy)

    def __repr__(self) -> str:
        return (
            f"Plan({len(self.control)} steps of {self.h:g} s, cost {self.cost:.6g}, "
            f"{iterated(len(self.costs) - 1)}: {self.message})"
        )
