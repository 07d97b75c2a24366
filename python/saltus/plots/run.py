"""Pictures of runs: coordinates and energies over time."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus.plots.cradle import is_cradle, plot_cradle
from saltus.plots.figure import finish, new_figure
from saltus.records.recording import Recording
from saltus.records.tables import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_LABELS = 8  # lines in a legend; more of them are drawn thin and without names
MOST_MARKS = 300  # impacts drawn as lines


def plot(run: Recording, path: str | os.PathLike[str] | None = None, **options: Any) -> Figure:
    """Draw a run; see `Trajectory.plot`."""
    if is_cradle(run):
        return plot_cradle(run, path, **options)
    return plot_run(run, path, **options)


def plot_run(run: Recording, path: str | os.PathLike[str] | None = None) -> Figure:
    """Draw coordinates, energies and the energy's error over time, impacts as vertical lines.

    Parameters
    ----------
    run : Trajectory
    path : str or os.PathLike, optional
        Where the picture is written.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        Where matplotlib is not installed.
    """
    groups = _groups(run)
    figure = new_figure(path, (8.0, 2.2 * (len(groups) + 2)))
    panels: list[Axes] = list(figure.subplots(len(groups) + 2, 1, sharex=True, squeeze=False)[:, 0])
    for axes, (label, columns) in zip(panels, groups, strict=False):
        _draw_lines(axes, run.t, run.q[:, columns], [run.coordinate_names[i] for i in columns])
        axes.set_ylabel(label)
    _draw_energies(panels[-2], run)
    _draw_energy_error(panels[-1], run)
    for axes in panels:
        _mark_impacts(axes, run)
        axes.spines[["top", "right"]].set_visible(False)
        axes.margins(x=0)
    panels[-1].set_xlabel("time [s]")
    figure.align_ylabels(panels)
    return finish(figure, path)


def _groups(run: Recording) -> list[tuple[str, list[int]]]:
    """Return (label of the axis, coordinates) of angles, lengths and quaternions."""
    columns = range(len(run.coordinate_names))
    if run.model is None:
        return [("coordinates", list(columns))] if columns else []
    units = [coordinate.unit for coordinate in run.model.coordinates]
    groups = [
        ("angles [rad]", [i for i in columns if units[i] == "rad"]),
        ("lengths [m]", [i for i in columns if units[i] == "m"]),
        ("quaternions", [i for i in columns if units[i] == "1"]),
    ]
    return [(label, members) for label, members in groups if members]


def _draw_lines(axes: Axes, t: Array, rows: Array, names: list[str]) -> None:
    many = len(names) > MOST_LABELS
    for i, name in enumerate(names):
        axes.plot(t, rows[:, i], lw=0.6 if many else 1.2, label=name)
    if not many:
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize="small")


def _draw_energies(axes: Axes, run: Recording) -> None:
    axes.plot(run.t, run.kinetic, lw=1.0, label="kinetic")
    axes.plot(run.t, run.potential, lw=1.0, label="potential")
    axes.plot(run.t, run.total, lw=1.4, color="black", label="total")
    axes.set_ylabel("energy [J]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize="small")


def _draw_energy_error(axes: Axes, run: Recording) -> None:
    axes.plot(run.t, run.total - run.total[0], lw=1.0, color="black", label="total")
    axes.plot(run.t, run.shadow - run.shadow[0], lw=1.0, color="tab:red", label="shadow")
    axes.set_ylabel("energy error [J]")
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3))
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize="small")


def _mark_impacts(axes: Axes, run: Recording) -> None:
    times = run.impacts["t"]
    if 0 < len(times) <= MOST_MARKS:
        for t in times:
            axes.axvline(t, color="0.8", lw=0.6, zorder=0)
    elif len(times) > 0:  # so many that lines would hide everything: a rug
        heights = np.full(len(times), -0.02)
        style: dict[str, Any] = {"ls": "none", "marker": "|", "ms": 4, "color": "0.5"}
        axes.plot(times, heights, transform=axes.get_xaxis_transform(), clip_on=False, **style)
