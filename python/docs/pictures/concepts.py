"""Draws the pictures of the concepts: a step as a timeline, the corners of a box, the layers.

Run it in the project's folder: python python/docs/pictures/concepts.py [FOLDER]. What it draws is
what the library says: instants, names of parts, and the layers of its page.
"""

from __future__ import annotations

import re
import sys
from itertools import pairwise
from pathlib import Path

import matplotlib as mpl

mpl.use("agg")
mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "saltus", "font.size": 11})

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

import saltus  # noqa: E402

HERE = Path(__file__).parent
BLUE, RED, GREY, INK = "#0072b2", "#d55e00", "#8b97a5", "#1c2430"
H = 0.1  # s


def step() -> Figure:
    """Return a step of a ball between two walls: three arcs and two impacts."""
    builder = saltus.ModelBuilder("ball").set_gravity((0, 0, 0))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, joint="prismatic", joint_name="x")
    builder.add_half_space("left", (1, 0, 0), -0.6).add_half_space("right", (-1, 0, 0), -0.5)
    builder.set_default_contact(restitution=1.0, friction=0.0)
    stepper = saltus.Stepper(builder.build(), h=H)
    stepper.advance(stepper.model.state({"x": 0.1}, {"x": 15.0}))
    nodes = [0.0, *(impact.t for impact in stepper.report.impacts), H]
    places = [0.1]
    for duration, sign in zip(np.diff(nodes), (1, -1, 1), strict=True):
        places.append(places[-1] + sign * 15.0 * duration)
    figure, (above, below) = plt.subplots(
        2, figsize=(7.4, 4.2), sharex=True, height_ratios=(2, 1), layout="constrained"
    )
    for wall in (-0.5, 0.4):
        above.axhline(wall, color=GREY, linewidth=4)
    above.plot(nodes, places, color=INK, marker="o", markersize=5)
    above.plot(np.convolve(nodes, (0.5, 0.5), "valid"), np.convolve(places, (0.5, 0.5), "valid"),
               "s", color=BLUE, markersize=7, label="where an arc is evaluated")  # fmt: skip
    above.plot(nodes[1:-1], places[1:-1], "o", color=RED, markersize=10, label="impact")
    above.set(ylabel="q [m]", ylim=(-0.62, 0.52))
    above.legend(loc="upper right", bbox_to_anchor=(1, 1.24), ncols=2, frameon=False)
    for number, (start, end) in enumerate(pairwise(nodes), start=1):
        below.annotate(
            "", (start, 0.6), (end, 0.6), arrowprops={"arrowstyle": "<->", "color": BLUE}
        )
        below.text(
            (start + end) / 2, 0.7, f"arc {number}, τ{'₁₂₃'[number - 1]}", ha="center", color=BLUE
        )
        below.text((start + end) / 2, 0.18, "p⁺ → p⁻" if number > 1 else "p → p⁻", ha="center")
    for t in nodes[1:-1]:
        below.axvline(t, color=RED, linewidth=1.5)
        below.text(t, -0.2, "p⁺ = p⁻ + λ n", ha="center", color=RED,
                   bbox={"color": "white", "pad": 1})  # fmt: skip
    below.set(ylim=(-0.35, 1.0), yticks=[], xlim=(-0.002, H + 0.002))
    below.set_xticks([0.0, H], ["t", "t + h"])
    for axes in (above, below):
        axes.spines[["top", "right"]].set_visible(False)
    below.spines["left"].set_visible(False)
    return figure


def corners() -> Figure:
    """Return a box on a floor with the names of the corners that stand on it."""
    half = np.array((0.3, 0.2, 0.1))
    builder = (
        saltus.ModelBuilder("crate").add_floor().set_default_contact(restitution=0, friction=0)
    )
    builder.add_body("crate", saltus.Box(half), mass=1.0, X=saltus.Pose((0, 0, 0.1)))
    gaps = builder.build().gaps(None)
    figure, axes = plt.subplots(figsize=(7.4, 3.6), layout="constrained")

    def at(point: np.ndarray) -> np.ndarray:
        return np.array((point[0] + 0.55 * point[1], point[2] + 0.42 * point[1] - 0.12 * point[0]))

    signs = np.array(np.meshgrid((-1, 1), (-1, 1), (-1, 1))).reshape(3, -1).T
    for one in signs:
        for other in signs:
            if (one != other).sum() == 1 and (one < other).any():
                hidden = (one[[0, 1]] == (-1, 1)).all() or (other[[0, 1]] == (-1, 1)).all()
                style = {"color": GREY if hidden else INK, "linewidth": 1.2 if hidden else 1.8}
                axes.plot(*zip(at(one * half), at(other * half), strict=True), **style,
                          linestyle=":" if hidden else "-")  # fmt: skip
    floor = [
        at(np.array((x, y, -0.1)))
        for x, y in ((-0.6, -0.35), (0.6, -0.35), (0.6, 0.35), (-0.6, 0.35))
    ]
    axes.fill(*zip(*floor, strict=True), color="#eef2f6", zorder=0)
    for name, phi, point in zip(gaps.names, gaps.phi, gaps.p_WA, strict=True):
        place = at(point - (0, 0, 0.1))
        closed = abs(phi) < 1e-12
        axes.plot(*place, "o", color=RED if closed else BLUE, markersize=7)
        words = name.removesuffix(" ~ floor") + ("" if closed else f"  φ = {phi:g} m")
        side = "right" if name.startswith("crate[-") else "left"
        aside = (-8 if side == "right" else 8, -11 if closed else 6)
        axes.annotate(words, place, aside, ha=side,
                      textcoords="offset points", color=RED if closed else BLUE)  # fmt: skip
    axes.set_aspect("equal")
    axes.set_xlim(-1.0, 1.0)
    axes.axis("off")
    return figure


def layers() -> Figure:
    """Return the layers of the library, from the table of their page."""
    text = (HERE.parent / "layers.md").read_text(encoding="utf-8")
    table = text[: text.index("\n\n`python/saltus` has")]
    rows = re.findall(r"^\| `([\w/]+)` \| (.+?) \| (.+?) \|$", table, re.MULTILINE)
    figure, axes = plt.subplots(figsize=(7.4, 5.2), layout="constrained")
    side = [name for name, *_ in rows if name in ("collision", "force", "constraint", "lagrangian")]
    level = 0.0
    for name, turns, into in rows[::-1]:
        short = [
            w if len(w) < 6 else re.sub(r"[,;(].*| of .*", "", w).strip() for w in (turns, into)
        ]
        wide = 1 / len(side) if name in side else 1.0
        left = wide * side.index(name) if name in side else 0.0
        box = (left + 0.003, level), wide - 0.006, 0.86
        axes.add_patch(plt.Rectangle(*box, facecolor="#e6eff6", edgecolor=BLUE))
        high = 0.58 if name in side else 0.43
        axes.text(left + 0.015, level + high, name, va="center", weight="bold")
        at = (left + 0.015, level + 0.24) if name in side else (0.25, level + 0.43)
        axes.text(*at, short[1] if name in side else " → ".join(short), va="center", size=9)
        if name not in side[1:]:
            level += 1.0
    axes.set(xlim=(0, 1), ylim=(-0.05, level))
    axes.axis("off")
    return figure


def main(folder: Path) -> None:
    """Write all of them."""
    for draw in (step, corners, layers):
        figure = draw()
        figure.savefig(folder / f"{draw.__name__}.svg", metadata={"Date": None})
        plt.close(figure)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
