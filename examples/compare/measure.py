"""What is measured of a run: the same for every engine, from coordinates and velocities alone."""

from __future__ import annotations

from math import pi, sin, sqrt

import numpy as np

from compare.scene import GRAVITY, LENGTH, Rows, Scene

SETTLED = 0.05  # [s] after the first impact, when contacts that are springs have let go
LATE = 1.0  # [s] at the end of a run over which its energy is looked at


def measures(scene: Scene, rows: Rows) -> dict:
    """Return "exits", "energy" and, for cradles and breaks, "resting" or "mirror"."""
    kinds = {"cradle": _cradle, "line": _line, "break": _break}
    return kinds[scene.kind](scene, rows)


def swing_time(scene: Scene) -> float:
    """Return when the first ball of a cradle comes to its lowest point [s]."""
    inertia = scene.inertias[0] + scene.masses[0] * LENGTH**2
    small = sqrt(inertia / (scene.masses[0] * GRAVITY * LENGTH))
    a, b = 1.0, sqrt(1 - sin(max(scene.q) / 2) ** 2)
    for _ in range(6):
        a, b = (a + b) / 2, sqrt(a * b)
    return small * pi / (2 * a)


def _cradle(scene: Scene, rows: Rows) -> dict:
    """Velocities are those that each ball has, or would have, at its lowest point."""
    at = int(np.searchsorted(rows.t, swing_time(scene) + SETTLED))
    inertia = scene.inertias[0] + scene.masses[0] * LENGTH**2
    height = scene.masses[0] * GRAVITY * LENGTH * (1 - np.cos(rows.q))
    energies = 0.5 * inertia * rows.v**2 + height
    came = sqrt(2 * energies[0].max() / inertia)
    # Positive is the way that the first ball came.
    exits = -np.sign(rows.v[at]) * np.sqrt(2 * energies[at] / inertia) / came
    total = energies.sum(axis=1)
    late = total[rows.t >= rows.t[-1] - LATE]  # contacts that are springs hold some for a moment
    return {
        "exits": exits.tolist(),
        "energy": float(np.median(late) / total[0] - 1),
        "resting": float(np.abs(rows.q[:, len(scene.masses) // 2]).max()),
    }


def _line(scene: Scene, rows: Rows) -> dict:
    return {"exits": rows.v[-1].tolist(), "energy": _kinetic(scene, rows, 1)}


def _break(scene: Scene, rows: Rows) -> dict:
    """Compare the velocity of each ball with the mirrored one of the ball that lay opposite."""
    v = rows.v[-1].reshape(-1, 2)
    places = np.array(scene.places)
    image = [int(np.argmin(np.linalg.norm(places - (x, -y), axis=1))) for x, y in scene.places]
    mirror = np.linalg.norm(v - v[image] * (1, -1), axis=1).max()
    came = np.linalg.norm(scene.v)
    return {
        "exits": [float(np.linalg.norm(ball) / came) for ball in v],
        "ways": (v / came).tolist(),
        "energy": _kinetic(scene, rows, 2),
        "mirror": float(mirror / came),
    }


def _kinetic(scene: Scene, rows: Rows, axes: int) -> float:
    """Return how much kinetic energy was won at the end, as a part of that at the start."""
    weights = np.repeat(scene.masses, axes)
    return float((weights * rows.v[-1] ** 2).sum() / (weights * rows.v[0] ** 2).sum() - 1)
