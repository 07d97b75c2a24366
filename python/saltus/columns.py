"""Columns of recorded arrays by their names."""

from __future__ import annotations

from collections.abc import Sequence

from saltus._core import ModelError


def check_array(of: str) -> str:
    """Return the name of an array of columns; raise ModelError on another."""
    if of not in ("q", "v", "p"):
        raise ModelError(f'no array "{of}" of coordinates; there are q, v, p')
    return of


def index_of(
    name: str, of: str, coordinate_names: Sequence[str], velocity_names: Sequence[str]
) -> int:
    """Return the column of q, v or p that has a name; raise ModelError where none has it."""
    kind, names, others = "coordinate", coordinate_names, velocity_names
    if of != "q":
        kind, names, others = "velocity", velocity_names, coordinate_names
    if name in names:
        return list(names).index(name)
    hint = ""
    if name in others:
        hint = f' ("{name}" is a column of {"v and p" if of == "q" else "q"})'
    raise ModelError(f'no {kind} "{name}"{hint}; there are {", ".join(names)}')
