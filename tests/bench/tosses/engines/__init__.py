"""A module for each engine; what it has is in `Engine`.

Where steps are semi-implicit (v first, then x with the new v), v belongs to the middle of the step
before: such engines start with g h / 2 more velocity than the cube has at its first row.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from tests.bench.tosses.flight import Start
from tests.bench.tosses.parameters import Parameter


class Engine(Protocol):
    """What a module of an engine has."""

    NAME: str
    VERSION: str
    SETTINGS: tuple[str, ...]  # what is not a number: solvers, steps; the first is the usual one
    PARAMETERS: tuple[Parameter, ...]  # CUBE and TABLE are among them

    def simulate(self, start: Start, values: dict[str, float], setting: str) -> np.ndarray:
        """Return the cube's poses (rows, 4, 4) at the rows; raise where a step fails."""
