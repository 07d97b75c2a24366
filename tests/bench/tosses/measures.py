"""How far a simulated toss is from the recorded one, and how to speak of many of them."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from tests.bench.tosses.data import EDGE


def row_errors(found: np.ndarray, recorded: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return distances of the centres [widths] and angles of the axes [deg] of poses (n, 4, 4)."""
    if found.shape != recorded.shape:
        raise ValueError(f"poses have shape {found.shape}; the recorded ones {recorded.shape}")
    distances = np.linalg.norm(found[:, :3, 3] - recorded[:, :3, 3], axis=1) / EDGE
    # |R - S| = sqrt(8) sin(angle / 2): exact for small angles, where the trace is not.
    differences = np.linalg.norm(found[:, :3, :3] - recorded[:, :3, :3], axis=(1, 2))
    angles = 2 * np.arcsin(np.minimum(differences / np.sqrt(8), 1))
    return distances, np.degrees(angles)


def toss_errors(found: np.ndarray, recorded: np.ndarray) -> tuple[float, float]:
    """Return the means over the rows of `row_errors`."""
    distances, angles = row_errors(found, recorded)
    return float(distances.mean()), float(angles.mean())


@dataclass(frozen=True)
class Summary:
    """Errors over many tosses; a toss that failed is infinitely far off, but in no mean."""

    tosses: int
    failed: int
    position_mean: float  # [widths]
    position_median: float
    angle_mean: float  # [deg]
    angle_median: float

    def json(self) -> dict:
        return asdict(self)


def summary(errors: list[tuple[float, float] | None]) -> Summary:
    """Summarise the errors of tosses, None where one failed."""
    ran = np.array([error for error in errors if error is not None]).reshape(-1, 2)
    failed = len(errors) - len(ran)
    every = np.vstack([ran, np.full((failed, 2), np.inf)])
    means = ran.mean(axis=0) if len(ran) else (np.nan, np.nan)
    medians = np.median(every, axis=0) if len(every) else (np.nan, np.nan)
    return Summary(len(errors), failed, *map(float, (means[0], medians[0], means[1], medians[1])))
