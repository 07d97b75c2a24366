"""A recorded motion."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from saltus import _core
from saltus._core import Impact, ImpactLaw, Model, ModelError, State, StepOptions

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = npt.NDArray[np.float64]

IMPACT = np.dtype(
    {
        "names": ["t", "first", "count", "contacts", "law", "fallback"],
        "formats": ["f8", "i8", "i8", "i4", "u1", "?"],
    }
)
SETTLING = np.dtype([("t", "f8"), ("pair", "i4")])
ACTED: list[Any] = [
    ("pair", "i4"),
    ("lambda", "f8"),
    ("tangential", "f8", (3,)),
    ("point", "f8", (3,)),
    ("normal", "f8", (3,)),
]
IMPULSE = np.dtype([("impact", "i8"), *ACTED])
CONTACT = np.dtype([("row", "i8"), ("t", "f8"), ("impact", "i8"), *ACTED])

LISTED_PAIRS = 100_000
"""Models with more pairs have no list of their names in a trajectory."""


def names_of_pairs(model: Model, *events: npt.NDArray[np.void]) -> tuple[str, ...]:
    """Name the pairs that `events["pair"]` refer to, counting anew where they are too many."""
    if model.n_pairs <= LISTED_PAIRS:
        return tuple(model.pair_names)
    numbers = np.unique(np.concatenate([event["pair"] for event in events]))
    for event in events:
        event["pair"] = np.searchsorted(numbers, event["pair"])
    return tuple(model.pair_name(int(number)) for number in numbers)


def check_array(of: str) -> str:
    """Return the name of an array of columns; raise ModelError on another."""
    if of not in ("q", "v", "p"):
        raise ModelError(f'no array "{of}" of coordinates; there are q, v, p')
    return of


def index_of(
    name: str, of: str, coordinate_names: Sequence[str], velocity_names: Sequence[str]
) -> int:
    """Return the column of q, v or p that has a name; raise ModelError where none has it."""
    kind, names, others = "coordinate", coordinate_names, velocity_names
    if of != "q":
        kind, names, others = "velocity", velocity_names, coordinate_names
    if name in names:
        return list(names).index(name)
    hint = ""
    if name in others:
        hint = f' ("{name}" is a column of {"v and p" if of == "q" else "q"})'
    raise ModelError(f'no {kind} "{name}"{hint}; there are {", ".join(names)}')


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory:
    """A recorded motion: rows are states, made by `simulate` and `load`.

    Attributes
    ----------
    model : Model or None
        None where it was loaded from a file that could not hold the model.
    options : StepOptions
    coordinate_names : tuple of str
        Of the columns of `q`.
    velocity_names : tuple of str
        Of the columns of `v` and `p`; those of `q`, but for free and ball joints.
    pair_names : tuple of str
        Of all pairs; where the model has more than `LISTED_PAIRS`, of those that the arrays name.
    t : numpy.ndarray, shape (rows,)
        [s]
    q : numpy.ndarray, shape (rows, n_q)
        Coordinates [rad | m], of free and ball joints with unit quaternions x y z w.
    v, p : numpy.ndarray, shape (rows, n_v)
        Velocities and momenta, of free and ball joints in their parents' axes.
    kinetic, potential, total : numpy.ndarray, shape (rows,)
        [J]
    shadow : numpy.ndarray, shape (rows,)
        [J] H - h^2 kappa / 24, which a fixed step conserves to O(h^4): a monitor of health.
    impacts : numpy.ndarray
        Structured, in order of time: "t" [s], "first" and "count" (its rows in `impulses`),
        "contacts" (pairs that touched), "law" (an `ImpactLaw`), "fallback".
    impulses : numpy.ndarray
        Structured: "impact" (row of `impacts`), "pair" (index in `pair_names`), "lambda" [N s]
        along the normal, and in the world, three numbers each: "tangential" [N s] (friction on the
        pair's first shape), "point" [m] (where the two touch, halfway between their nearest
        points), "normal" (unit, from the pair's second shape to the first). Point and normal are
        NaN in runs from files of before they were kept.
    contacts : numpy.ndarray
        Structured, with `record_contacts` alone: every impulse that acted between bodies, those of
        impacts and the sums that held pairs closed over each step (`ContactImpulse`). "row" (the
        first recorded row at or after the end of its step), "t" [s] (of the impact, or the end of
        the step), "impact" (row of `impacts`; -1: what held a pair closed), and "pair", "lambda",
        "tangential", "point", "normal" as in `impulses`. ModelError where they were not recorded.
    settlings : numpy.ndarray
        Structured: "t" [s] when a pair that bounced ever lower came to rest, "pair".
    certificates : tuple of str
        Of each impact whether its outcome is unique; empty unless `certify` asked for it.
    iterations : int
        Newton iterations in all.
    residual : float
        [largest momentum] the worst of any step.
    complete : bool
        False where the run was stopped or failed before its end.
    energy_error : float
        Greatest |H(t) - H(0)| over the greatest kinetic energy of the run.
    """

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
    certificates: tuple[str, ...]
    iterations: int
    residual: float
    complete: bool
    energy_error: float
    recorded_contacts: npt.NDArray[np.void] | None = None

    @property
    def contacts(self) -> npt.NDArray[np.void]:
        """Every impulse that acted between bodies, see above; ModelError where not recorded."""
        if self.recorded_contacts is None:
            raise ModelError(
                "the contacts of this run were not recorded; ask for them: "
                "saltus.simulate(..., record_contacts=True)"
            )
        return self.recorded_contacts

    @classmethod
    def from_core(cls, core: _core.Trajectory) -> Trajectory:
        """Wrap what the compiled part returns; large arrays are not copied."""
        impacts = core.impacts.astype(IMPACT)
        own = core.impulses
        impulses = np.empty(len(own), IMPULSE)
        impulses["impact"] = np.repeat(np.arange(len(impacts)), impacts["count"])
        for name in own.dtype.names or ():
            impulses[name] = own[name]
        settlings = core.settlings.astype(SETTLING)
        events = [impulses, settlings]
        contacts = None if core.contacts is None else core.contacts.astype(CONTACT)
        if contacts is not None:
            events.append(contacts)
        model = core.model
        pair_names = names_of_pairs(model, *events)
        for array in (impacts, *events):
            array.flags.writeable = False
        names = ("t", "q", "v", "p", "kinetic", "potential", "total", "shadow")
        numbers = ("iterations", "residual", "complete", "energy_error")
        return cls(
            model=model,
            options=core.options,
            coordinate_names=tuple(model.coordinate_names),
            velocity_names=tuple(model.velocity_names),
            pair_names=pair_names,
            impacts=impacts,
            impulses=impulses,
            settlings=settlings,
            recorded_contacts=contacts,
            certificates=tuple(core.certificates),
            **{name: getattr(core, name) for name in (*names, *numbers)},
        )

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"<saltus.Trajectory: {self.summary()}>"

    def summary(self) -> str:
        """Return one line that says how long, how many impacts and how exact."""
        law = ImpactLaw(self.options.law).name
        span = f"{self.t[0]:g} to {self.t[-1]:g} s" + ("" if self.complete else " (stopped)")
        return (
            f"{span}, h = {self.options.h:g} s, {law}, {len(self)} rows, {self.q.shape[1]} "
            f"coordinates, {len(self.impacts)} impacts with {len(self.impulses)} impulses, "
            f"energy error {self.energy_error:.1e}"
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
            On a name that the array has not; lists those there are.
        """
        rows: Array = getattr(self, check_array(of))
        return rows[:, index_of(name, of, self.coordinate_names, self.velocity_names)]

    def state(self, row: int) -> State:
        """Return the state of a row; negative rows count from the end."""
        return State(float(self.t[row]), self.q[row], self.p[row])

    def impact(self, index: int) -> Impact:
        """Return one impact with its pairs by name; printed, it is a table of its cascade."""
        row = self.impacts[index]
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
                "this trajectory has no model, which was built in code and not from URDF text; "
                "give it to load: saltus.load(path, model=model)"
            )
        return self.model

    def poses(self, link: str | int) -> Array:
        """Return the homogeneous matrices of a link, shape (rows, 4, 4)."""
        return self.require_model().poses(self.q, link)

    def velocities(self, link: str | int) -> Array:
        """Return angular velocity [rad/s] and velocity of a link's origin [m/s], (rows, 6)."""
        return self.require_model().velocities(self.q, self.v, link)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to an HDF5 file, with the model's URDF text in it.

        A model that was built in code has no text; the file says so, and `load` then needs the
        model to be given again.

        Parameters
        ----------
        path : str or os.PathLike
        """
        from saltus import files

        files.save(self, path)

    def plot(self, path: str | os.PathLike[str] | None = None, **options: Any) -> Figure:
        """Draw the run: a cradle as velocities with sketches, others as coordinates and energies.

        Parameters
        ----------
        path : str or os.PathLike, optional
            Where the picture is written; its ending says in which format.
        **options
            As in `saltus.plots.plot_cradle` or `saltus.plots.plot_run`.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from saltus import plots

        return plots.plot(self, path, **options)

    def plot_impacts(
        self, path: str | os.PathLike[str] | None = None, *, index: int | None = None
    ) -> Figure:
        """Draw which pairs took impulses when, or one impact as a cascade.

        Parameters
        ----------
        path : str or os.PathLike, optional
            Where the picture is written; its ending says in which format.
        index : int, optional
            The impact to draw as a cascade; else all of them over time.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from saltus import plots_impacts

        return plots_impacts.plot_impacts(self, path, index=index)
