"""The gaps of a run over time, exact at its impacts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from saltus._core import Model
from saltus.plots.lines import LEGEND, MOST_LABELS, dots, shortened, style_of
from saltus.records.pairs import (
    ShapePair,
    gaps_over,
    named_pairs,
    pair_name,
    pairs_of_run,
    shapes_of_pairs,
)
from saltus.records.recording import Recording
from saltus.records.tables import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_VALUES = 12_000  # of gaps that are computed for a picture: a tenth of a second
NEAREST = 4  # pairs that are drawn where none met
TRIED = 200  # pairs among which the nearest are looked for
LOOKS = 20  # rows in which they are looked for


class GapLine(NamedTuple):
    """The gap of two shapes over time."""

    name: str
    t: Array  # [s]
    phi: Array  # [m]
    impacts: Array  # [s] when the two took an impulse; the gap is 0 there


def gap_lines(run: Recording, names: Sequence[str] | None = None) -> list[GapLine]:
    """Return the gaps of pairs by name; else of those that met, else of the nearest.

    Rows are left out where there are very many; instants of impacts are not.
    """
    if run.model is None or not run.model.shapes:
        return []
    model = run.model
    met = shapes_of_pairs(run, model)
    chosen = _chosen(run, model, list(met.values())) if names is None else named_pairs(model, names)
    if not chosen:
        return []
    every = -(-len(run) * len(chosen) // MOST_VALUES)
    rows = np.unique([*range(0, len(run), every), len(run) - 1])
    values = gaps_over(model, run.q[rows], chosen)
    times = run.impacts["t"][run.impulses["impact"]]
    lines = []
    for column, pair in enumerate(chosen):
        numbers = [number for number, shapes in met.items() if shapes == pair]
        touched = np.unique(times[np.isin(run.impulses["pair"], numbers)])
        t = np.concatenate([run.t[rows], touched])
        order = np.argsort(t, kind="stable")
        phi = np.concatenate([values[:, column], np.zeros(len(touched))])
        lines.append(GapLine(pair_name(model, pair), t[order], phi[order], touched))
    return lines


def _chosen(run: Recording, model: Model, met: list[ShapePair]) -> list[ShapePair]:
    pairs = pairs_of_run(run, model)
    used = [pair for pair in pairs if pair in met]
    if used:
        return used[:MOST_LABELS]
    tried = pairs[:TRIED]
    if len(tried) > NEAREST:
        rows = np.linspace(0, len(run) - 1, min(LOOKS, len(run))).astype(int)
        nearest = gaps_over(model, run.q[rows], tried).min(axis=0)
        tried = [tried[i] for i in np.sort(np.argsort(nearest)[:NEAREST])]
    return tried


def draw_gaps(axes: Axes, lines: Sequence[GapLine]) -> None:
    """Draw gaps, and a dot at 0 for each impact of a pair."""
    axes.axhline(0, color="0.7", lw=0.6, zorder=0)
    for i, line in enumerate(lines):
        style = style_of(i)
        axes.plot(line.t, line.phi, label=shortened(line.name), **style, **dots(len(line.t)))
        if len(line.impacts):
            style = {"ls": "none", "marker": "o", "ms": 3.0, "color": style["color"]}
            axes.plot(line.impacts, np.zeros(len(line.impacts)), label="_impacts", **style)
    axes.set_ylabel("gap [m]")
    axes.legend(**LEGEND)
