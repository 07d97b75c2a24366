"""The scenes of the bench of contacts: boxes and balls on a floor, in heaps, among pegs."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

Vector = tuple[float, ...]


@dataclass(frozen=True)
class Body:
    """A ball (one size, its radius) or a box (three, its half lengths) of uniform density."""

    size: Vector
    place: Vector
    mass: float = 1.0
    velocity: Vector = (0.0, 0.0, 0.0)
    turn: Vector = (0.0, 0.0, 0.0, 1.0)  # quaternion, w last

    @property
    def is_ball(self) -> bool:
        return len(self.size) == 1


@dataclass(frozen=True)
class Scene:
    """Bodies on a floor, and between walls (normal, offset)."""

    name: str
    bodies: list[Body]
    seconds: float  # that are timed
    before: float = 0.0  # untimed
    restitution: float = 0.0
    friction: float = 0.5
    walls: list[tuple[Vector, float]] = field(default_factory=list)
    pegs: list[Body] = field(default_factory=list)  # balls that do not move
    rests: bool = False  # nothing should move


def rows_of_boxes(count: int) -> list[Body]:
    side = round(count**0.5)
    return [Body((0.1,) * 3, (0.5 * (i % side), 0.5 * (i // side), 0.1)) for i in range(count)]


def tower(count: int) -> list[Body]:
    half = (0.2, 0.15, 0.1)
    return [Body(half, (0, 0, 0.1 * (2 * i + 1))) for i in range(count)]


def pyramid(rows: int) -> list[Body]:
    half = (0.1, 0.1, 0.05)
    return [
        Body(half, (0.21 * (i - (rows - row - 1) / 2), 0, 0.05 + 0.1 * row))
        for row in range(rows)
        for i in range(rows - row)
    ]


def heap(side: int) -> list[Body]:
    """Balls on a lattice, a little beside their places, that fall on one another."""
    rng = np.random.default_rng(side)
    at = np.array(np.meshgrid(*[range(side)] * 3)).reshape(3, -1).T
    places = 0.105 * at + rng.uniform(-0.002, 0.002, at.shape) + (0, 0, 0.1)
    return [Body((0.05,), tuple(place)) for place in places]


def galton(count: int) -> Scene:
    """Balls between two plates that fall from peg to peg, five in a row."""
    rng = np.random.default_rng(count)
    pegs = [
        Body((0.02,), (0.1 * i + 0.05 * (row % 2), 0.0, 0.1 + 0.09 * row))
        for row in range(8)
        for i in range(-6, 7)
    ]
    balls = [
        Body((0.02,), (0.1 * (k % 5 - 2) + rng.uniform(-0.02, 0.02), 0.0, 0.9 + 0.06 * (k // 5)))
        for k in range(count)
    ]
    plates = [((0, 1, 0), -0.021), ((0, -1, 0), -0.021)]
    return Scene(f"galton {count}", balls, 0.4, 0.1, 0.5, 0.3, plates, pegs)


def rolling_ball() -> Body:
    """Beside a tower, so that what stands still is one of two that a step is made for."""
    return Body((0.1,), (2, 0, 0.1), velocity=(1.0, 0.0, 0.0))


def box_walls(half: float) -> list[tuple[Vector, float]]:
    return [(normal, -half) for normal in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]


def scenes() -> list[Scene]:
    """Return the scenes, in the order of the table."""
    out = [Scene(f"boxes {n}", rows_of_boxes(n), 0.2, 0.05, rests=True) for n in (16, 64, 256)]
    out += [Scene(f"tower {n}", tower(n), 0.1, rests=True) for n in (5, 10, 20)]
    out += [Scene("tower 10 at rest", tower(10), 0.5, 0.5, rests=True)]
    out += [Scene(f"pyramid {n * (n + 1) // 2}", pyramid(n), 0.1, rests=True) for n in (4, 6)]
    out += [Scene("tower 10 at rest, a ball rolls", [*tower(10), rolling_ball()], 0.5, 0.5)]
    out += [Scene("pyramid 21 at rest", pyramid(6), 0.2, 0.3, rests=True)]
    out += [Scene("sliding boxes 16", [
        Body(b.size, b.place, velocity=(1.0, 0.3, 0.0)) for b in rows_of_boxes(16)
    ], 0.2)]  # fmt: skip
    out += [
        Scene(f"heap {n**3}", heap(n), 0.6, restitution=0.3, friction=0.3,
              walls=box_walls(0.11 * n))
        for n in (2, 3)
    ]  # fmt: skip
    return [*out, galton(5), galton(50)]
