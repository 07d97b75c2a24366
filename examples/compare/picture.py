"""The comparison as a picture: velocities after impacts, a minute of a cradle, breaks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from compare import report
from compare.scene import Scene

COLOURS = {  # of a set that colour-blind readers can tell apart
    "saltus": "#000000",
    "MuJoCo": "#0072b2",
    "DART": "#009e73",
    "PyBullet": "#d55e00",
    "pymunk": "#cc79a7",
}
LEAST = 1e-16  # what is less is drawn here


def draw(scenes: Sequence[Scene], results: Sequence[dict], file: Path) -> None:
    from matplotlib.figure import Figure

    names = [result["name"] for result in results]
    figure = Figure(figsize=(11, 5.6), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=[1.25, 1.0])
    axes = above.subplots(1, 4, sharey=True)
    rows = [scene for scene in scenes if scene.kind != "break" and not scene.gap]
    for ax, scene in zip(axes, rows, strict=False):
        draw_velocities(ax, scene, results)
    draw_minute(axes[-1], rows[0], results)
    axes[0].set_yticks(range(len(names)), names)
    axes[0].set_ylim(len(names) - 0.5, -0.5)
    for ax in axes:
        ax.spines[["top", "right", "left"]].set_visible(False)
        ax.tick_params(axis="y", length=0)
        ax.hlines(range(len(names)), 0, 1, color="0.9", lw=0.6, zorder=0,
                  transform=ax.get_yaxis_transform())  # fmt: skip
    (table,) = (scene for scene in scenes if scene.kind == "break")
    for ax, result in zip(np.atleast_1d(below.subplots(1, len(names))), results, strict=True):
        draw_break(ax, table, result)
    below.suptitle("velocities after a billiard break", fontsize="medium")
    figure.savefig(file, dpi=130)


def draw_velocities(ax, scene: Scene, results: Sequence[dict]) -> None:
    """Draw a mark with a number for each ball, upon grey lines where they should be."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2.5, foreground="white")]
    exact = report.EXACT[scene.name]
    for x in sorted(set(exact)):
        ax.axvline(x, color="0.85", lw=5, zorder=0)
    for row, result in enumerate(results):
        measured = result["scenes"].get(scene.name)
        if measured is None:
            continue
        colour = COLOURS[result["name"]]
        for x, balls in clusters(measured["exits"]):
            ax.plot(x, row, "o", ms=4, color=colour, zorder=3)
            ax.annotate(
                " ".join(map(str, balls)), (x, row), xytext=(0, 4), textcoords="offset points",
                ha="center", fontsize=7.5, color=colour, path_effects=halo,
            )  # fmt: skip
    ax.set_title(scene.name, fontsize="medium")
    ax.set_xlabel("velocity after the impact")
    ax.margins(x=0.12)


def clusters(exits: Sequence[float]) -> list[tuple[float, list[int]]]:
    """Return velocities that differ, each with the numbers of the balls that have it."""
    groups: list[tuple[float, list[int]]] = []
    for i in np.argsort(exits, kind="stable"):
        if groups and exits[i] - groups[-1][0] < 0.03:
            groups[-1][1].append(int(i) + 1)
        else:
            groups.append((exits[i], [int(i) + 1]))
    return [(x, sorted(balls)) for x, balls in groups]


def draw_minute(ax, scene: Scene, results: Sequence[dict]) -> None:
    for row, result in enumerate(results):
        measured = result["scenes"].get(scene.name)
        if measured is None:
            continue
        colour = COLOURS[result["name"]]
        for name, style in (("resting", "o"), ("energy", "D")):
            value = max(abs(measured[name]), LEAST)
            fill = colour if name == "resting" else "white"
            ax.plot(value, row, style, ms=5, color=colour, mfc=fill, zorder=3)
    for name, style, fill in (("ball at rest [rad]", "o", "0.3"), ("energy error", "D", "white")):
        ax.plot([], [], style, ms=5, color="0.3", mfc=fill, label=name)
    ax.set_xscale("log")
    ax.set_xlim(LEAST / 4, 10)
    ticks = [LEAST, 1e-12, 1e-8, 1e-4, 1]
    ax.set_xticks(ticks, ["0", *(f"$10^{{{round(np.log10(x))}}}$" for x in ticks[1:])])
    ax.minorticks_off()
    ax.set_title(f"{scene.name}, {scene.duration:g} s", fontsize="medium")
    ax.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2, frameon=False, fontsize=7,
        handletextpad=0.1, columnspacing=0.8,
    )  # fmt: skip


def draw_break(ax, scene: Scene, result: dict) -> None:
    """Draw the triangle as it lay, with the velocity of each ball as an arrow."""
    from matplotlib.patches import Circle

    ax.axis("off")
    ax.set_title(result["name"], fontsize="medium", color=COLOURS[result["name"]])
    measured = result["scenes"].get(scene.name)
    if measured is None:
        return
    places = np.array(scene.places)
    places[0] = places[1] - (2 * scene.radius, 0)  # the cue, where it hits
    ways = np.array(measured["ways"]) * 10 * scene.radius
    for place in places:
        ax.add_patch(Circle(place, scene.radius, fc="0.95", ec="0.7", lw=0.6))
    ax.quiver(
        *places.T, *ways.T, angles="xy", scale_units="xy", scale=1, width=0.012,
        color=COLOURS[result["name"]], zorder=3,
    )  # fmt: skip
    left, right = places[0, 0] - 6 * scene.radius, places[-1, 0] + 8.5 * scene.radius
    high = 9.5 * scene.radius
    ax.set(xlim=(left, right), ylim=(-high, high), aspect="equal")
