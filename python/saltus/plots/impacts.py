"""Pictures of impacts: one as a cascade of impulses, all of a run over time.

In both a row is a pair, and the area of a mark is its impulse.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from saltus._core import Impact, ModelError
from saltus.plots.figure import finish, new_figure
from saltus.plots.lines import shortened
from saltus.records.impacts import count_line
from saltus.records.recording import Recording
from saltus.records.tables import Array, counted

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


WIDTH = 8.0  # [in] of a picture
NARROWED = 0.62  # part of the width that names and sums leave
ROW, ROWS = 0.34, 9.0  # [in] height of a row, and of all rows at the most
LARGEST, SMALLEST = 20.0, 2.5  # [pt] diameters: of the strongest impulse, of any that is seen
CROWDED = 8.0  # [pt] of the strongest impulse, however narrow rows and columns are
MOST_LETTERS = 34  # of a name
MOST_LABELS = 45  # rows with a name each; of more rows some are named
BLUE = "#0072b2"
STYLE: dict[str, Any] = {
    "color": BLUE,
    "edgecolors": "white",
    "linewidths": 0.6,
    "zorder": 2,
    "clip_on": False,
}
DENSE = 3.0  # [pt] a mark of the busiest row: marks overlap, and are drawn to show how densely
DENSE_STYLE: dict[str, Any] = {"linewidths": 0, "alpha": 0.25}


@dataclass(frozen=True)
class Scale:
    """Diameters whose squares are as the impulses."""

    largest: float  # [pt]
    strongest: float  # [N s] > 0

    def diameters(self, impulses: Array) -> Array:
        """Return diameters [pt] of marks."""
        part = np.sqrt(np.clip(impulses / self.strongest, 0, 1))
        return np.maximum(self.largest * part, SMALLEST)


@dataclass(frozen=True)
class Marks:
    """Sums of the impulses of each pair in each impact, in order of impacts, then of rows."""

    pairs: npt.NDArray[np.int_]  # indices of names, one a row
    impact: npt.NDArray[np.int_]
    row: npt.NDArray[np.int_]
    sums: Array  # [N s]


def _sums(run: Recording) -> Marks:
    pairs, rows = np.unique(run.impulses["pair"], return_inverse=True)
    many = max(len(pairs), 1)
    cells, places = np.unique(run.impulses["impact"] * many + rows, return_inverse=True)
    sums = np.zeros(len(cells))
    np.add.at(sums, places, run.impulses["lambda"])
    return Marks(pairs, *np.divmod(cells, many), sums)


def plot_impacts(
    run: Recording, path: str | os.PathLike[str] | None = None, *, index: int | None = None
) -> Figure:
    """Draw which pairs took impulses when: time to the right, a row a pair.

    Marks of one impact are joined by a line. A mark is the sum of all impulses that its pair took
    at that instant. A run of one impact is drawn as that one's cascade.

    Parameters
    ----------
    run : Trajectory
    path : str or os.PathLike, optional
        Where the picture is written.
    index : int, optional
        Draw this impact alone, as `plot_cascade` does.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        Where matplotlib is not installed.
    """
    if index is None and len(run.impacts) == 1:
        index = 0
    if index is not None:
        impact = run.impact(index)
        return plot_cascade(impact, path, pairs=sorted(set(impact.pairs), key=run.pair_names.index))
    marks = _sums(run)
    figure, axes, height = _rows(path, [run.pair_names[pair] for pair in marks.pairs])
    if len(marks.sums):
        busiest = np.bincount(marks.row).max()
        column = NARROWED * WIDTH * 72 / busiest  # [pt] a mark, where they are spread evenly
        scale = Scale(_largest(height, 1.5 * column), float(marks.sums.max()))
        starts = np.flatnonzero(np.diff(marks.impact, prepend=-1))
        ends = np.append(starts[1:], len(marks.sums)) - 1
        t = run.impacts["t"][marks.impact]
        ways = (t[starts], marks.row[starts], marks.row[ends])
        axes.vlines(*ways, color=BLUE, lw=0.7, alpha=0.45, zorder=1)
        style = STYLE if column > DENSE else {**STYLE, **DENSE_STYLE}
        axes.scatter(t, marks.row, s=scale.diameters(marks.sums) ** 2, **style)
        _legend(axes, scale)
    else:
        axes.text(0.5, 0.5, "no impacts", ha="center", va="center", transform=axes.transAxes)
        axes.set_yticks([])
    if len(run) > 1:
        axes.set_xlim(run.t[0], run.t[-1])
    axes.set_xlabel("time [s]", loc="left")
    axes.set_title(
        f"{counted(len(run.impacts), 'impact')}, {counted(len(run.impulses), 'impulse')}",
        loc="left",
        fontsize="medium",
    )
    return finish(figure, path)


def plot_cascade(
    impact: Impact,
    path: str | os.PathLike[str] | None = None,
    *,
    pairs: Sequence[str] | None = None,
) -> Figure:
    """Draw the impulses of one impact in their order: to the right, numbered, a row a pair.

    Parameters
    ----------
    impact : Impact
        From `run.impact(i)` or a stepper's report.
    path : str or os.PathLike, optional
        Where the picture is written.
    pairs : sequence of str, optional
        The rows from top to bottom; else pairs in the order in which they first take an impulse.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        Where an impulse's pair is none of `pairs`, or matplotlib is not installed.
    """
    names = list(dict.fromkeys(impact.pairs if pairs is None else pairs))
    missing = set(impact.pairs) - set(names)
    if missing:
        raise ModelError(f'no row for pair "{min(missing)}"; rows are {", ".join(names)}')
    row_of = {name: row for row, name in enumerate(names)}
    rows = np.array([row_of[pair] for pair in impact.pairs], dtype=int)
    figure, axes, height = _rows(path, names)
    order = np.arange(1, len(rows) + 1)
    column = NARROWED * WIDTH * 72 / max(len(rows), 1)  # [pt]
    if len(rows):
        scale = Scale(_largest(height, column), float(impact.lambdas.max()))
        diameters = scale.diameters(impact.lambdas)
        axes.plot(order, rows, color="0.75", lw=0.8, zorder=1)
        axes.scatter(order, rows, s=diameters**2, **STYLE)
        if column >= 11:
            _number(axes, rows, diameters)
        if len(names) <= MOST_LABELS:
            sums = np.zeros(len(names))
            np.add.at(sums, rows, impact.lambdas)
            _totals(axes, sums)
        _legend(axes, scale)
    axes.set_xlim(0.4, len(rows) + 0.6)
    axes.set_xlabel("impulses in order", loc="left")
    axes.locator_params(axis="x", integer=True)
    axes.set_title(f"t = {impact.t:.6f} s: {count_line(impact)}", loc="left", fontsize="medium")
    return finish(figure, path)


def _largest(*room: float) -> float:
    """Return the diameter of the strongest impulse in rows and columns of these sizes [pt]."""
    return max(CROWDED, min(LARGEST, *(0.9 * size for size in room)))


def _rows(path: str | os.PathLike[str] | None, names: Sequence[str]) -> tuple[Figure, Axes, float]:
    """Return a figure with a row for each name, first on top, and the height of a row [pt]."""
    count = max(len(names), 1)
    height = min(count * ROW, ROWS)
    figure = new_figure(path, (WIDTH, height + 1.35))
    axes = figure.add_subplot()
    axes.set_ylim(count - 0.4, -0.6)
    every = -(-len(names) // MOST_LABELS) if names else 1
    shown = [shortened(name, MOST_LETTERS) for name in names[::every]]
    axes.set_yticks(range(0, len(names), every), shown, fontsize="small")
    axes.tick_params(axis="y", length=0)
    axes.spines[["top", "right", "left"]].set_visible(False)
    if len(names) <= MOST_LABELS:
        axes.hlines(range(len(names)), 0, 1, color="0.9", lw=0.6, zorder=0,
                    transform=axes.get_yaxis_transform())  # fmt: skip
    return figure, axes, 72 * height / count


def _number(axes: Axes, rows: npt.NDArray[np.int_], diameters: Array) -> None:
    """Write the number of each impulse into its mark, or above it where that is too small."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2.5, foreground="white")]
    for i, (row, diameter) in enumerate(zip(rows, diameters, strict=True)):
        inside = diameter >= (13.0 if i < 99 else 17.0)
        axes.annotate(
            str(i + 1),
            (i + 1, row),
            xytext=(0, 0 if inside else diameter / 2 + 1),
            textcoords="offset points",
            ha="center",
            va="center_baseline" if inside else "bottom",
            color="white" if inside else "0.3",
            fontsize=7,
            path_effects=None if inside else halo,
        )


def _totals(axes: Axes, sums: Array) -> None:
    """Write the sum of each row's impulses to the right of it."""
    style: dict[str, Any] = {"fontsize": "small", "color": "0.3"}
    where = axes.get_yaxis_transform()
    for row, total in enumerate(sums):
        axes.text(1.02, row, f"{total:.4g}", transform=where, va="center", **style)
    axes.annotate(
        "Σ λ [N s]", (1.02, 1.0), xycoords="axes fraction", xytext=(0, 6),
        textcoords="offset points", **style,
    )  # fmt: skip


def _legend(axes: Axes, scale: Scale) -> None:
    """Show what sizes of marks mean, below the axes."""
    from matplotlib.lines import Line2D

    impulses = scale.strongest * np.array([1.0, 0.5, 0.1])
    marks = [
        Line2D([], [], ls="none", marker="o", color=BLUE, mec="white", mew=0.6, ms=float(diameter))
        for diameter in scale.diameters(impulses)
    ]
    labels = [f"{impulse:.3g} N s" for impulse in impulses]
    axes.legend(
        marks, [f"λ = {labels[0]}", *labels[1:]], loc="upper right", ncols=3, frameon=False,
        bbox_to_anchor=(1.0, 0.0), borderaxespad=2.4, handletextpad=0.8, fontsize="small",
    )  # fmt: skip
