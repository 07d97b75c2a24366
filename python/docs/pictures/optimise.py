"""Makes optimise.webp, beside this file: what examples of optimal control found.

.venv/bin/python python/docs/pictures/optimise.py

Needs matplotlib and Pillow.
"""

from __future__ import annotations

import io
import runpy
from contextlib import redirect_stdout
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[2] / "examples"
BLUE, ORANGE = "#0072b2", "#d55e00"  # the colour-blind can tell them apart


def result_of(example: str) -> dict[str, object]:
    """Run an example, and return its variables."""
    with redirect_stdout(io.StringIO()):
        return runpy.run_path(str(EXAMPLES / f"{example}.py"))


def draw_acrobot(ax: plt.Axes) -> None:
    plan = result_of("swing_up")["plan"]
    for k in range(0, len(plan.q), 2):
        shoulder, elbow = plan.q[k]
        angles = np.cumsum([shoulder, elbow])
        x, z = -np.cumsum(np.sin(angles)), -np.cumsum(np.cos(angles))
        part = k / (len(plan.q) - 1)
        ax.plot([0, *x], [0, *z], color=plt.cm.cividis(1 - part), lw=1 + part)
    ax.set(title="An acrobot swings up", aspect="equal", xlabel="x [m]", ylabel="z [m]")


def draw_bat(ax: plt.Axes) -> None:
    found = result_of("bat_a_ball")
    shot, guess, goal = found["shot"], found["guess"], found["goal"]
    for run, color, name in ((guess, BLUE, "guess"), (shot.run(), ORANGE, "found")):
        x, z = run.column("ball_x"), run.column("ball_z")
        ax.plot(0.6 + x, 1.5 + z, ".-", color=color, label=name, ms=3)
    ax.plot(0.6 + goal["ball_x"], 1.5 + goal["ball_z"], "k+", ms=12, label="target")
    ax.set(title="A bat meets a ball", xlabel="x [m]", ylabel="z [m]")
    ax.legend(frameon=False)


def draw_hopper(ax: plt.Axes) -> None:
    run = result_of("hopper")["gait"].run(2)
    bodies = {link: run.poses(link)[:, [0, 2], 3] for link in ("body", "foot")}
    for link, color in (("body", BLUE), ("foot", ORANGE)):
        ax.plot(*bodies[link].T, color=color, label=link)
    for k in range(0, len(run.t), 6):
        x, z = np.transpose([bodies[link][k] for link in bodies])
        ax.plot(x, z, color="0.7", lw=0.8, zorder=0)
    ax.set(title="A hopper's gait, two strides", xlabel="x [m]", ylabel="z [m]")
    ax.legend(frameon=False)


def draw_misses(ax: plt.Axes) -> None:
    for example, color, name in (
        ("bat_a_ball", ORANGE, "bat [m]"),
        ("drive_a_cradle", BLUE, "cradle [m/s]"),
    ):
        ax.semilogy(result_of(example)["shot"].misses, "o-", color=color, label=name)
    ax.set(title="Newton's method through impacts", xlabel="iterations", ylabel="miss")
    ax.legend(frameon=False)


def draw_way(ax: plt.Axes) -> None:
    found = result_of("off_a_wall")["found"]
    ax.plot(found.t, found.q[:, 0], ".-", color=BLUE, ms=4)
    ax.axhline(1.0, color="0.5", lw=0.8)
    ax.text(0.0, 0.96, "wall", va="top", color="0.4")
    ax.set(title="A cart is driven off a wall", xlabel="t [s]", ylabel="x [m]")


def draw_force(ax: plt.Axes) -> None:
    found = result_of("off_a_wall")["found"]
    ax.step(found.t, [*found.control[:, 0], found.control[-1, 0]], where="post", color=ORANGE)
    ax.set(title="Its force, of least effort", xlabel="t [s]", ylabel="force [N]")


def main() -> None:
    figure, axes = plt.subplots(2, 3, figsize=(12, 7.5), layout="constrained")
    draws = (draw_acrobot, draw_bat, draw_misses, draw_hopper, draw_way, draw_force)
    for draw, ax in zip(draws, axes.flat, strict=True):
        draw(ax)
        ax.spines[["top", "right"]].set_visible(False)
    page = io.BytesIO()
    figure.savefig(page, dpi=90)
    Image.open(page).convert("RGB").save(HERE / "optimise.webp", quality=80, method=6)


if __name__ == "__main__":
    main()
