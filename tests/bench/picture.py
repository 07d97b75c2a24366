"""Time of a step against the number of coordinates, for every engine."""

from __future__ import annotations

import importlib.util
from pathlib import Path

LINES = {  # name of the time: label, colour (of a set that colour-blind readers can tell apart)
    "step": ("saltus", "#000000"),
    "mujoco_step": ("MuJoCo, Euler", "#0072b2"),
    "mujoco_implicit_step": ("MuJoCo, implicit", "#56b4e9"),
    "drake_step": ("Drake, discrete", "#d55e00"),
    "dart_step": ("DART", "#009e73"),
}


def write(rows: list[dict], file: Path) -> bool:
    """Draw chains and cradles side by side; False if there is no matplotlib."""
    if importlib.util.find_spec("matplotlib") is None:
        return False
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 4), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for ax, kind in zip(axes, ("chain", "cradle"), strict=True):
        draw(ax, [row for row in rows if row["kind"] == kind])
        ax.set_title(f"{kind}s")
        ax.set_xlabel("coordinates n")
    axes[0].set_ylabel("CPU time of a step of 1 ms [µs]")
    axes[0].legend(frameon=False)
    figure.savefig(file, dpi=110)
    return True


def draw(ax, rows: list[dict]) -> None:
    for name, (label, colour) in LINES.items():
        points = [(row["n"], row[name]["min"]) for row in rows if name in row]
        if points:
            width = 2.2 if name == "step" else 1.3
            ax.loglog(*zip(*points, strict=True), "o-", ms=3, lw=width, color=colour, label=label)
    ax.grid(True, which="major", lw=0.4, alpha=0.6)
    ax.spines[["top", "right"]].set_visible(False)
