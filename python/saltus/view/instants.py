"""Which instants of a run the page shows, and the coordinates at each: rows and impacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from saltus._core import Impact, Model, ModelError, State, StepError, Stepper
from saltus.records.options import step_arguments
from saltus.records.recording import Recording
from saltus.records.tables import Array

RATE = 60.0  # rows a second; a screen shows no more
MOST_STEPS = (
    20_000  # of those that find where bodies are at impacts; later impacts are interpolated
)
MERGED = 1e-9  # s; impacts that follow each other faster share an instant


@dataclass(frozen=True)
class Instants:
    """The instants to show, in order of time.

    Attributes
    ----------
    t : numpy.ndarray, shape (instants,)
        [s]
    q : numpy.ndarray, shape (instants, n_q)
    kinetic, potential : numpy.ndarray, shape (instants,)
        [J] at impacts those after it.
    recorded : numpy.ndarray, shape (instants,)
        Row of the run, -1 at impacts.
    impact_at : numpy.ndarray, shape (impacts,)
        Instant of each impact of the run.
    kinetic_before : numpy.ndarray, shape (impacts,)
        [J] before each impact.
    interpolated : int
        Impacts whose places are interpolated between recorded rows.
    """

    t: Array
    q: Array
    kinetic: Array
    potential: Array
    recorded: npt.NDArray[np.int64]
    impact_at: npt.NDArray[np.int64]
    kinetic_before: Array
    interpolated: int


def instants_of(run: Recording, *, rate: float = RATE) -> Instants:
    """Choose the instants of a run to show.

    At most `rate` recorded rows a second, the first, the last, and every impact: there bodies are
    where the run had them, because the step is made again up to the impact.

    Parameters
    ----------
    run : Recording
        With a model.
    rate : float
        [1/s]

    Returns
    -------
    Instants
    """
    rows = _thinned(run.t, rate)
    times, impact_of = _impact_times(run)
    places = _Places(run, run.require_model())
    found = [places.at(t) for t in times]
    t = np.concatenate([run.t[rows], times])
    # Before a row of the same time: the row is the state after the impact.
    order = np.argsort(t, kind="stable")
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    q = np.concatenate([run.q[rows], *([[f.q for f in found]] if found else [])])
    kinetic = np.concatenate([run.kinetic[rows], [f.after for f in found]])
    potential = np.concatenate([run.potential[rows], [f.potential for f in found]])
    before = np.array([f.before for f in found], float)
    return Instants(
        t=t[order],
        q=q[order],
        kinetic=kinetic[order],
        potential=potential[order],
        recorded=np.concatenate([rows, np.full(len(times), -1)])[order],
        impact_at=place[len(rows) + impact_of],
        kinetic_before=before[impact_of],
        interpolated=places.interpolated,
    )


def _thinned(t: Array, rate: float) -> npt.NDArray[np.int64]:
    """Return the rows to keep: those nearest to a grid of 1 / rate, the first and the last."""
    if len(t) < 2 or t[-1] <= t[0]:
        return np.arange(len(t))
    # A grid of whole frames: rows 1/60 s apart stay, whatever rounding says.
    frame = np.floor((t - t[0]) * rate + 1e-6).astype(np.int64)
    kept = np.flatnonzero(np.diff(frame, prepend=-1) > 0)
    return np.union1d(kept, [0, len(t) - 1])


def _impact_times(run: Recording) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return the instants of impacts, and for each impact the number of its instant."""
    t = run.impacts["t"]
    if not len(t):
        return np.zeros(0), np.zeros(0, np.int64)
    new = np.concatenate([[True], np.diff(t) > MERGED])
    return t[new], np.cumsum(new) - 1


@dataclass(frozen=True)
class _Place:
    """Coordinates at an impact, and energies [J] about it."""

    q: Array
    before: float
    after: float
    potential: float


class _Places:
    """Where bodies are at impacts, found by making the steps of the run again."""

    def __init__(self, run: Recording, model: Model) -> None:
        self.run, self.model = run, model
        self.steps_left = MOST_STEPS
        self.interpolated = 0
        self.last = (-1, 0.0)  # row of the impact before, and the total energy after it

    def at(self, t: float) -> _Place:
        """Return the place at the time of an impact; times are to come in order."""
        run = self.run
        row = max(int(np.searchsorted(run.t, t, side="right")) - 1, 0)
        on_row = run.t[row] >= t - MERGED
        state, after = (run.state(row), float(run.total[row])) if on_row else self._stepped(row, t)
        q = self._between(row, t) if state is None else state.q
        # Within a step the energy changes little but at impacts: it is that of the row before.
        row_before = row - 1 if on_row and row else row
        same_step = self.last[0] == row_before
        before = self.last[1] if same_step else float(run.total[row_before])
        if after is None:
            after = float(run.total[min(row + 1, len(run) - 1)])
        self.last = (row_before, after)
        potential = self.model.potential_energy(q)
        return _Place(q, max(before - potential, 0.0), max(after - potential, 0.0), potential)

    def _stepped(self, row: int, t: float) -> tuple[State | None, float | None]:
        """Return state and energy after steps from a recorded row to t, None where unknown."""
        run, h = self.run, self.run.options.h
        state = run.state(row)
        whole, rest = divmod(t - state.t, h)
        if self.steps_left < whole + 1:
            return None, None
        self.steps_left -= int(whole) + 1
        impacts: list[Impact] = []
        control = run.control[row] if self.model.n_u else None  # in all steps up to the next row
        try:
            for step, count in ((h, int(whole)), (rest, 1)):
                if count == 0 or step < 1e-9 * h:
                    continue
                stepper = self._stepper(step)
                for _ in range(count):
                    state = stepper.advance(state, control=control)
                    impacts = stepper.report.impacts
        except (ModelError, StepError):
            return None, None  # as where the law was a function that the file does not hold
        if not impacts or abs(impacts[-1].t - t) > MERGED:
            return None, None  # another motion: forces drove the run that it does not hold
        return state, self.model.kinetic_energy(state) + self.model.potential_energy(state.q)

    def _stepper(self, h: float) -> Stepper:
        return Stepper(self.model, h, **step_arguments(self.run.options))

    def _between(self, row: int, t: float) -> Array:
        """Return coordinates between two rows, by a constant velocity."""
        run = self.run
        self.interpolated += 1
        if row + 1 >= len(run):
            last: Array = run.q[row]
            return last
        part = (t - run.t[row]) / (run.t[row + 1] - run.t[row])
        whole = self.model.difference(run.q[row], run.q[row + 1])
        q: Array = self.model.integrate(run.q[row], part * whole)
        return q
