"""A Newton's cradle as the paper draws it: velocities of the outer balls, and sketches.

Seghete and Murphey, "Multiple Instantaneous Collisions in a Variational Framework", Fig. 3.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from saltus._core import Model, ModelError, Sphere
from saltus.plots.figure import finish, new_figure
from saltus.records.recording import Recording
from saltus.records.tables import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


SKETCHES = 6  # chosen times where the caller names none


@dataclass(frozen=True)
class Row:
    """Balls that hang in a row, from left to right."""

    balls: list[int]  # indices of shapes
    along: Array  # unit vector from the first ball to the last, shape (3,)
    up: Array  # unit vector against gravity, shape (3,)

    def across(self, points: Array) -> Array:
        """Return points (..., 3) as (..., 2) in the plane of the row."""
        return np.stack([points @ self.along, points @ self.up], axis=-1)


def is_cradle(run: Recording) -> bool:
    """Return True where `plot_cradle` can draw the run."""
    return run.model is not None and _find_row(run.model) is not None


def plot_cradle(
    run: Recording,
    path: str | os.PathLike[str] | None = None,
    *,
    times: Sequence[float] | None = None,
) -> Figure:
    """Draw the velocities of the outer balls and sketches of the cradle at chosen times.

    The continuous line is the right ball, the dotted one the left; positive is to the right.

    Parameters
    ----------
    run : Trajectory
    path : str or os.PathLike, optional
        Where the picture is written.
    times : sequence of float, optional
        [s] when to draw sketches; else six between impacts and at them.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        Where the model is no row of hanging balls, a time is outside the run, or matplotlib is
        not installed.
    """
    row = _find_row(run.require_model())
    if row is None:
        raise ModelError("this model is no cradle: balls in a row at one height, nothing else")
    chosen = _choose_times(run) if times is None else _check_times(run, times)
    figure = new_figure(path, (8.0, 4.6))
    axes, above = _layout(figure, len(chosen))
    for ball, style in ((row.balls[-1], "-"), (row.balls[0], ":")):
        side = "right" if style == "-" else "left"
        axes.plot(run.t, _speed(run, row, ball), "k" + style, lw=1.3, label=f"{side} ball")
    _draw_axes(axes, run)
    _draw_sketches(above, axes, run, row, chosen)
    return finish(figure, path)


def _find_row(model: Model) -> Row | None:
    """Return the balls of a cradle: two or more at one height, on one line, and nothing else."""
    if len(model.shapes) < 2 or not all(isinstance(s.shape, Sphere) for s in model.shapes):
        return None
    gravity = np.linalg.norm(model.gravity)
    if gravity == 0:
        return None
    up = -model.gravity / gravity
    rest = model.neutral()[np.newaxis]
    centres = np.array([model.shape_poses(rest, i)[0, :3, 3] for i in range(len(model.shapes))])
    spread = centres - centres[0]
    widest = spread[np.argmax(np.linalg.norm(spread, axis=1))]
    width = np.linalg.norm(widest)
    if width == 0:
        return None
    along = widest / width
    if along[np.argmax(abs(along))] < 0:  # left to right is along the axis, not against it
        along = -along
    off_the_line = spread - np.outer(spread @ along, along)
    if abs(along @ up) > 1e-9 or np.abs(off_the_line).max() > 1e-9 * width:
        return None
    return Row([int(i) for i in np.argsort(centres @ along)], along, up)


def _speed(run: Recording, row: Row, ball: int) -> Array:
    velocities = run.require_model().shape_velocities(run.q, run.v, ball)
    speed: Array = velocities[:, 3:] @ row.along
    return speed


def _radius(model: Model, ball: int) -> float:
    shape = model.shapes[ball].shape
    assert isinstance(shape, Sphere)  # _find_row takes no other
    return shape.radius


def _check_times(run: Recording, times: Sequence[float]) -> list[float]:
    for t in times:
        if not run.t[0] <= t <= run.t[-1]:
            raise ModelError(
                f"no sketch at t = {t:g} s: the run goes from {run.t[0]:g} to {run.t[-1]:g} s"
            )
    return [float(t) for t in times]


def _choose_times(run: Recording) -> list[float]:
    """Return times at impacts and halfway between them, spread over the run."""
    begin, end = float(run.t[0]), float(run.t[-1])
    impacts = run.impacts["t"]
    if len(impacts) > 0:  # impacts in quick succession are one event
        gaps = np.diff(impacts, prepend=-np.inf)
        impacts = impacts[gaps > 0.02 * (end - begin)]
    edges = np.concatenate([[begin], impacts, [end]])
    candidates = np.sort(np.concatenate([[begin], impacts, (edges[1:] + edges[:-1]) / 2]))
    slots = begin + (np.arange(SKETCHES) + 0.5) * (end - begin) / SKETCHES
    nearest = {float(candidates[np.argmin(abs(candidates - slot))]) for slot in slots}
    return sorted(nearest)


def _layout(figure: Figure, sketches: int) -> tuple[Axes, list[Axes]]:
    """Return the axes of the velocities and those of the sketches above them."""
    grid = figure.add_gridspec(2, max(sketches, 1), height_ratios=[1.0, 1.9])
    axes = figure.add_subplot(grid[1, :])
    return axes, [figure.add_subplot(grid[0, i]) for i in range(sketches)]


def _draw_axes(axes: Axes, run: Recording) -> None:
    axes.axhline(0, color="0.7", lw=0.6, zorder=0)
    axes.set_xlim(run.t[0], run.t[-1])
    axes.margins(y=0.15)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("velocity [m/s]")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="upper right", bbox_to_anchor=(1.0, -0.1), ncols=2, frameon=False)


def _draw_sketches(
    above: Sequence[Axes], axes: Axes, run: Recording, row: Row, times: Sequence[float]
) -> None:
    from matplotlib.patches import Circle, ConnectionPatch

    model = run.require_model()
    rows = [int(np.argmin(abs(run.t - t))) for t in times]
    configurations = run.q[rows]
    centres, pivots = {}, {}
    for ball in row.balls:
        placed = model.shapes[ball]
        centres[ball] = row.across(model.shape_poses(configurations, ball)[:, :3, 3])
        pivots[ball] = row.across(model.poses(configurations, placed.link)[:, :3, 3])
    everything = np.concatenate([*centres.values(), *pivots.values()])
    reach = max(_radius(model, ball) for ball in row.balls)
    low, high = everything.min(axis=0) - 1.3 * reach, everything.max(axis=0) + 1.3 * reach
    for k, sketch in enumerate(above):
        for ball in row.balls:
            line = np.stack([pivots[ball][k], centres[ball][k]])
            sketch.plot(line[:, 0], line[:, 1], color="0.4", lw=0.8, zorder=0)
            circle = Circle(centres[ball][k], _radius(model, ball), fc="0.85", ec="black", lw=0.8)
            sketch.add_patch(circle)
        tops = np.array([pivots[ball][k] for ball in row.balls])
        sketch.plot(tops[:, 0], tops[:, 1], color="black", lw=2.0, solid_capstyle="round")
        sketch.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        sketch.axis("off")
        # From under the sketch to its time, ending on the line of velocity 0.
        arrow = ConnectionPatch(
            xyA=(0.5, 0.0),
            coordsA=sketch.transAxes,
            xyB=(run.t[rows[k]], 0.0),
            coordsB=axes.transData,
            arrowstyle="-|>",
            color="0.45",
            lw=0.8,
            shrinkA=1,
            shrinkB=2,
        )
        axes.figure.add_artist(arrow)
