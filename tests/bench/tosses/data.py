"""The tosses: read from tosses.npz, as poses and velocities in world axes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.bench.tosses.rotations import from_quaternions

FILE = "tosses.npz"
ROW = 1 / 148  # [s] between rows
EDGE = 0.1048  # [m] of the cube, the "width" of the errors
MASS = 0.37  # [kg]
INERTIA = 0.00081  # [kg m^2] about every axis
GRAVITY = 9.81  # [m/s^2]
CORNERS = EDGE / 2 * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])


@dataclass(frozen=True)
class Toss:
    """One toss. Axes are the world's, row k is at k * ROW."""

    number: int  # its number in the set
    poses: np.ndarray  # (rows, 4, 4) [m] of the cube's centre and axes
    velocities: np.ndarray  # (rows, 3) [m/s] of the centre
    spins: np.ndarray  # (rows, 3) [rad/s]


def load(folder: Path) -> list[Toss]:
    """Read all tosses of a folder; FileNotFoundError, in words, where they are not there."""
    file = Path(folder) / FILE
    if not file.is_file():
        raise FileNotFoundError(
            f'no file "{file}": the recorded tosses are no part of saltus. They are those of '
            "S. Pfrommer, M. Halm and M. Posa, ContactNets, CoRL 2020; a folder for this program "
            f'holds them as "{FILE}" with the arrays rows, start and toss'
        )
    with np.load(file) as arrays:
        missing = [name for name in ("rows", "start", "toss") if name not in arrays]
        if missing:
            raise ValueError(f'"{file}" lacks {", ".join(missing)}; it has {", ".join(arrays)}')
        rows, start, numbers = arrays["rows"].astype(float), arrays["start"], arrays["toss"]
    if rows.ndim != 2 or rows.shape[1] != 13:
        raise ValueError(f'"{file}": rows have shape {rows.shape}; it must be (n, 13)')
    if len(start) != len(numbers) + 1 or start[0] != 0 or start[-1] != len(rows):
        raise ValueError(
            f'"{file}": start has {len(start)} entries for {len(numbers)} tosses and ends at '
            f"{start[-1]} of {len(rows)} rows; it must have one more entry than there are tosses, "
            "from 0 to all rows"
        )
    pieces = np.split(rows, start[1:-1])
    return [toss(int(number), piece) for number, piece in zip(numbers, pieces, strict=True)]


def toss(number: int, rows: np.ndarray) -> Toss:
    """Make a toss of rows (n, 13): position, quaternion w x y z, velocity, spin in body axes."""
    poses = np.zeros((len(rows), 4, 4))
    poses[:, :3, :3] = from_quaternions(rows[:, 3:7])
    poses[:, :3, 3] = rows[:, :3]
    poses[:, 3, 3] = 1
    spins = np.einsum("nij,nj->ni", poses[:, :3, :3], rows[:, 10:])
    return Toss(number, poses, rows[:, 7:10], spins)


def halves(tosses: list[Toss]) -> tuple[list[int], list[int]]:
    """Return the indices to fit on (even) and to report on (odd)."""
    return list(range(0, len(tosses), 2)), list(range(1, len(tosses), 2))
