"""Many recorded motions of one model."""

from __future__ import annotations

import operator
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from saltus import _core
from saltus._core import ImpactLaw, Model, StepOptions
from saltus.records.models import MOST_ROWS, html_table
from saltus.records.tables import Array, counted, index_of
from saltus.runs.trajectory import Trajectory


@dataclass(frozen=True, eq=False, repr=False)
class BatchTrajectory:
    """Recorded motions from many starts, made by `simulate_batch`.

    `len(batch)` is the number of runs B; `batch[i]` is one of them as a `Trajectory`, with its
    impacts and impulses, and iterating gives one after another. Rows that a run did not reach,
    because it failed or was stopped, are NaN in the arrays here and absent from `batch[i]`.

    Attributes
    ----------
    model : Model
    options : StepOptions
    coordinate_names, velocity_names : tuple of str
        Of the columns of `q`; of those of `v` and `p`.
    t : numpy.ndarray, shape (rows,)
        [s] the same for all runs.
    q : numpy.ndarray, shape (B, rows, n_q)
        Coordinates [rad | m], of free and ball joints with unit quaternions x y z w.
    v, p : numpy.ndarray, shape (B, rows, n_v)
        Velocities and momenta, of free and ball joints in their parents' axes.
    kinetic, potential, shadow, total : numpy.ndarray, shape (B, rows)
        [J] as in `Trajectory`.
    impacts : numpy.ndarray of int, shape (B,)
        Number of impacts.
    rows : numpy.ndarray of int, shape (B,)
        Rows that were reached.
    control : numpy.ndarray, shape (B, rows, n_u)
        As in `Trajectory`.
    energy_error : numpy.ndarray, shape (B,)
        Greatest |H(t) - H(0) - work(t)| over the greatest kinetic energy of each run.
    complete : numpy.ndarray of bool, shape (B,)
        False for runs that failed, or were stopped before their end.
    failures : dict of int to str
        The error message of each failed run, by its index.
    """

    model: Model
    options: StepOptions
    coordinate_names: tuple[str, ...]
    velocity_names: tuple[str, ...]
    t: Array
    q: Array
    v: Array
    p: Array
    kinetic: Array
    potential: Array
    shadow: Array
    control: Array
    total: Array
    impacts: npt.NDArray[np.int64]
    rows: npt.NDArray[np.int64]
    energy_error: Array
    complete: npt.NDArray[np.bool_]
    failures: dict[int, str]
    _runs: _core.BatchTrajectory

    @classmethod
    def from_core(cls, core: _core.BatchTrajectory) -> BatchTrajectory:
        """Wrap what the compiled part returns; large arrays are not copied."""
        names = ("t", "q", "v", "p", "kinetic", "potential", "shadow", "control")
        numbers = ("impacts", "rows", "energy_error", "complete", "failures")
        arrays = {name: getattr(core, name) for name in (*names, *numbers)}
        arrays["total"] = core.kinetic + core.potential
        for name in ("total", "energy_error"):
            arrays[name].flags.writeable = False
        return cls(
            model=core.model,
            options=core.options,
            coordinate_names=tuple(core.model.coordinate_names),
            velocity_names=tuple(core.model.velocity_names),
            _runs=core,
            **arrays,
        )

    @property
    def pair_names(self) -> tuple[str, ...]:
        """Of all pairs."""
        return tuple(self.model.pair_names)

    def __len__(self) -> int:
        return len(self.complete)

    def __getitem__(self, run: int) -> Trajectory:
        """Return one run; negative numbers count from the end."""
        index = operator.index(run)
        if not -len(self) <= index < len(self):
            raise IndexError(f"no run {index}; the batch has {len(self)}")
        return Trajectory.from_core(self._runs.run(index % len(self)))

    def __iter__(self) -> Iterator[Trajectory]:
        return (self[run] for run in range(len(self)))

    def __repr__(self) -> str:
        return f"<saltus.BatchTrajectory: {self.summary()}>"

    def _repr_html_(self) -> str:
        """Return a table of the runs for notebooks."""
        heads = ["run", "rows", "impacts", "energy error", "went"]
        rows = []
        for i in range(min(len(self), MOST_ROWS)):
            went = "complete" if self.complete[i] else self.failures.get(i, "stopped")
            error = f"{self.energy_error[i]:.1e}"
            rows.append([str(i), str(self.rows[i]), str(self.impacts[i]), error, went])
        if len(self) > MOST_ROWS:
            rows.append([f"... {len(self) - MOST_ROWS} more", "", "", "", ""])
        return html_table(heads, rows, self.summary())

    def summary(self) -> str:
        """Return one line that says how many runs, how long and how they went."""
        law = ImpactLaw(self.options.law).name
        stopped = len(self) - int(self.complete.sum()) - len(self.failures)
        went = [f"{len(self.failures)} failed"] if self.failures else []
        went += [f"{stopped} stopped"] if stopped else []
        return (
            counted(len(self), "run") + (f" ({', '.join(went)})" if went else "") + ", "
            f"{self.t[0]:g} to {self.t[-1]:g} s, h = {self.options.h:g} s, {law}, "
            f"{counted(len(self.t), 'row')}, {counted(self.q.shape[2], 'coordinate')}, "
            f"{counted(self.impacts.sum(), 'impact')}"
        )

    def column(self, name: str, of: Literal["q", "v", "p"] = "q") -> Array:
        """Return one coordinate, velocity or momentum of all runs over time.

        Parameters
        ----------
        name : str
            Name of the coordinate, or with "v" and "p" of the velocity.
        of : {"q", "v", "p"}
            Which array it is a column of.

        Returns
        -------
        numpy.ndarray, shape (B, rows)

        Raises
        ------
        ModelError
            On a name that the array has not; lists those there are.
        """
        index = index_of(name, of, self.coordinate_names, self.velocity_names)
        rows: Array = getattr(self, of)
        return rows[:, :, index]
