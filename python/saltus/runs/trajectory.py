"""A recorded motion as the user has it, with methods that save and draw it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core, plots
from saltus._core import Model, ModelError, Wrench
from saltus.records import files
from saltus.records.tables import as_array
from saltus.runs.gradient import RunGradient, gradient
from saltus.runs.shown import Shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory(Shown):
    """A recorded motion: rows are states, made by `simulate` and `load`.

    Attributes
    ----------
    model : Model or None
        None if it was loaded from a file without the model.
    options : StepOptions
    coordinate_names : tuple of str
        Of the columns of `q`.
    velocity_names : tuple of str
        Of the columns of `v` and `p`; those of `q`, except for free and ball joints.
    pair_names : tuple of str
        Of all pairs; if the model has more than `LISTED_PAIRS`, of those in the arrays.
    t : numpy.ndarray, shape (rows,)
        [s]
    q : numpy.ndarray, shape (rows, n_q)
        Coordinates [rad | m], of free and ball joints with unit quaternions x y z w.
    v, p : numpy.ndarray, shape (rows, n_v)
        Velocities and momenta, of free and ball joints in their parents' axes.
    kinetic, potential, total : numpy.ndarray, shape (rows,)
        [J]
    shadow : numpy.ndarray, shape (rows,)
        [J] H - h^2 kappa / 24, the modified Hamiltonian, which a fixed step conserves to O(h^4). If
        it drifts, the run is not reliable.
    impacts : numpy.ndarray
        Structured, in order of time: "t" [s], "first" and "count" (its rows in `impulses`),
        "contacts" (closed contacts), "law" (an `ImpactLaw`), "fallback".
    impulses : numpy.ndarray
        Structured: "impact" (row of `impacts`), "pair" (index in `pair_names`), "lambda" [N s] (the
        normal impulse), and in the world frame, three numbers each: "tangential" [N s] (the
        friction impulse on the pair's first shape), "point" [m] (halfway between the nearest points
        of the two shapes), "normal" (unit, from the pair's second shape to the first). Point and
        normal are NaN in runs from older files without them.
    contacts : numpy.ndarray
        Structured, with `record_contacts` alone: every impulse that acted between bodies, those of
        impacts and the sums that held pairs closed over each step (`ContactImpulse`). "row" (the
        first recorded row at or after the end of its step), "t" [s] (of the impact, or the end of
        the step), "impact" (row of `impacts`; -1: what held a pair closed), and "pair", "lambda",
        "tangential", "point", "normal" as in `impulses`. ModelError where they were not recorded.
    settlings : numpy.ndarray
        Structured: "t" [s] when infinitely many ever lower bounces of a pair end, "pair".
    fallbacks : numpy.ndarray
        Structured, empty as a rule: what could not be made as it should. "t" [s] where it starts,
        "tau" [s] its longest arc, "rung": "halved", a step by shorter arcs, as exact as with a
        smaller h; "unlocated", an arc by time stepping, in which contacts do not rebound;
        "stopped", an arc that bodies in contact stand still in. Of the last two "energy" [J] is
        what the arc changed of it, and "pair" (index, -1) took the largest impulse.
    certificates : tuple of str
        For each impact whether its outcome is unique; empty without `certify`.
    iterations : int
        Newton iterations in all.
    residual : float
        [largest momentum] the largest of all steps.
    complete : bool
        False if the run was stopped or failed before its end.
    control : numpy.ndarray, shape (rows, n_u)
        What actuators (`control_names`) were told in the steps from each row on; in the last row
        as in the step before it.
    work : dict of str to numpy.ndarray, shape (rows,)
        [J] done on the model until each row: by each actuator, by "damping" of joints and
        dampers, by dry "friction", and by "applied" forces, those that are functions included.
    energy_error : float
        Greatest |H(t) - H(0) - work(t)| over the greatest kinetic energy of the run. Impacts with
        restitution below 1 and friction between bodies count as error.
    """

    @classmethod
    def from_states(
        cls,
        model: Model,
        t: ArrayLike,
        q: ArrayLike,
        v: ArrayLike | None = None,
        *,
        p: ArrayLike | None = None,
        h: float | None = None,
    ) -> Trajectory:
        """Return a run of given rows: of a loop of one's own, of a planner, of a measurement.

        It is plotted, shown, saved and loaded as any other run; energies are computed, and of
        impacts it knows nothing.

        Parameters
        ----------
        model : Model
        t : array_like, shape (rows,)
            [s] not decreasing.
        q : array_like, shape (rows, n_q)
            [rad | m]
        v : array_like, shape (rows, n_v), optional
            [rad/s | m/s] None: p, or at rest.
        p : array_like, shape (rows, n_v), optional
            Momenta in place of velocities.
        h : float, optional
            [s] step of the shadow energy; None: the time between the first two rows.

        Returns
        -------
        Trajectory

        Raises
        ------
        ModelError
            On shapes that do not fit, times that decrease, values that no state has, v and p both.

        Examples
        --------
        >>> import numpy as np, saltus
        >>> model = saltus.load_urdf(saltus.scenes.chain(1))
        >>> t = np.linspace(0.0, 1.0, 11)
        >>> run = saltus.Trajectory.from_states(model, t, np.sin(t)[:, None], np.cos(t)[:, None])
        >>> len(run)
        11
        """
        if v is not None and p is not None:
            raise ModelError("give either v or p, not both")
        times = as_array(t, "t", 1)
        configurations = as_array(q, "q", 2)
        rows = np.zeros((len(times), model.n_v)) if v is None and p is None else None
        if rows is None:
            rows = as_array(v, "v", 2) if p is None else as_array(p, "p", 2)
        if h is None:
            h = float(times[1] - times[0]) if len(times) > 1 and times[1] > times[0] else 0.01
        momenta = p is not None
        core = _core.Trajectory.from_states(model, times, configurations, rows, momenta, h)
        return cls.from_core(core)

    def gradient(
        self,
        q_hat: ArrayLike,
        p_hat: ArrayLike,
        *,
        forces: Mapping[str, Wrench] | None = None,
        qfrc: Mapping[str, ArrayLike] | ArrayLike | None = None,
        control: ArrayLike | None = None,
    ) -> RunGradient:
        """Return the gradient of a cost of the run by what it was made from.

        The adjoint method: every step is made again from the rows, the last first, and its
        derivative transposed (`Stepper.vjp`), through all impacts. About three times the run. Of a
        long run every thousandth row is enough (`record_every`): memory is that of its rows, and
        64 MB.

        Parameters
        ----------
        q_hat, p_hat : array_like, shape (rows, n_v) or (n_v,)
            The gradient of the cost by the state of each row, q along velocities; or by that of
            the last row alone.
        forces : mapping of links' names to Wrench, optional
        qfrc : mapping of names to values, or array_like, shape (n_v,), optional
            What was applied in all steps, as `simulate` was given it; the rows do not tell it.
        control : array_like, shape (steps, n_u), optional
            The controls of each step, where they changed between rows; by default those of a row
            are held until the next.

        Returns
        -------
        RunGradient

        Raises
        ------
        ModelError
            Where a step has no derivative, named as by `Stepper.jvp`; where rows are not as many
            steps apart; where forces were applied, which a run does not record, and are not told,
            or others than those; likewise controls between rows.

        Examples
        --------
        >>> import saltus
        >>> model = saltus.load_urdf(saltus.scenes.chain(1))
        >>> run = saltus.simulate(model, [0.1], duration=0.5)
        >>> run.gradient(q_hat=[1.0], p_hat=[0.0]).q.shape
        (1,)
        """
        return gradient(self, q_hat, p_hat, forces, qfrc, control)

    def save(self, path: str | os.PathLike[str], *, visuals: bool = True) -> None:
        """Write everything to an HDF5 file, with the model in it.

        Parameters
        ----------
        path : str or os.PathLike
        visuals : bool
            False: without what links look like, which is most of a file with meshes.
        """
        files.save(self, path, visuals=visuals)

    def plot(self, path: str | os.PathLike[str] | None = None, **options: Any) -> Figure:
        """Draw the run over time: coordinates, velocities, gaps, controls, energies, work.

        A cradle is drawn as in the paper's Fig. 3 (`saltus.plots.plot_cradle`), by velocities with
        sketches; with `panels=` as other runs are (`saltus.plots.plot_run`).

        Parameters
        ----------
        path : str or os.PathLike, optional
            File for the picture; its suffix selects the format. None: the figure is returned alone.
        **options
            `panels`, `names` and `pairs`, as in `saltus.plots.plot_run`; of a cradle `times` of the
            sketches, as in `saltus.plots.plot_cradle`.

        Returns
        -------
        matplotlib.figure.Figure
        """
        return plots.plot(self, path, **options)

    def plot_impacts(
        self, path: str | os.PathLike[str] | None = None, *, index: int | None = None
    ) -> Figure:
        """Draw which pairs took impulses when, or one impact as a cascade.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File for the picture; its suffix selects the format.
        index : int, optional
            The impact to draw as a cascade; else all of them over time.

        Returns
        -------
        matplotlib.figure.Figure
        """
        return plots.plot_impacts(self, path, index=index)


def load(path: str | os.PathLike[str], *, model: Model | None = None) -> Trajectory:
    """Read a trajectory that `Trajectory.save` wrote; all numbers are the same to the last bit.

    Parameters
    ----------
    path : str or os.PathLike
    model : Model, optional
        The model of the run, for files without it, and to have its visuals and sensors.

    Returns
    -------
    Trajectory
        Its `model` is None if neither the file nor the argument gives one.

    Raises
    ------
    ModelError
        On a file without a trajectory, and on a model that is not that of the run: other masses,
        joints, shapes, contacts or forces. Visuals, states and sensors may differ.
    """
    return files.read(Trajectory, path, model)
