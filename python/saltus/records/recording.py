"""The recorded data of a run, with accessors; `Trajectory` adds files and plots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from saltus import _core
from saltus._core import Impact, ImpactLaw, Link, Model, ModelError, State, StepOptions
from saltus.records.sensors import Rows, Touch, read_sensor, sensor_of, touches
from saltus.records.tables import (
    ARRAYS,
    CONTACT,
    FALLBACK,
    IMPACT,
    IMPULSE,
    NUMBERS,
    RUNGS,
    SETTLING,
    SOURCES,
    Array,
    counted,
    index_of,
    names_of_pairs,
    row_of,
)

if TYPE_CHECKING:
    from typing_extensions import Self


@dataclass(frozen=True, eq=False, repr=False)
class Recording:
    """The data of a run; `Trajectory` documents the arrays."""

    model: Model | None
    options: StepOptions
    coordinate_names: tuple[str, ...]
    velocity_names: tuple[str, ...]
    pair_names: tuple[str, ...]
    t: Array
    q: Array
    v: Array
    p: Array
    kinetic: Array
    potential: Array
    total: Array
    shadow: Array
    impacts: npt.NDArray[np.void]
    impulses: npt.NDArray[np.void]
    settlings: npt.NDArray[np.void]
    fallbacks: npt.NDArray[np.void]
    certificates: tuple[str, ...]
    iterations: int
    residual: float
    complete: bool
    energy_error: float
    recorded_contacts: npt.NDArray[np.void] | None = None
    control_names: tuple[str, ...] = ()
    recorded_control: Array | None = None
    recorded_work: Array | None = None

    @property
    def control(self) -> Array:
        """What actuators were told in the steps from each row on, shape (rows, n_u)."""
        if self.recorded_control is None:
            return np.zeros((len(self.t), len(self.control_names)))
        return self.recorded_control

    @property
    def work(self) -> dict[str, Array]:
        """[J] done on the model until each row, by source, see `Trajectory`."""
        names = (*self.control_names, *SOURCES)
        done = self.recorded_work
        if done is None:
            done = np.zeros((len(self.t), len(names)))
        return {name: done[:, k] for k, name in enumerate(names)}

    @property
    def contacts(self) -> npt.NDArray[np.void]:
        """Every impulse between bodies, see `Trajectory`; ModelError if not recorded."""
        if self.recorded_contacts is None:
            raise ModelError(
                "the contacts of this run were not recorded; ask for them: "
                "saltus.simulate(..., record_contacts=True)"
            )
        return self.recorded_contacts

    @classmethod
    def from_core(cls, core: _core.Trajectory) -> Self:
        """Wrap what the compiled part returns; large arrays are not copied."""
        impacts = core.impacts.astype(IMPACT)
        own = core.impulses
        impulses = np.empty(len(own), IMPULSE)
        impulses["impact"] = np.repeat(np.arange(len(impacts)), impacts["count"])
        for name in own.dtype.names or ():
            impulses[name] = own[name]
        settlings = core.settlings.astype(SETTLING)
        fallbacks = np.empty(len(core.fallbacks), FALLBACK)
        for name in FALLBACK.names or ():
            fallbacks[name] = core.fallbacks[name]
        fallbacks["rung"] = np.array(RUNGS)[core.fallbacks["rung"]]
        events = [impulses, settlings, fallbacks]
        contacts = None if core.contacts is None else core.contacts.astype(CONTACT)
        if contacts is not None:
            events.append(contacts)
        model = core.model
        pair_names = names_of_pairs(model, *events)
        for array in (impacts, *events):
            array.flags.writeable = False
        return cls(
            model=model,
            options=core.options,
            coordinate_names=tuple(model.coordinate_names),
            velocity_names=tuple(model.velocity_names),
            pair_names=pair_names,
            impacts=impacts,
            impulses=impulses,
            settlings=settlings,
            fallbacks=fallbacks,
            recorded_contacts=contacts,
            certificates=tuple(core.certificates),
            control_names=tuple(model.control_names),
            recorded_control=core.control,
            recorded_work=core.work,
            **{name: getattr(core, name) for name in (*ARRAYS, *NUMBERS)},
        )

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"<saltus.{type(self).__name__}: {self.summary()}>"

    def summary(self) -> str:
        """Return one line that says how long, how many impacts and how exact."""
        law = ImpactLaw(self.options.law).name
        shorter = int(np.count_nonzero(self.fallbacks["rung"] == "halved"))
        lossy = len(self.fallbacks) - shorter
        span = f"{self.t[0]:g} to {self.t[-1]:g} s" + ("" if self.complete else " (stopped)")
        return (
            f"{span}, h = {self.options.h:g} s, {law}, {counted(len(self), 'row')}, "
            f"{counted(self.q.shape[1], 'coordinate')}, {counted(len(self.impacts), 'impact')} "
            f"with {counted(len(self.impulses), 'impulse')}, energy error {self.energy_error:.1e}"
            + (f", {counted(shorter, 'step')} by shorter arcs" if shorter else "")
            + (f", {counted(lossy, 'arc')} by time stepping" if lossy else "")
        )

    def column(self, name: str, of: Literal["q", "v", "p"] = "q") -> Array:
        """Return one coordinate, velocity or momentum over time.

        Parameters
        ----------
        name : str
            Name of the coordinate, or with "v" and "p" of the velocity.
        of : {"q", "v", "p"}
            Which array it is a column of.

        Returns
        -------
        numpy.ndarray, shape (rows,)

        Raises
        ------
        ModelError
            On an unknown name; lists the names there are.
        """
        index = index_of(name, of, self.coordinate_names, self.velocity_names)
        rows: Array = getattr(self, of)
        return rows[:, index]

    def state(self, row: int) -> State:
        """Return the state of a row; negative rows count from the end."""
        row = row_of(row, len(self), "row")
        return State(float(self.t[row]), self.q[row], self.p[row])

    def impact(self, index: int) -> Impact:
        """Return one impact with its pairs by name; it prints as a table of its impulses."""
        row = self.impacts[row_of(index, len(self.impacts), "impact")]
        own = self.impulses[row["first"] : row["first"] + row["count"]]
        return Impact(
            float(row["t"]),
            [self.pair_names[pair] for pair in own["pair"]],
            own["lambda"],
            contacts=int(row["contacts"]),
            law=ImpactLaw(int(row["law"])),
            fallback=bool(row["fallback"]),
            certificate=self.certificates[index] if self.certificates else "",
            tangentials=own["tangential"],
            points=own["point"],
            normals=own["normal"],
        )

    def require_model(self) -> Model:
        """Return the model; raise ModelError where there is none."""
        if self.model is None:
            raise ModelError(
                "this trajectory has no model, which its file does not hold; give it to load: "
                "saltus.load(path, model=model)"
            )
        return self.model

    def poses(self, link: str | int | Link) -> Array:
        """Return the homogeneous matrices of a link, shape (rows, 4, 4)."""
        return self.require_model().poses(self.q, link)

    def velocities(self, link: str | int | Link) -> Array:
        """Return angular velocity [rad/s] and velocity of a link's origin [m/s], (rows, 6)."""
        return self.require_model().velocities(self.q, self.v, link)

    def sensor(self, name: str) -> Array:
        """Return what a sensor of the model reads in each row.

        Parameters
        ----------
        name : str
            As in `ModelBuilder.add_sensor`.

        Returns
        -------
        numpy.ndarray, shape (rows,) or (rows, k)
            By its kind: see `SensorKind`. An accelerometer, and forces of contacts, are means over
            the time since the row before; in the first row contacts read 0, and an accelerometer
            what it would at constant velocity.

        Raises
        ------
        ModelError
            On a name that no sensor has; lists those there are. On forces of contacts, where these
            were not recorded.
        """
        model = self.require_model()
        spans = np.diff(self.t, prepend=self.t[0])
        rows = Rows(model, self.t, self.q, self.v, self.control, self._touch, spans)
        return read_sensor(rows, sensor_of(model, name))

    def _touch(self) -> Touch:
        own = self.contacts[self.contacts["row"] < len(self)]
        pairs = (self.pair_names[pair] for pair in own["pair"])
        return touches(own["row"], pairs, own["lambda"], own["tangential"], own["normal"])
