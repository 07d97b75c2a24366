"""What a policy is given before a step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from saltus._core import Model, State, StepReport
from saltus.records.sensors import Rows, Touch, read_sensor, sensor_of, touches
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
    before : tuple of State, numpy.ndarray, int, or None
        State, v and step when the policy was asked before; None at first.
    """

    state: State
    v: Array
    model: Model
    u: Array
    report: StepReport
    step: int
    before: tuple[State, Array, int] | None = None

    @property
    def sensors(self) -> Mapping[str, float | Array]:
        """What sensors of the model read now, by name; each is computed when it is asked for.

        As the last row of `Trajectory.sensor`, with these differences. An accelerometer reads the
        mean since the policy was asked before. Forces of contacts are the mean of the last step.
        An actuator's force is that of its last control.
        """
        return Sensors(self)

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


class Sensors(Mapping[str, float | Array]):
    """What sensors read at a moment, by name."""

    def __init__(self, moment: Moment) -> None:
        self._moment = moment

    def __getitem__(self, name: str) -> float | Array:
        sensor = sensor_of(self._moment.model, name)
        last = read_sensor(_rows(self._moment), sensor)[-1]
        return float(last) if np.ndim(last) == 0 else last

    def __iter__(self) -> Iterator[str]:
        return iter(self._moment.model.sensor_names)

    def __len__(self) -> int:
        return len(self._moment.model.sensors)

    def __contains__(self, name: object) -> bool:
        return name in self._moment.model.sensor_names

    def __repr__(self) -> str:
        return f"Sensors({', '.join(self)})"


def _rows(now: Moment) -> Rows:
    """Return the moment before, if there was one, and this one."""
    n_u = now.model.n_u
    u = now.u if len(now.u) == n_u else np.zeros(n_u)
    state, v, step = now.before or (now.state, now.v, now.step)
    span = (now.t - state.t) / max(now.step - step, 1)  # of the last step
    return Rows(
        now.model,
        np.array([state.t, now.t]),
        np.array([state.q, now.q]),
        np.array([v, now.v]),
        np.array([u, u]),
        lambda: _touch(now),
        np.array([0.0, span]),
    )


def _touch(now: Moment) -> Touch:
    pairs: list[str] = []
    numbers: list[tuple[float, Array, Array]] = []
    for each in now.report.contacts:
        pairs.append(each.pair)
        numbers.append((each.impulse, each.tangential, each.normal))
    for impact in now.report.impacts:
        pairs += impact.pairs
        numbers += zip(impact.lambdas, impact.tangentials, impact.normals, strict=True)
    columns = zip(*numbers, strict=True) if numbers else ((), (), ())
    return touches([1] * len(pairs), pairs, *columns)
