"""What the free flight says of the recording, before any engine and any contact.

The centre falls on a parabola. Its curvature is g in the recording's metres, which gives their
length; the height's slope is the true velocity, and where the row's velocity is that of a moment
before, it is greater by g times the delay. The cube turns uniformly, and what the first row has of
that spin is what the smoothing, or the hand that lets go, has left of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tests.bench.tosses.data import CORNERS, GRAVITY, ROW, Toss
from tests.bench.tosses.rotations import from_turns, to_turns

CLEAR = 0.006  # [m] of the lowest corner above z = 0: no contact yet, wherever the table is
LEAST_ROWS = 8  # a shorter flight says nothing of its curvature


@dataclass(frozen=True)
class Calibration:
    """What a recording's numbers mean; the default takes them as they are."""

    scale: float = 1.0  # recorded metres in one
    delay: float = 0.0  # [s] by which velocities are older than their row
    spin: float = 1.0  # the first row's spin as a part of that of the flight
    whole_flight: bool = False  # start from velocities that fit all the flight, not from row 0


@dataclass(frozen=True)
class Start:
    """A toss's first row in true metres: what an engine is given."""

    pose: np.ndarray  # (4, 4)
    velocity: np.ndarray  # (3,) [m/s] world
    spin: np.ndarray  # (3,) [rad/s] world
    rows: int  # how many to simulate, the first among them


@dataclass(frozen=True)
class Noise:
    """Standard deviations of a component of the velocities at the start."""

    velocity: float  # [m/s]
    spin: float  # [rad/s]
    seed: int = 0


def flight_rows(toss: Toss) -> int:
    """Return how many rows there are before the first one near the table."""
    low = toss.poses[:, 2, 3] + (toss.poses[:, 2, :3] @ CORNERS.T).min(axis=1)
    near = np.flatnonzero(low < CLEAR)
    return int(near[0]) if len(near) else len(low)


def calibrate(tosses: list[Toss]) -> Calibration:
    """Return scale and delay as medians over the flights of tosses, spin by least squares."""
    pulls, leads, seen, true = [], [], [], []
    for toss in tosses:
        n = flight_rows(toss)
        if n < LEAST_ROWS:
            continue
        c, b, _ = np.polyfit(ROW * np.arange(n), toss.poses[:n, 2, 3], 2)
        pulls.append(-2 * c)
        middle = ROW * (n - 1) / 2  # where a parabola's slope is known best
        leads.append(np.mean(toss.velocities[:n, 2]) - (b + 2 * c * middle))
        seen.append(toss.spins[0])
        true.append(whole_flight(toss, n, 1.0)[2])
    if not pulls:
        raise ValueError(f"no toss flies for {LEAST_ROWS} rows: nothing to calibrate with")
    g = float(np.median(pulls))
    part = np.vdot(seen, true) / np.vdot(true, true)
    return Calibration(g / GRAVITY, float(np.median(leads)) / g, float(part))


def start(toss: Toss, calibration: Calibration) -> Start:
    """Return what an engine starts from."""
    pose = toss.poses[0].copy()
    pose[:3, 3] /= calibration.scale
    velocity, spin = toss.velocities[0] / calibration.scale, toss.spins[0] / calibration.spin
    velocity = velocity - (0, 0, GRAVITY * calibration.delay)
    n = flight_rows(toss)
    if calibration.whole_flight and n >= LEAST_ROWS:
        pose, velocity, spin = whole_flight(toss, n, calibration.scale)
    return Start(pose, velocity, spin, len(toss.poses))


def disturbed(start: Start, noise: Noise, toss: int) -> Start:
    """Return a start with other velocities, the same ones whenever it is called for a toss."""
    rng = np.random.default_rng((noise.seed, toss))
    velocity = start.velocity + noise.velocity * rng.standard_normal(3)
    return replace(start, velocity=velocity, spin=start.spin + noise.spin * rng.standard_normal(3))


def noise_of(tosses: list[Toss], calibration: Calibration) -> Noise:
    """Return how far the first row's velocities are from those that fit all the flight.

    68 % of the components are nearer than this, as with a normal distribution's deviation.
    """
    away = []
    for toss in tosses:
        if flight_rows(toss) >= LEAST_ROWS:
            first, fitted = (start(toss, replace(calibration, whole_flight=w)) for w in (0, 1))
            away.append([first.velocity - fitted.velocity, first.spin - fitted.spin])
    velocity, spin = np.percentile(np.abs(away), 68, axis=(0, 2))
    return Noise(float(velocity), float(spin))


def whole_flight(toss: Toss, n: int, scale: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return pose, velocity and spin of the first row that fit n rows of free flight best.

    A cube has one moment about all axes, so it turns uniformly.
    """
    t = ROW * np.arange(n)
    places = toss.poses[:n, :3, 3] / scale
    places[:, 2] += GRAVITY / 2 * t**2
    velocity, place = np.polyfit(t, places, 1)
    R = toss.poses[:n, :3, :3]
    start, spin = R[0], toss.spins[0]
    for _ in range(5):  # Newton: what is left is small, and turns by small angles add up
        expected = from_turns(np.outer(t, spin)) @ start
        left = to_turns(R @ expected.transpose(0, 2, 1))
        rate, offset = np.polyfit(t, left, 1)
        spin, start = spin + rate, from_turns(offset[None])[0] @ start
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = start, place
    return pose, velocity, spin
