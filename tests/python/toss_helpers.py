"""Made-up tosses, for the tests of the benchmark of recorded ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from tests.bench.tosses import data, flight, rotations

RNG = np.random.default_rng(5)
MATERIAL = {"restitution": 0.2, "friction": 0.25, "inertia": 8.1e-4}
MATERIAL |= {"tilt_x": 0.004, "tilt_y": -0.003, "height": 1e-3}


def poses_at(places: np.ndarray, turns: np.ndarray) -> np.ndarray:
    poses = np.tile(np.eye(4), (len(places), 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = rotations.from_turns(turns), places
    return poses


def random_start(rows: int, height: float = 0.15, seed: int = 0) -> flight.Start:
    rng = np.random.default_rng(seed)
    pose = poses_at([[*rng.normal(0, 0.2, 2), height]], rng.normal(0, 1, (1, 3)))[0]
    return flight.Start(pose, rng.normal(0, 0.5, 3), rng.normal(0, 2, 3), rows)


def recorded_rows(poses: np.ndarray, velocity: np.ndarray, spin: np.ndarray) -> np.ndarray:
    """Return rows of the data's layout; only the first has velocities."""
    rows = np.zeros((len(poses), 13))
    rows[:, :3] = poses[:, :3, 3]
    rows[:, 3:7] = [rotations.quaternion(R) for R in poses[:, :3, :3]]
    rows[0, 7:10], rows[0, 10:] = velocity, poses[0, :3, :3].T @ spin
    return rows


def save(folder: Path, pieces: list[np.ndarray]) -> None:
    start = np.cumsum([0, *map(len, pieces)])
    rows = np.concatenate(pieces).astype(np.float32)
    np.savez(folder / data.FILE, rows=rows, start=start, toss=np.arange(len(pieces)) + 100)
