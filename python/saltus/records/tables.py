"""The arrays of a run: which there are, their columns, and the names of these."""

from __future__ import annotations

import operator
import re
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from saltus._core import Model, ModelError

Array = npt.NDArray[np.float64]

ARRAYS = ("t", "q", "v", "p", "kinetic", "potential", "total", "shadow")
NUMBERS = ("iterations", "residual", "complete", "energy_error")

IMPACT = np.dtype(
    {
        "names": ["t", "first", "count", "contacts", "law", "fallback"],
        "formats": ["f8", "i8", "i8", "i4", "u1", "?"],
    }
)
SETTLING = np.dtype([("t", "f8"), ("pair", "i4")])
FALLBACK = np.dtype([("t", "f8"), ("tau", "f8"), ("rung", "U16"), ("energy", "f8"), ("pair", "i4")])
RUNGS = ("halved", "unlocated", "stopped")  # names of C++'s Rung, in order
ACTED: list[Any] = [
    ("pair", "i4"),
    ("lambda", "f8"),
    ("tangential", "f8", (3,)),
    ("point", "f8", (3,)),
    ("normal", "f8", (3,)),
]
IMPULSE = np.dtype([("impact", "i8"), *ACTED])
CONTACT = np.dtype([("row", "i8"), ("t", "f8"), ("impact", "i8"), *ACTED])

SOURCES = ("damping", "friction", "applied")  # of work, besides actuators

MOST_NUMBERS, FIRST_NUMBERS = 12, 6  # that a repr shows of an array, and of a longer one

LISTED_PAIRS = 100_000
"""Models with more pairs have no list of their names in a trajectory."""


def numbers(name: str, x: npt.ArrayLike | None) -> Array:
    """Return an array of numbers; raise ModelError, which names it, where it is none."""
    try:
        return np.asarray(x, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ModelError(f"{name} is no array of numbers: {error}") from None


def as_array(x: npt.ArrayLike | None, name: str, dimensions: int) -> Array:
    """Return an array of so many dimensions; raise ModelError, which names it, where it is none."""
    array = numbers(name, x)
    if array.ndim != dimensions:
        shape = "(rows,)" if dimensions == 1 else "(rows, n)"
        raise ModelError(f"{name} has shape {array.shape}; it must have shape {shape}")
    return array


def counted(number: int, noun: str) -> str:
    """Return "1 row", "2 rows", "2 velocities"."""
    if number == 1:
        return f"{number} {noun}"
    return f"{number} {noun[:-1]}ies" if noun.endswith("y") else f"{number} {noun}s"


def without_tails(text: str) -> str:
    """Return a text whose long lists of numbers in brackets lack all but their first ones."""

    def cut(match: re.Match[str]) -> str:
        items = match[1].split(", ")
        if len(items) <= MOST_NUMBERS:
            return match[0]
        return f"[{', '.join(items[:FIRST_NUMBERS])}, ... {len(items) - FIRST_NUMBERS} more]"

    return re.sub(r"\[([^\[\]]*)\]", cut, text)


def row_of(index: object, count: int, what: str) -> int:
    """Return an index as a row of `count`; negative ones count from the end.

    Raises TypeError where it is no whole number, IndexError where there is no such row.
    """
    try:
        row = operator.index(index)  # type: ignore[arg-type]  # that is the question
    except TypeError:
        raise TypeError(f"{what} = {index!r} is no whole number") from None
    if not -count <= row < count:
        raise IndexError(f"no {what} {row}; the run has {counted(count, what)}")
    return row


def names_of_pairs(model: Model, *events: npt.NDArray[np.void]) -> tuple[str, ...]:
    """Name the pairs that `events["pair"]` refer to, counting anew where they are too many."""
    if model.n_pairs <= LISTED_PAIRS:
        return (*model.pair_names, *model.limit_names)
    numbers = np.unique(np.concatenate([event["pair"] for event in events]))
    numbers = numbers[numbers >= 0]
    for event in events:
        named = event["pair"] >= 0
        event["pair"][named] = np.searchsorted(numbers, event["pair"][named])
    return tuple(model.pair_name(int(number)) for number in numbers)


def index_of(
    name: str, of: str, coordinate_names: Sequence[str], velocity_names: Sequence[str]
) -> int:
    """Return the column of q, v or p (`of`) that has a name.

    Raises ModelError where there is no such array, or none of its columns has the name.
    """
    if of not in ("q", "v", "p"):
        raise ModelError(f'no array "{of}" of coordinates; there are q, v, p')
    kind, names, others = "coordinate", coordinate_names, velocity_names
    if of != "q":
        kind, names, others = "velocity", velocity_names, coordinate_names
    if name in names:
        return list(names).index(name)
    hint = ""
    if name in others:
        hint = f' ("{name}" is a column of {"v and p" if of == "q" else "q"})'
    raise ModelError(f'no {kind} "{name}"{hint}; there are {", ".join(names)}')
