"""An engine's parameters from tosses: a search over each of its settings, the best one to the end.

A toss whose error is e counts e / (e + USUAL), so one that fell on another face counts about as
much as two of usual error, not a hundred; a toss that failed counts 1, the most there is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tests.bench.tosses import measures
from tests.bench.tosses.flight import Calibration
from tests.bench.tosses.processes import Engine
from tests.bench.tosses.search import minimise

USUAL = np.array([0.1, 9.0])  # [widths], [deg]: the medians that good simulators reach


@dataclass(frozen=True)
class Fit:
    """What was found."""

    setting: str
    values: dict[str, float]
    score: float  # in [0, 1], 0 is best
    evaluations: int


def score(errors: Sequence) -> float:
    """Return the mean of what tosses count, in [0, 1]; errors are pairs, or texts of failures."""
    return float(np.mean([1.0 if isinstance(error, str) else count(error) for error in errors]))


def count(error: Sequence[float]) -> float:
    """Return what a toss of this error (position, angle) counts."""
    pair = np.asarray(error)
    return float(np.mean(pair / (pair + USUAL)))


def fit(
    engine: Engine,
    tosses: Sequence[int],
    calibration: Calibration,
    budget: int,
    seed: int,
    fixed: dict[str, float],
    progress: Callable[[float], None] = lambda least: None,
) -> Fit:
    """Fit an engine with `budget` evaluations: half for its settings alike, half for the best one.

    The values of `fixed` are not searched.
    """
    settings = engine.settings
    if budget < 2 * len(settings):
        raise ValueError(f"budget = {budget}; {engine.name} needs at least {2 * len(settings)}")
    least, free = 1.0, [p for p in engine.parameters if p.name not in fixed]

    def at(x: np.ndarray) -> dict[str, float]:
        return fixed | {p.name: p.value(float(s)) for p, s in zip(free, x, strict=True)}

    def search(setting: str, first: np.ndarray, evaluations: int, sigma: float):
        def value(x: np.ndarray) -> float:
            nonlocal least
            answer = engine.run(tosses, at(x), setting, calibration)
            found = score(answer["errors"])
            least = min(least, found)
            progress(least)
            return found

        return minimise(value, first, evaluations, seed, sigma)

    first = np.array([p.place(p.first) for p in free])
    share = budget // 2 // len(settings)
    tried = [(setting, *search(setting, first, share, 0.15)) for setting in settings]
    setting, place, _ = min(tried, key=lambda each: each[2])
    rest = budget - share * len(settings)
    place, reached = search(setting, place, rest, 0.1)
    return Fit(setting, at(place), reached, budget)


def summary(errors: Sequence) -> measures.Summary:
    """Summarise an engine's answer, texts being failures."""
    return measures.summary([None if isinstance(e, str) else tuple(e) for e in errors])
