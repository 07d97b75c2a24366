"""How near to the recording an engine could come.

What the errors of the starts do to an engine's own motion, and whether engines differ less from
each other than from the recording.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import combinations

import numpy as np

from tests.bench.tosses import measures
from tests.bench.tosses.fit import Fit
from tests.bench.tosses.flight import Calibration, Noise
from tests.bench.tosses.processes import Engine


def poses(
    engine: Engine, tosses: Sequence[int], fit: Fit, calibration: Calibration, **more
) -> list:
    """Return an engine's motions, poses (rows, 4, 4) or None where it failed."""
    answer = engine.run(tosses, fit.values, fit.setting, calibration, poses=True, **more)
    return [None if found is None else whole(np.array(found)) for found in answer["poses"]]


def whole(rows: np.ndarray) -> np.ndarray:
    """Return homogeneous matrices (n, 4, 4) of their first three rows (n, 3, 4)."""
    last = np.broadcast_to((0.0, 0.0, 0.0, 1.0), (len(rows), 1, 4))
    return np.concatenate([rows, last], axis=1)


def between(some: Sequence, others: Sequence) -> list[tuple[float, float] | None]:
    """Return the errors of some motions, others taken for the recorded ones."""
    return [
        None if a is None or b is None else measures.toss_errors(a, b)
        for a, b in zip(some, others, strict=True)
    ]


def noise(
    engine: Engine, tosses: Sequence[int], fit: Fit, calibration: Calibration, of_start: Noise
) -> list:
    """Return what the start's noise changes in an engine's own motions: errors of each toss."""
    clean = poses(engine, tosses, fit, calibration)
    return between(poses(engine, tosses, fit, calibration, noise=asdict(of_start)), clean)


def pairs(
    engines: Sequence[Engine], tosses: Sequence[int], fits: Sequence[Fit], calibration: Calibration
) -> list[dict]:
    """Return summaries of the differences between the motions of every two engines."""
    motions = [poses(e, tosses, f, calibration) for e, f in zip(engines, fits, strict=True)]
    return [
        {"engines": [engines[i].name, engines[k].name]}
        | measures.summary(between(motions[i], motions[k])).json()
        for i, k in combinations(range(len(engines)), 2)
    ]
