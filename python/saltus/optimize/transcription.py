"""What DMOC has found: states, controls, and when the planned impacts come."""

from __future__ import annotations

from dataclasses import dataclass

from saltus._core import Model, State
from saltus.optimize.system import Array, States, System
from saltus.runs.trajectory import Trajectory


@dataclass(frozen=True, eq=False, repr=False)
class Transcription(States):
    """What `transcribe` found.

    Attributes
    ----------
    model : Model
    h : float
        [s]
    states : list of State
        N + 1 of them.
    control : numpy.ndarray, shape (N, n_u)
    impacts : list of (str, float)
        Pairs and times [s] of the planned impacts, as they are now.
    cost : float
    costs : list of float
        After each iteration; also below the last, where constraints were not kept yet.
    defect : float
        By how much states, gaps and bounds miss what they must be, at most.
    drift : float
        By how much the run of these controls ends elsewhere than the last of `states`: the largest
        difference in (q, p); infinite where the run fails.
    converged : bool
    message : str
        Why it ended.
    """

    model: Model
    h: float
    states: list[State]
    control: Array
    impacts: list[tuple[str, float]]
    cost: float
    costs: list[float]
    defect: float
    drift: float
    converged: bool
    message: str
    _system: System

    def run(self) -> Trajectory:
        """Return the motion that the controls make, as a run, to plot, save, play and keep to."""
        return self._system.run(self.states[0], len(self.control), self.control)

    def __repr__(self) -> str:
        return (
            f"Transcription({len(self.control)} steps of {self.h:g} s, {len(self.impacts)} planned "
            f"impacts, cost {self.cost:.6g}, defect {self.defect:.1e}, {len(self.costs)} "
            f"iterations: {self.message})"
        )
