"""What a scene is, and what a run of it leaves: no engine is imported here."""

from __future__ import annotations

import dataclasses
import json
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np

GRAVITY = 9.81  # [m/s^2]
LENGTH = 1.0  # [m] of a pendulum, from its pivot to the centre of its ball


@dataclass(frozen=True)
class Scene:
    """Balls that hang on plane pendulums, slide along x, or slide on a table.

    Coordinates are those of the URDF text: the angle of each pendulum [rad], positive towards -x;
    x of each ball [m]; or x and y of each ball in turn [m], all 0 at `places`.
    """

    name: str
    kind: Literal["cradle", "line", "break"]
    urdf: str
    radius: float  # [m]
    masses: list[float]  # [kg]
    places: list[tuple[float, float]]  # [m] x and y of the centres where coordinates are 0
    q: list[float]  # at the start
    v: list[float]
    duration: float  # [s]
    gap: float = 0.0  # [m] between neighbours at rest
    look: float = 0.01  # [s] between recorded rows

    def json(self) -> str:
        return json.dumps(dataclasses.asdict(self))

    @property
    def gravity(self) -> float:
        return GRAVITY if self.kind == "cradle" else 0.0

    @property
    def inertias(self) -> list[float]:
        """Moments of inertia of solid spheres about their centres [kg m^2]."""
        return [0.4 * mass * self.radius**2 for mass in self.masses]


@dataclass(frozen=True)
class Rows:
    """Coordinates and velocities at the looks, the start first, each of shape (looks + 1, n)."""

    t: np.ndarray
    q: np.ndarray
    v: np.ndarray


class Simulation(Protocol):
    """One scene in one engine, at its start."""

    step: float  # [s]

    def advance(self, steps: int) -> None:
        """Make steps, with as few calls as the engine has for it."""

    def coordinates(self) -> tuple[np.ndarray, np.ndarray]:
        """Return coordinates and velocities as the scene counts them."""


def record(simulation: Simulation, scene: Scene) -> Rows:
    """Run a scene to its end and look at it now and then."""
    looks = round(scene.duration / scene.look)
    steps = round(scene.look / simulation.step)
    rows = [simulation.coordinates()]
    for _ in range(looks):
        simulation.advance(steps)
        rows.append(simulation.coordinates())
    q, v = (np.array(column, dtype=float) for column in zip(*rows, strict=True))
    return Rows(scene.look * np.arange(looks + 1), q, v)
