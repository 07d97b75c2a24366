"""Pairs of shapes of a run: which met, their names, their gaps over time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from saltus._core import Model, ModelError, Pose, gap, has_gap
from saltus.records.recording import Recording
from saltus.records.tables import Array

MOST_LISTED = 480  # models with more pairs: only those that met are chosen

ShapePair = tuple[int, int]  # numbers in `model.shapes`


def pair_name(model: Model, pair: ShapePair) -> str:
    """Return the name of a pair of shapes."""
    return " ~ ".join(model.shapes[i].name for i in pair)


def named_pairs(model: Model, names: Sequence[str]) -> list[ShapePair]:
    """Return pairs of shapes by their names "a ~ b"; raise ModelError on others."""
    index = {placed.name: i for i, placed in enumerate(model.shapes)}
    found = []
    for name in names:
        a, _, b = name.partition(" ~ ")
        if a not in index or b not in index or a == b:
            raise ModelError(
                f'no pair "{name}"; it is named "a ~ b" after two of the shapes '
                f"{', '.join(index) or '(there are none)'}"
            )
        if not has_gap(model.shapes[index[a]].shape, model.shapes[index[b]].shape):
            raise ModelError(f'pair "{name}": no gap function is known for these two shapes')
        found.append((index[a], index[b]))
    return found


def shape_names(pair: str) -> frozenset[str]:
    """Return the names of a pair's shapes; parts ("box[+++] ~ floor") count as their shapes."""
    return frozenset(end.split("[")[0] for end in pair.split(" ~ "))


def shapes_of_pairs(run: Recording, model: Model) -> dict[int, ShapePair]:
    """Return the shapes of each numbered pair that took an impulse, the most frequent first.

    Parts of shapes ("box[+++] ~ floor") count as their shapes; limits of joints have none.
    """
    numbers = Counter(run.impulses["pair"].tolist())
    if run.recorded_contacts is not None:
        numbers.update(run.recorded_contacts["pair"].tolist())
    index = {placed.name: i for i, placed in enumerate(model.shapes)}
    found: dict[int, ShapePair] = {}
    as_first: dict[frozenset[int], ShapePair] = {}  # corners of either box: the same pair
    for number, _ in numbers.most_common():
        ends = [end.split("[")[0] for end in run.pair_names[number].split(" ~ ")]
        if len(ends) == 2 and ends[0] in index and ends[1] in index:
            pair = (index[ends[0]], index[ends[1]])
            found[number] = as_first.setdefault(frozenset(pair), pair)
    return found


def pairs_of_run(run: Recording, model: Model) -> list[ShapePair]:
    """Return pairs of shapes: those that met, the most frequent first, then others if few."""
    pairs = {frozenset(pair): pair for pair in shapes_of_pairs(run, model).values()}
    for pair in pairs_of_model(model):
        pairs.setdefault(frozenset(pair), pair)
    shapes = [placed.shape for placed in model.shapes]
    return [(a, b) for a, b in pairs.values() if has_gap(shapes[a], shapes[b])]


def pairs_of_model(model: Model) -> list[ShapePair]:
    """Return the pairs of shapes that a model watches and that have a gap, if they are few."""
    if model.n_pairs > MOST_LISTED:
        return []
    shapes = [placed.shape for placed in model.shapes]
    pairs = {frozenset((each.a, each.b)): (each.a, each.b) for each in model.pairs}
    return [(a, b) for a, b in pairs.values() if has_gap(shapes[a], shapes[b])]


def gaps_over(model: Model, q: Array, pairs: Sequence[ShapePair]) -> Array:
    """Return the gaps [m] of pairs of shapes in configurations (rows, n_q), (rows, pairs)."""
    placed = model.shapes
    poses = {i: _poses(model, q, i) for i in sorted({i for pair in pairs for i in pair})}
    values = np.empty((len(q), len(pairs)))
    for column, (a, b) in enumerate(pairs):
        one, other = placed[a].shape, placed[b].shape
        for row in range(len(values)):
            values[row, column] = gap(one, poses[a][row], other, poses[b][row]).phi
    return values


def _poses(model: Model, q: Array, shape: int) -> list[Pose]:
    return [Pose(X[:3, 3], X[:3, :3]) for X in model.shape_poses(q, shape)]
