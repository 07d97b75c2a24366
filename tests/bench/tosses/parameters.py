"""What is fitted: numbers with bounds, those of the cube and the table among them."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log

import numpy as np

from tests.bench.tosses.data import INERTIA


@dataclass(frozen=True)
class Parameter:
    """A number to fit. `logarithmic` ones are searched by their logarithms."""

    name: str
    unit: str
    first: float  # where the search starts
    low: float
    high: float
    logarithmic: bool = False

    def value(self, x: float) -> float:
        """Return the value at x in [0, 1]."""
        if self.logarithmic:
            return exp(log(self.low) + x * (log(self.high) - log(self.low)))
        return self.low + x * (self.high - self.low)

    def place(self, value: float) -> float:
        """Return where in [0, 1] a value is."""
        if self.logarithmic:
            return (log(value) - log(self.low)) / (log(self.high) - log(self.low))
        return (value - self.low) / (self.high - self.low)


FRICTION = Parameter("friction", "", 0.18, 0.05, 0.5)
RESTITUTION = Parameter("restitution", "", 0.125, 0.0, 0.5)
CUBE = (Parameter("inertia", "kg m^2", INERTIA, 0.0006, 0.0015),)  # about every axis
TABLE = (
    Parameter("tilt_x", "rad", 0.0, -0.02, 0.02),  # the table rises by this towards +x
    Parameter("tilt_y", "rad", 0.0, -0.02, 0.02),
    Parameter("height", "m", 0.0, -0.004, 0.004),  # below the origin
)


@dataclass(frozen=True)
class Table:
    """The plane normal . x = offset."""

    normal: np.ndarray  # (3,) unit, up
    offset: float  # [m]


def table(values: dict[str, float]) -> Table:
    """Return the table of the values named in TABLE."""
    up = np.array([-values["tilt_x"], -values["tilt_y"], 1.0])
    up /= np.linalg.norm(up)
    return Table(up, values["height"] * up[2])


def frame(table: Table) -> np.ndarray:
    """Return a rotation (3, 3) whose third column is the table's normal."""
    x = np.cross((0.0, 1.0, 0.0), table.normal)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(table.normal, x), table.normal])
