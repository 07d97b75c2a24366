"""A search without derivatives: the covariance matrix adaptation of Hansen and Ostermeier.

N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv 1604.00772, section 4, without its
negative weights. Points are drawn from a normal distribution (mean m, deviation sigma, covariance
C), whose mean and C move towards the better half of them. What is minimised may be rough, as errors
of chaotic motions are: only the order of values counts.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

Function = Callable[[np.ndarray], float]


def minimise(
    function: Function,
    first: np.ndarray,
    budget: int,
    seed: int,
    sigma: float = 0.15,
) -> tuple[np.ndarray, float]:
    """Return the best point (n,) in the unit cube and its value, of `budget` evaluations.

    `first` is evaluated first. A point outside the cube is mirrored back at its border.
    """
    if budget < 1:
        raise ValueError(f"budget = {budget}; it must be at least 1")
    rng, n = np.random.default_rng(seed), len(first)
    best, least = np.array(first, float), function(np.array(first, float))
    size = 4 + int(3 * np.log(n))
    chosen = size // 2
    weights = np.log((size + 1) / 2) - np.log(np.arange(1, chosen + 1))
    weights /= weights.sum()
    mu = 1 / (weights**2).sum()  # how many points the weights are worth
    c_sigma, c_c = (mu + 2) / (n + mu + 5), (4 + mu / n) / (n + 4 + 2 * mu / n)
    c_1 = 2 / ((n + 1.3) ** 2 + mu)
    c_mu = min(1 - c_1, 2 * (mu - 2 + 1 / mu) / ((n + 2) ** 2 + mu))
    damping = 1 + 2 * max(0, np.sqrt((mu - 1) / (n + 1)) - 1) + c_sigma
    usual = np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n))  # length of a normal vector
    mean, C = best.copy(), np.eye(n)
    path_sigma, path_c = np.zeros(n), np.zeros(n)
    left = budget - 1
    generation = 0
    while left > 0:
        generation += 1
        scales, axes = np.linalg.eigh(C)
        root = axes * np.sqrt(np.maximum(scales, 1e-20))
        draws = rng.standard_normal((min(size, left), n))
        points = mirrored(mean + sigma * draws @ root.T)
        values = np.array([function(point) for point in points])
        left -= len(points)
        if values.min() < least:
            best, least = points[values.argmin()].copy(), float(values.min())
        if len(points) < size:
            break
        steps = (points[np.argsort(values, kind="stable")[:chosen]] - mean) / sigma
        step = weights @ steps
        mean = mean + sigma * step
        whitened = axes @ ((axes.T @ step) / np.sqrt(np.maximum(scales, 1e-20)))
        path_sigma *= 1 - c_sigma
        path_sigma += np.sqrt(c_sigma * (2 - c_sigma) * mu) * whitened
        length = np.linalg.norm(path_sigma)
        grown = np.sqrt(1 - (1 - c_sigma) ** (2 * generation))
        steady = length / grown < (1.4 + 2 / (n + 1)) * usual
        path_c = (1 - c_c) * path_c + steady * np.sqrt(c_c * (2 - c_c) * mu) * step
        spread = (steps.T * weights) @ steps
        lost = 0 if steady else c_c * (2 - c_c)
        C = (1 - c_1 - c_mu + c_1 * lost) * C + c_1 * np.outer(path_c, path_c) + c_mu * spread
        sigma = min(sigma * np.exp(c_sigma / damping * (length / usual - 1)), 0.5)
    return best, least


def mirrored(points: np.ndarray) -> np.ndarray:
    """Return points with coordinates outside [0, 1] reflected at its ends."""
    folded = np.mod(points, 2)
    return np.where(folded > 1, 2 - folded, folded)
