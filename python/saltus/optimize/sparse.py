"""Sparse matrices as lists of entries, which any solver takes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from saltus.optimize.system import Array

Indices = npt.NDArray[np.intp]


class Triplets(NamedTuple):
    """The entries of a sparse matrix; those of one place add up."""

    rows: Indices
    columns: Indices
    values: Array


class Blocks:
    """A sparse matrix that is made of blocks."""

    def __init__(self) -> None:
        self.parts: list[tuple[Indices, Indices, Array]] = []

    def add(self, row: int, columns: Indices, block: Array) -> None:
        """Add a block that begins in a row."""
        rows = np.repeat(np.arange(row, row + len(block)), len(columns))
        self.parts.append((rows, np.tile(columns, len(block)), np.ravel(block)))

    def add_square(self, columns: Indices, block: Array) -> None:
        """Add a block whose rows are its columns."""
        rows = np.repeat(columns, len(columns))
        self.parts.append((rows, np.tile(columns, len(columns)), np.ravel(block)))

    def triplets(self) -> Triplets:
        """Return all entries."""
        if not self.parts:
            return Triplets(np.zeros(0, int), np.zeros(0, int), np.zeros(0))
        return Triplets(*(np.concatenate(part) for part in zip(*self.parts, strict=True)))
