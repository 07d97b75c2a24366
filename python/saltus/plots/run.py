"""Pictures of runs: coordinates, velocities, gaps, controls, energies and work over time."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from saltus._core import ModelError
from saltus.plots.cradle import is_cradle, plot_cradle
from saltus.plots.figure import finish, new_figure
from saltus.plots.gaps import draw_gaps, gap_lines
from saltus.plots.lines import (
    BLACK,
    COLOURS,
    LEGEND,
    MOST_LABELS,
    dots,
    draw_lines,
    keep_flat,
    labels_of,
    mark_times,
    style_of,
)
from saltus.records.recording import Recording
from saltus.records.tables import Array, counted, index_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANELS = ("q", "v", "gaps", "control", "energy", "work", "error")
WIDTH, HIGHEST, LOWEST, TALL = 8.0, 2.2, 1.4, 11.0  # [in] picture, panels, all panels
LETTERS = 0.185  # [in] a line of a legend
TOO_LITTLE = 1e-9  # of the largest: work that is not drawn
NEAR = 0.05  # of the height of a panel: how near a coordinate comes to a limit that is drawn


class Panel(NamedTuple):
    """What draws one of the axes, and the lines of text of its legend."""

    draw: Callable[[Axes], None]
    labels: int


def plot(run: Recording, path: str | os.PathLike[str] | None = None, **options: Any) -> Figure:
    """Draw a run; see `Trajectory.plot`."""
    if is_cradle(run) and not options.keys() & {"panels", "names", "pairs"}:
        return plot_cradle(run, path, **options)
    return plot_run(run, path, **options)


def plot_run(
    run: Recording,
    path: str | os.PathLike[str] | None = None,
    *,
    panels: Sequence[str] | None = None,
    names: Sequence[str] | None = None,
    pairs: Sequence[str] | None = None,
) -> Figure:
    """Draw a run over time, one panel below the other, impacts as grey lines.

    Parameters
    ----------
    run : Trajectory
    path : str or os.PathLike, optional
        Where the picture is written.
    panels : sequence of str, optional
        Of "q" and "v" (coordinates and velocities by their units, with the limits that they come
        near), "gaps" (of the pairs that met, else of the nearest), "control" (what actuators were
        told), "energy" (potential energy is counted from its lowest), "work" (of each source),
        "error" (energy less start and work: losses of impacts, and errors). None: all that the run
        has something of.
    names : sequence of str, optional
        Coordinates and velocities that are drawn; None: all.
    pairs : sequence of str, optional
        Pairs of shapes, "a ~ b", whose gaps are drawn.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        On a panel, a coordinate or a pair that does not exist; where matplotlib is not installed.
    """
    wanted = PANELS if panels is None else panels
    for name in wanted:
        if name not in PANELS:
            raise ModelError(f'no panel "{name}"; there are {", ".join(PANELS)}')
    drawn = [each for name in wanted for each in _panels(run, name, names, pairs)]
    if not drawn:
        raise ModelError(f"nothing to draw: the run has nothing of {', '.join(wanted)}")
    least = max(LOWEST, min(HIGHEST, TALL / len(drawn)))
    heights = [max(least, LETTERS * (panel.labels + 1)) for panel in drawn]
    figure = new_figure(path, (WIDTH, sum(heights) + 0.5))
    grid = figure.subplots(
        len(drawn), 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": heights}
    )
    axes: list[Axes] = list(grid[:, 0])
    for ax, panel in zip(axes, drawn, strict=True):
        panel.draw(ax)
        mark_times(ax, run.impacts["t"])
        ax.spines[["top", "right"]].set_visible(False)
        ax.margins(x=0 if len(run) > 1 else 0.05)
        ax.ticklabel_format(axis="y", scilimits=(-3, 4), useOffset=False)
    axes[0].set_title(_title(run), loc="left", fontsize="medium")
    axes[-1].set_xlabel("time [s]")
    figure.align_ylabels(axes)
    figure.draw_without_rendering()  # aligned labels need a second layout
    return finish(figure, path)


def _title(run: Recording) -> str:
    name = f"{run.model.name}: " if run.model is not None else ""
    impacts = counted(len(run.impacts), "impact") + (" (grey)" if len(run.impacts) else "")
    stopped = "" if run.complete else f", stopped at {run.t[-1]:g} s"
    return f"{name}{impacts}{stopped}"


def _panels(
    run: Recording, panel: str, names: Sequence[str] | None, pairs: Sequence[str] | None
) -> list[Panel]:
    """Return what draws the axes of a panel: none, one, or one for each unit."""
    if panel == "q":
        return [_coordinates(run, *group) for group in _groups_of_q(run, names)]
    if panel == "v":
        return [_velocities(run, *group) for group in _groups_of_v(run, names)]
    if panel == "gaps":
        lines = gap_lines(run, pairs)
        return [Panel(lambda axes: draw_gaps(axes, lines), len(lines))] if lines else []
    if panel == "control":
        count = labels_of(len(run.control_names))
        return [Panel(lambda axes: _draw_control(axes, run), count)] if count else []
    if panel == "energy":
        return [Panel(lambda axes: _draw_energies(axes, run), 3)]
    if panel == "work":
        most = {name: float(np.abs(work).max()) for name, work in run.work.items()}
        done = {n: run.work[n] for n in most if most[n] > TOO_LITTLE * max(most.values())}
        count = labels_of(len(done))
        return [Panel(lambda axes: _draw_work(axes, run.t, done), count)] if done else []
    return [Panel(lambda axes: _draw_error(axes, run), 2)]


def _wanted(run: Recording, of: str, names: Sequence[str] | None) -> list[int]:
    """Return the columns of q or v that are named; a name of the other array is none."""
    own, others = run.coordinate_names, run.velocity_names
    if of == "v":
        own, others = others, own
    if names is None:
        return [*range(len(own))]
    for name in names:
        if name not in own and name not in others:
            index_of(name, of, run.coordinate_names, run.velocity_names)  # raises
    return [own.index(name) for name in names if name in own]


def _groups_of_q(run: Recording, names: Sequence[str] | None) -> list[tuple[str, list[int]]]:
    """Return (label of the axis, coordinates) of angles, lengths and quaternions."""
    columns = _wanted(run, "q", names)
    if run.model is None:
        return [("coordinates", columns)] if columns else []
    units = [coordinate.unit for coordinate in run.model.coordinates]
    labels = {"rad": "angle [rad]", "m": "position [m]", "1": "quaternion"}
    groups = [(label, [i for i in columns if units[i] == unit]) for unit, label in labels.items()]
    return [(label, members) for label, members in groups if members]


def _groups_of_v(run: Recording, names: Sequence[str] | None) -> list[tuple[str, list[int]]]:
    """Return (label of the axis, velocities) of turning and of moving along."""
    columns = _wanted(run, "v", names)
    if run.model is None:
        return [("velocities", columns)] if columns else []
    units = {c.name: c.unit for c in run.model.coordinates}
    turning = {  # those that are no coordinate's are a ball's, or a free body's: base_vx, base_wx
        i for i in columns
        if units.get(run.velocity_names[i]) == "rad"
        or (run.velocity_names[i] not in units and run.velocity_names[i][-2:-1] == "w")
    }  # fmt: skip
    groups = [
        ("velocity [rad/s]", [i for i in columns if i in turning]),
        ("velocity [m/s]", [i for i in columns if i not in turning]),
    ]
    return [(label, members) for label, members in groups if members]


def _coordinates(run: Recording, label: str, columns: list[int]) -> Panel:
    names = [run.coordinate_names[i] for i in columns]
    limits = _near_limits(run, columns) if len(columns) <= MOST_LABELS else []

    def draw(axes: Axes) -> None:
        draw_lines(axes, run.t, run.q[:, columns], names)
        axes.set_ylabel(label)
        for line, limit in limits:
            style = {"color": style_of(line)["color"], "ls": (0, (1, 3)), "lw": 1.0}
            axes.axhline(limit, label=f"limit {limit:.4g}".replace("-", "−"), zorder=1, **style)
        if limits:
            axes.legend(**LEGEND)

    return Panel(draw, labels_of(len(columns)) + len(limits))


def _near_limits(run: Recording, columns: list[int]) -> list[tuple[int, float]]:
    """Return (line, limit) of the limits that coordinates come near."""
    if run.model is None:
        return []
    near = NEAR * max(float(np.ptp(run.q[:, columns])), 1e-12)
    found = []
    for line, column in enumerate(columns):
        q, coordinate = run.q[:, column], run.model.coordinates[column]
        for limit, reached in ((coordinate.lower, q.min()), (coordinate.upper, q.max())):
            if abs(reached - limit) <= near:
                found.append((line, limit))
    return found


def _velocities(run: Recording, label: str, columns: list[int]) -> Panel:
    def draw(axes: Axes) -> None:
        draw_lines(axes, run.t, run.v[:, columns], [run.velocity_names[i] for i in columns])
        axes.set_ylabel(label)

    return Panel(draw, labels_of(len(columns)))


def _draw_control(axes: Axes, run: Recording) -> None:
    draw_lines(axes, run.t, run.control, run.control_names, drawstyle="steps-post")
    axes.set_ylabel("control")


def _draw_energies(axes: Axes, run: Recording) -> None:
    lowest = float(run.potential.min())
    moved = "" if lowest == 0 else " − min"
    draw_lines(
        axes,
        run.t,
        np.stack([run.kinetic, run.potential - lowest], axis=1),
        ["kinetic", f"potential{moved}"],
    )
    total = run.total - lowest
    axes.plot(run.t, total, color=BLACK, lw=1.4, label=f"total{moved}", **dots(len(run)))
    axes.set_ylabel("energy [J]")
    axes.legend(**LEGEND)


def _draw_work(axes: Axes, t: Array, done: dict[str, Array]) -> None:
    draw_lines(axes, t, np.stack([*done.values()], axis=1), [*done])
    axes.set_ylabel("work [J]")


def _draw_error(axes: Axes, run: Recording) -> None:
    works = [work for work in run.work.values() if work.any()]
    done = np.sum(works, axis=0) if works else np.zeros(len(run))
    total = run.total - run.total[0] - done
    shadow = run.shadow - run.shadow[0] - done
    axes.plot(run.t, total, color=BLACK, lw=1.3, label="total", **dots(len(run)))
    axes.plot(run.t, shadow, color=COLOURS[1], lw=1.1, ls="--", label="shadow")
    keep_flat(axes, total, shadow)
    axes.set_ylabel("H − H₀ − W [J]" if works else "H − H₀ [J]")
    axes.legend(**LEGEND)
