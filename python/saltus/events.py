"""Arrays of what happened between bodies: their columns, and the names of pairs."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from saltus._core import Model

IMPACT = np.dtype(
    {
        "names": ["t", "first", "count", "contacts", "law", "fallback"],
        "formats": ["f8", "i8", "i8", "i4", "u1", "?"],
    }
)
SETTLING = np.dtype([("t", "f8"), ("pair", "i4")])
ACTED: list[Any] = [
    ("pair", "i4"),
    ("lambda", "f8"),
    ("tangential", "f8", (3,)),
    ("point", "f8", (3,)),
    ("normal", "f8", (3,)),
]
IMPULSE = np.dtype([("impact", "i8"), *ACTED])
CONTACT = np.dtype([("row", "i8"), ("t", "f8"), ("impact", "i8"), *ACTED])

LISTED_PAIRS = 100_000
"""Models with more pairs have no list of their names in a trajectory."""


def names_of_pairs(model: Model, *events: npt.NDArray[np.void]) -> tuple[str, ...]:
    """Name the pairs that `events["pair"]` refer to, counting anew where they are too many."""
    if model.n_pairs <= LISTED_PAIRS:
        return tuple(model.pair_names)
    numbers = np.unique(np.concatenate([event["pair"] for event in events]))
    for event in events:
        event["pair"] = np.searchsorted(numbers, event["pair"])
    return tuple(model.pair_name(int(number)) for number in numbers)
