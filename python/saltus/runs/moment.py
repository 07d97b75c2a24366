"""What a policy is given before a step."""

from __future__ import annotations

from dataclasses import dataclass

from saltus._core import Model, State, StepReport
from saltus.records.tables import Array


@dataclass(frozen=True, eq=False)
class Moment:
    """Where a run is when `simulate` asks the policy for the controls of the next steps.

    Attributes
    ----------
    state : State
    v : numpy.ndarray, shape (n_v,)
        [rad/s | m/s] velocities.
    model : Model
    u : numpy.ndarray, shape (n_u,)
        The controls of the step before; empty until there are some.
    report : StepReport
        Of the step before: impacts, and the impulses that held contacts closed.
    step : int
        Steps done.
    """

    state: State
    v: Array
    model: Model
    u: Array
    report: StepReport
    step: int

    @property
    def t(self) -> float:
        """[s]."""
        return self.state.t

    @property
    def q(self) -> Array:
        """Coordinates [rad | m], shape (n_q,)."""
        return self.state.q

    @property
    def p(self) -> Array:
        """Momenta, shape (n_v,)."""
        return self.state.p

    def __repr__(self) -> str:
        return f"Moment(t={self.t:g}, q={self.q}, v={self.v})"
