"""Rotation matrices, quaternions w x y z and turn vectors (axis times angle)."""

from __future__ import annotations

import numpy as np


def from_quaternions(quaternions: np.ndarray) -> np.ndarray:
    """Return the matrices (n, 3, 3) of quaternions (n, 4), w x y z of any norm but 0."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    matrices = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return np.moveaxis(matrices, 2, 0)


def quaternion(R: np.ndarray) -> np.ndarray:
    """Return the unit quaternion w x y z of a rotation (3, 3), by its largest component."""
    squares = 1 + np.array([np.trace(R), *(2 * np.diag(R) - np.trace(R))])  # 4 w^2, 4 x^2, ...
    k = int(np.argmax(squares))
    x, y, z = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    a, b, c = R[0, 1] + R[1, 0], R[0, 2] + R[2, 0], R[1, 2] + R[2, 1]
    columns = [(squares[0], x, y, z), (x, squares[1], a, b), (y, a, squares[2], c)]
    columns.append((z, b, c, squares[3]))
    return np.array(columns[k]) / (2 * np.sqrt(squares[k]))


def from_turns(turns: np.ndarray) -> np.ndarray:
    """Return the matrices (n, 3, 3) of turn vectors (n, 3) [rad]."""
    angles = np.linalg.norm(turns, axis=1, keepdims=True)
    halves = 0.5 * np.sinc(angles / (2 * np.pi))  # sin(angle / 2) / angle, 1/2 at 0
    return from_quaternions(np.hstack([np.cos(angles / 2), halves * turns]))


def to_turns(matrices: np.ndarray) -> np.ndarray:
    """Return the turn vectors (n, 3) [rad] of rotations (n, 3, 3), of at most pi."""
    quaternions = np.array([quaternion(R) for R in matrices])
    quaternions *= np.where(quaternions[:, :1] < 0, -1, 1)
    sines = np.linalg.norm(quaternions[:, 1:], axis=1, keepdims=True)
    angles = 2 * np.arctan2(sines, quaternions[:, :1])
    return quaternions[:, 1:] * np.divide(
        angles, sines, out=np.full_like(sines, 2), where=sines > 0
    )
