"""Lines over time that print in grey and that the colour-blind can tell apart; marks of impacts.

Colours are those of Okabe and Ito. Each line has its own dashes besides, so that a legend can be
read without colours.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus.records.tables import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9")
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))
BLACK = "black"
MOST_LABELS = 8  # lines with a style each; more of them are thin, coloured from first to last
MOST_LETTERS = 22  # of a name in a legend
FLAT = 1e-12  # [SI] what is smaller is rounding, and drawn as 0
MOST_MARKS = 300  # impacts drawn as lines; more of them are a rug
FEW_ROWS = 30  # so few that each is a dot as well
LEGEND: dict[str, Any] = {
    "loc": "center left",
    "bbox_to_anchor": (1.0, 0.5),
    "frameon": False,
    "fontsize": "small",
    "handlelength": 2.6,
}


def shortened(name: str, most: int = MOST_LETTERS) -> str:
    """Return a name without its middle, where it is too long; of a pair, of both its names."""
    if len(name) <= most:
        return name
    if name.count(" ~ ") == 1:
        a, b = name.split(" ~ ")
        room = most - 3
        half = max(room // 2, room - min(len(a), len(b)))
        return f"{shortened(a, half)} ~ {shortened(b, half)}"
    first = (most - 1) // 2
    return f"{name[:first]}…{name[first + 1 - most :]}"


def style_of(line: int) -> dict[str, Any]:
    """Return colour and dashes of a line by its number."""
    return {"color": COLOURS[line % len(COLOURS)], "ls": DASHES[line % len(DASHES)], "lw": 1.3}


def dots(rows: int) -> dict[str, Any]:
    """Return marks of the rows where they are few; one row alone has no line."""
    return {"marker": "o", "ms": 3.0} if rows <= FEW_ROWS else {}


def draw_lines(axes: Axes, t: Array, columns: Array, names: Sequence[str], **style: Any) -> None:
    """Draw columns (rows, n) over time, with a legend to the right."""
    many = len(names) > MOST_LABELS
    for i, name in enumerate(names):
        own = _style_of_many(i, len(names)) if many else style_of(i)
        label = shortened(name)
        if many and i not in (0, len(names) - 1):
            label = f"_{label}"  # which legends leave out
        axes.plot(t, columns[:, i], label=label, **{**own, **dots(len(t)), **style})
    keep_flat(axes, columns)
    legend = axes.legend(**LEGEND)
    if many:
        legend.set_title(f"{len(names)} lines, from")
        legend.get_title().set_fontsize("small")


def keep_flat(axes: Axes, *columns: Array) -> None:
    """Keep what is 0 but for rounding from filling the axes."""
    if all(np.abs(each).max(initial=0.0) < FLAT for each in columns):
        axes.set_ylim(-FLAT, FLAT)
        axes.set_yticks([0.0])


def labels_of(count: int) -> int:
    """Return the lines of text in the legend of so many lines."""
    return count if count <= MOST_LABELS else 3


def _style_of_many(line: int, count: int) -> dict[str, Any]:
    """Return a thin line's colour, from dark to light: told apart by lightness too."""
    from matplotlib import colormaps

    return {"color": colormaps["viridis"](0.88 * line / max(count - 1, 1)), "lw": 0.7}


def mark_times(axes: Axes, times: Array) -> None:
    """Mark instants by grey lines, by a rug below the axes where they are too many."""
    if 0 < len(times) <= MOST_MARKS:
        for t in times:
            axes.axvline(t, color="0.8", lw=0.6, zorder=0)
    elif len(times) > 0:
        heights = np.full(len(times), -0.02)
        style: dict[str, Any] = {"ls": "none", "marker": "|", "ms": 4, "color": "0.5"}
        axes.plot(times, heights, transform=axes.get_xaxis_transform(), clip_on=False, **style)
