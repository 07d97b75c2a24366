"""Heaps of bodies: does every run end and come to rest, by which arcs, and in what time.

    python -m tests.bench.piles                      # all of them
    python -m tests.bench.piles --scene dominoes --seconds 1

The table has seconds of CPU per simulated second, the rungs of steps (`fallbacks`), how fast the
bodies are at the end, the largest rise of the energy and the deepest overlap. Ctrl-C ends early.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections import Counter
from collections.abc import Callable
from contextlib import suppress

import numpy as np

import saltus
from tests.bench.table import grid

H = 0.005
Scene = tuple[saltus.Model, saltus.State]


def on_floor(restitution: float, friction: float) -> saltus.ModelBuilder:
    builder = saltus.ModelBuilder().add_floor()
    return builder.set_default_contact(restitution=restitution, friction=friction)


def at(model: saltus.Model, v: dict[str, object] | None = None) -> Scene:
    return model, model.state(v=v or {})


def dice_in_a_cup(count: int = 20) -> Scene:
    """Drop dice of 16 mm into a cup of eight walls."""
    rng = np.random.default_rng(1)
    builder = on_floor(0.3, 0.4)
    for k in range(8):
        angle = 2 * np.pi * k / 8
        builder.add_half_space(f"wall_{k}", (np.cos(angle), np.sin(angle), 0), -0.04)
    for i in range(count):
        q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        place = [*rng.uniform(-0.015, 0.015, 2), 0.03 + 0.03 * i]
        X = saltus.Pose(place, q if np.linalg.det(q) > 0 else -q)
        builder.add_body(f"die_{i}", saltus.Box((0.008,) * 3), mass=0.004, X=X)
    return at(builder.build())


def balls_in_a_bin(count: int = 20) -> Scene:
    rng = np.random.default_rng(2)
    builder = on_floor(0.5, 0.3)
    for k, normal in enumerate([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)]):
        builder.add_half_space(f"wall_{k}", normal, -0.15)
    for i in range(count):
        X = saltus.Pose((*rng.uniform(-0.1, 0.1, 2), 0.06 + 0.11 * i))
        builder.add_body(f"ball_{i}", saltus.Sphere(0.05), mass=0.1, X=X)
    return at(builder.build())


def dominoes(count: int = 10) -> Scene:
    """Push the first of a row over."""
    builder = on_floor(0, 0.3)
    for i in range(count):
        X = saltus.Pose((0.03 * i, 0, 0.025))
        builder.add_body(f"domino_{i}", saltus.Box((0.004, 0.0125, 0.025)), mass=0.01, X=X,
                         joint_name=f"free_{i}")  # fmt: skip
    return at(builder.build(), {"free_0_wy": 3.0})


def wall_that_is_hit(rows: int = 6, columns: int = 5) -> Scene:
    """Throw a ball at a wall of bricks at 5 m/s."""
    builder = on_floor(0, 0.6)
    for row in range(rows):
        for column in range(columns):
            place = (0, 0.2 * column + 0.1 * (row % 2), 0.05 + 0.1 * row)
            brick = saltus.Box((0.05, 0.1, 0.05))
            builder.add_body(f"brick_{row}_{column}", brick, mass=2, X=saltus.Pose(place))
    X = saltus.Pose((0.5, 0.45, 0.35))
    builder.add_body("ball", saltus.Sphere(0.08), mass=3, X=X, joint_name="ball")
    return at(builder.build(), {"ball_vx": -5.0})


def tower_that_is_hit(count: int = 10) -> Scene:
    """Hit the middle of a tower at 2 m/s."""
    builder = on_floor(0, 0.5)
    for i in range(count):
        X = saltus.Pose((0, 0, 0.05 + 0.1 * i))
        builder.add_body(f"box_{i}", saltus.Box((0.05,) * 3), mass=1, X=X)
    X = saltus.Pose((0.4, 0, 0.45))
    builder.add_body("ball", saltus.Sphere(0.05), mass=1, X=X, joint_name="ball")
    return at(builder.build(), {"ball_vx": -2.0})


SCENES: dict[str, Callable[[], Scene]] = {
    "dice": dice_in_a_cup,
    "balls": balls_in_a_bin,
    "dominoes": dominoes,
    "wall": wall_that_is_hit,
    "tower": tower_that_is_hit,
}


def lowest_gap(model: saltus.Model, q: np.ndarray) -> float:
    """Return the least gap [m] of whole shapes: partials of all parts may take gigabytes."""
    shapes = model.shapes
    poses = [model.shape_poses(q[None], k)[0] for k in range(len(shapes))]
    placed = [
        (each, saltus.Pose(X[:3, 3], X[:3, :3])) for each, X in zip(shapes, poses, strict=True)
    ]
    least = np.inf
    for i, (a, X_WA) in enumerate(placed):
        for b, X_WB in placed[:i]:
            if a.link == b.link or not saltus.has_gap(a.shape, b.shape):
                continue
            least = min(least, saltus.gap(a.shape, X_WA, b.shape, X_WB).phi)
    return float(least)


def row_of(name: str, seconds: float) -> list[str]:
    """Run one scene and return its row of the table."""
    model, state = SCENES[name]()
    start, error = time.process_time(), ""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", saltus.StepWarning)
        try:
            run = saltus.simulate(model, state=state, duration=seconds, h=H)
        except saltus.StepError as failed:
            run, error = failed.trajectory, str(failed).split(";")[0]
    spent = time.process_time() - start
    steps = {rung: set() for rung in ("halved", "unlocated", "stopped")}
    for fallback in run.fallbacks:
        steps[str(fallback["rung"])].add(int(fallback["t"] / H + 1e-6))
    rungs = Counter({rung: len(found) for rung, found in steps.items() if found})
    rise = (run.total - np.minimum.accumulate(run.total)).max() / run.kinetic.max()
    deepest = min(lowest_gap(model, q) for q in run.q[::20])
    return [
        name,
        error or f"{run.t[-1]:g} s",
        f"{spent / max(run.t[-1], H):.2f}",
        str(len(run) - 1),
        ", ".join(f"{count} {rung}" for rung, count in rungs.items()) or "none",
        f"{np.abs(run.v[-1]).max():.1e}",
        f"{rise:.1e}",
        f"{deepest:.1e}",
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scene", choices=SCENES, help="this one alone")
    parser.add_argument("--seconds", type=float, default=3.0, help="[s] of each")
    args = parser.parse_args()
    head = ["scene", "ends at", "CPU s per s", "steps", "not one arc", "speed", "rise", "deepest"]
    rows: list[list[str]] = []
    with suppress(KeyboardInterrupt):  # then of the scenes before
        rows.extend(row_of(name, args.seconds) for name in ([args.scene] if args.scene else SCENES))
    print(grid(head, rows))


if __name__ == "__main__":
    main()
