"""The benchmark of recorded tosses: what is found of a recording's faults, and the search."""

from __future__ import annotations

import numpy as np
import pytest
from tests.bench.tosses import data, flight, search
from toss_helpers import RNG, poses_at, random_start

# Calibration


def flown(number: int, scale: float, delay: float, part: float, noise: float = 0.0) -> data.Toss:
    """Return a toss that only flies, recorded with these faults."""
    rng = np.random.default_rng(number)
    t = data.ROW * np.arange(20)
    v, spin, place = rng.normal(0, 0.5, 3), rng.normal(0, 2, 3), (0, 0, 0.5)
    g = np.array([0, 0, -data.GRAVITY])
    poses = poses_at(place + np.outer(t, v) + np.outer(t**2, g / 2), np.outer(t, spin))
    poses[:, :3, 3] *= scale
    velocities = scale * (v + np.outer(t - delay, g)) + noise * rng.standard_normal((20, 3))
    spins = np.tile(spin, (20, 1))
    spins[0] *= part
    return data.Toss(number, poses, velocities, spins)


def test_calibration_finds_what_a_recording_has_wrong():
    tosses = [flown(k, 0.98, data.ROW / 2, 0.95) for k in range(8)]
    found = flight.calibrate(tosses)
    assert found.scale == pytest.approx(0.98, abs=1e-9)  # rounding: 1e-16 over t^2 = 0.02
    assert found.delay == pytest.approx(data.ROW / 2, abs=1e-9)
    assert found.spin == pytest.approx(0.95, abs=1e-9)


@pytest.mark.parametrize("whole_flight", [False, True])
def test_calibrated_starts_are_the_true_ones(whole_flight):
    bad, good = flown(3, 0.98, data.ROW / 2, 0.95), flown(3, 1.0, 0.0, 1.0)
    calibration = flight.Calibration(0.98, data.ROW / 2, 0.95, whole_flight)
    found, true = flight.start(bad, calibration), flight.start(good, flight.Calibration())
    np.testing.assert_allclose(found.pose, true.pose, atol=1e-12)
    np.testing.assert_allclose(found.velocity, true.velocity, atol=1e-11)
    np.testing.assert_allclose(found.spin, true.spin, atol=1e-11)
    assert found.rows == 20


def test_noise_of_first_rows_is_found():
    tosses = [flown(k, 1.0, 0.0, 1.0, noise=0.02) for k in range(200)]
    found = flight.noise_of(tosses, flight.Calibration())
    assert found.velocity == pytest.approx(0.02, rel=0.1)  # of 600 numbers: 4 % is a deviation
    assert found.spin < 1e-9
    start = random_start(5)
    same = [flight.disturbed(start, flight.Noise(0.1, 0.2), 7) for _ in range(2)]
    np.testing.assert_array_equal(same[0].velocity, same[1].velocity)
    assert not np.allclose(same[0].spin, start.spin)


def test_calibration_without_flights_is_refused():
    low = flown(0, 1.0, 0.0, 1.0)
    low.poses[:, 2, 3] = 0.05
    with pytest.raises(ValueError, match="no toss flies for 8 rows"):
        flight.calibrate([low])


# The search


def test_the_search_finds_a_minimum_in_a_rotated_valley():
    Q, _ = np.linalg.qr(RNG.normal(size=(5, 5)))
    scales, best = 10.0 ** np.arange(5), np.full(5, 0.4)
    calls = []

    def valley(x: np.ndarray) -> float:
        calls.append(x)
        return float(scales @ (Q @ (x - best)) ** 2)

    place, least = search.minimise(valley, np.full(5, 0.7), 1500, seed=3)
    assert len(calls) == 1500
    assert np.min(calls) >= 0
    assert np.max(calls) <= 1
    np.testing.assert_allclose(place, best, atol=1e-6)
    assert least == min(map(valley, calls[:1500]))
    again, _ = search.minimise(valley, np.full(5, 0.7), 1500, seed=3)
    np.testing.assert_array_equal(again, place)


def test_the_search_returns_its_start_if_nothing_is_better():
    place, least = search.minimise(lambda x: abs(x - 0.5).sum(), np.full(2, 0.5), 30, seed=0)
    assert least == 0
    np.testing.assert_array_equal(place, [0.5, 0.5])
    with pytest.raises(ValueError, match="budget = 0"):
        search.minimise(lambda x: 0.0, np.zeros(2), 0, seed=0)
