"""From what a user gives for the starts of many runs to states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._core import Model, ModelError, State
from saltus.records.tables import Array, counted, numbers

Starts = Mapping[str, ArrayLike] | ArrayLike | None


class _Space(NamedTuple):
    """What is asked of q or v: names of the columns, and values that are not given."""

    what: str
    kind: str
    names: list[str]
    joints: dict[str, list[int]]  # of several columns
    default: Array


def _spaces(model: Model) -> tuple[_Space, _Space]:
    def several(columns: dict[str, list[int]]) -> dict[str, list[int]]:
        return {name: own for name, own in columns.items() if len(own) > 1}

    q = several({joint.name: joint.coordinates for joint in model.joints})
    v = several({joint.name: joint.velocities for joint in model.joints})
    return (
        _Space("q", "coordinate", model.coordinate_names, q, model.neutral()),
        _Space("v", "velocity", model.velocity_names, v, np.zeros(model.n_v)),
    )


def to_states(model: Model, q: Starts, v: Starts) -> list[State]:
    """Return a state for each run; raise ModelError on what does not fit the model."""
    spaces = _spaces(model)
    arrays = [_to_array(space, x) for space, x in zip(spaces, (q, v), strict=True)]
    rows = {s.what: len(x) for s, x in zip(spaces, arrays, strict=True) if x.ndim == 2}
    if not rows:
        raise ModelError(
            "q and v hold a single start; a batch takes a row a run, shape (runs, n); a single "
            "start is for simulate"
        )
    runs = max(rows.values())
    if min(rows.values()) != runs:
        raise ModelError(f"q has {counted(rows['q'], 'row')} and v has {rows['v']}; a row is a run")
    return _core.states(model, *(np.broadcast_to(x, (runs, x.shape[-1])) for x in arrays))


def to_controls(
    model: Model, control: ArrayLike | Mapping[str, float] | None, runs: int
) -> list[Array]:
    """Return the rows (steps, n_u) of each run; none where nothing is told."""
    if control is None:
        return []
    names = list(model.control_names)
    if callable(control):
        raise TypeError(
            "control is a function; the runs of a batch are on several threads and take arrays, "
            "shape (runs, steps, n_u); simulate takes functions"
        )
    if isinstance(control, Mapping):
        unknown = [name for name in control if name not in names]
        if unknown:
            raise ModelError(f'no actuator "{unknown[0]}"; there are {", ".join(names) or "none"}')
        control = [control.get(name, 0.0) for name in names]
    array = numbers("control", control)
    if not 1 <= array.ndim <= 3 or array.shape[-1] != len(names):
        raise ModelError(
            f"control has shape {array.shape}; it must have shape (n_u,), (runs, n_u) or "
            f"(runs, steps, n_u), a column for each of {', '.join(names) or 'no actuator'}"
        )
    if array.ndim == 3 and array.shape[1] == 0:
        raise ModelError(f"control has shape {array.shape}; it has one row of a step at least")
    if array.ndim > 1 and len(array) != runs:
        raise ModelError(f"control has {counted(len(array), 'row')} for {counted(runs, 'run')}")
    if array.ndim < 3:
        array = np.broadcast_to(array.reshape(-1, 1, len(names)), (runs, 1, len(names)))
    return [np.array(rows) for rows in array]


def _to_array(space: _Space, x: Starts) -> Array:
    """Return the array (B, n) that is meant, (n,) where it is the same for all runs."""
    n = len(space.names)
    if x is None:
        return space.default
    if isinstance(x, Mapping):
        return _from_mapping(space, x)
    array = numbers(space.what, x)
    if array.ndim not in (1, 2) or array.shape[-1] != n:
        raise ModelError(
            f"{space.what} has shape {array.shape}; it must have shape (runs, {n}), a column for "
            f"each of {', '.join(space.names)}"
        )
    return array


def _columns(space: _Space, name: str) -> list[int]:
    if name in space.names:
        return [space.names.index(name)]
    if name in space.joints:
        return space.joints[name]
    known = ", ".join([*space.names, *space.joints])
    raise ModelError(f'no {space.kind} "{name}"; there are {known}')


def _from_mapping(space: _Space, x: Mapping[str, ArrayLike]) -> Array:
    """Fill columns by names: (runs,) or () of one number, (runs, k) or (k,) of a joint of k."""
    own = {name: _columns(space, name) for name in x}
    values = {}
    for name, columns in own.items():
        value = numbers(f'{space.what}["{name}"]', _plain(x[name]))
        if len(columns) == 1 and name in space.names:
            value = value[..., np.newaxis]
        if value.ndim not in (1, 2) or value.shape[-1] != len(columns):
            taken = "(runs,) or ()" if len(columns) == 1 else f"(runs, {len(columns)}) or less"
            shown = np.shape(_plain(x[name]))
            raise ModelError(f'{space.what}["{name}"] has shape {shown}; it must be {taken}')
        values[name] = value
    lengths = {len(value) for value in values.values() if value.ndim == 2}
    if len(lengths) > 1:
        listed = ", ".join(f'"{name}": {np.shape(_plain(x[name]))}' for name in x)
        raise ModelError(f"{space.what} has arrays of shapes {{{listed}}}; all must have the runs")
    out = np.empty((*lengths, len(space.names)))
    out[...] = space.default
    for name, value in values.items():
        out[..., own[name]] = value
    return out


def _plain(x: Any) -> Any:
    """Return the quaternions x y z w of a SciPy Rotation; other values as they are."""
    return x.as_quat() if hasattr(x, "as_quat") else x
