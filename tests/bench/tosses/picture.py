"""The errors of all tosses as curves: which part of them is nearer than x."""

from __future__ import annotations

from pathlib import Path

import numpy as np

COLOURS = {  # of a set that colour-blind readers can tell apart
    "saltus": "#000000",
    "MuJoCo": "#0072b2",
    "Drake": "#009e73",
    "PyBullet": "#d55e00",
}
TITLES = {
    "recorded": "starts as recorded",
    "calibrated": "starts calibrated",
    "flight": "starts from the whole flight",
}
AXES = (("position error [widths]", (0.01, 1.0)), ("angle [deg]", (1.0, 100.0)))


def draw(results: dict, file: Path) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 6), layout="constrained")
    axes = figure.subplots(2, 3, sharey=True, sharex="row")
    for column, (start, title) in enumerate(TITLES.items()):
        axes[0, column].set_title(title, fontsize="medium")
        for engine in results["engines"]:
            errors = array(engine["starts"][start]["errors"])
            curve(axes[:, column], errors, color=COLOURS[engine["name"]], label=engine["name"])
    for engine in results["engines"][:1]:
        label = f"{engine['name']} beside itself,\nwith the starts' noise"
        curve(axes[:, 1], array(engine["noise"]), color="0.5", ls=":", label=label)
    for (label, (low, high)), row in zip(AXES, axes, strict=True):
        for ax in row:
            ax.set(xscale="log", xlim=(low, high), ylim=(0, 1), xlabel=label)
            ax.grid(True, which="major", lw=0.4, alpha=0.6)
            ax.spines[["top", "right"]].set_visible(False)
        row[0].set_ylabel("part of the tosses")
    axes[0, 1].legend(frameon=False, fontsize=8, loc="upper left")
    figure.savefig(file, dpi=120)


def array(errors: list) -> np.ndarray:
    """Return errors (n, 2), infinite where a toss failed (None, or why in words)."""
    return np.array([(np.inf, np.inf) if e is None or isinstance(e, str) else e for e in errors])


def curve(axes, errors: np.ndarray, **style) -> None:
    """Draw the distribution of positions and angles upon two axes."""
    parts = (np.arange(len(errors)) + 1) / len(errors)
    for ax, values in zip(axes, np.sort(errors, axis=0).T, strict=True):
        ax.step(values, parts, where="post", lw=1.4, **style)
