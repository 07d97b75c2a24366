"""What the sensors of a model read: thin readings of rows, of a run or of a moment."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy as np

from saltus._core import Model, ModelError, Sensor, SensorKind
from saltus.records.tables import Array

Indices = np.typing.NDArray[np.integer[Any]]


class Touch(NamedTuple):
    """Impulses between bodies: the row each counts to, its pair, and what acts on the first."""

    row: Indices
    pair: list[str]
    normal: Array  # [N s] shape (contacts,)
    impulse: Array  # [N s] with friction, in the world, shape (contacts, 3)


class Rows(NamedTuple):
    """Rows of a motion: what sensors are computed from."""

    model: Model
    t: Array
    q: Array
    v: Array
    control: Array
    touch: Callable[[], Touch]
    spans: Array  # [s] over which impulses of a row acted, 0 of the first


def sensor_of(model: Model, name: str) -> Sensor:
    """Return the sensor of a name; raise ModelError with the names there are."""
    for sensor in model.sensors:
        if sensor.name == name:
            return sensor
    names = ", ".join(model.sensor_names) or "none"
    raise ModelError(f'no sensor "{name}"; there are {names}')


def read_sensor(rows: Rows, sensor: Sensor) -> Array:
    """Return what a sensor reads, shape (rows,) or (rows, k)."""
    return READERS[sensor.kind](rows, sensor)


def _joint_rows(rows: Rows, sensor: Sensor, x: Array, of: str, constant: float) -> Array:
    joint = rows.model.joint(sensor.of)
    factor, offset = 1.0, 0.0
    columns = getattr(joint, of)
    while joint.mimic is not None:  # x_1 = m x_2 + o, x_2 = ...
        offset += factor * joint.mimic.offset
        factor *= joint.mimic.multiplier
        joint = rows.model.joint(joint.mimic.joint)
    out = x[:, columns] if factor == 1 and offset == 0 else factor * x[:, columns]
    out = out + constant * offset
    return out[:, 0] if len(columns) == 1 else out


def _jointpos(rows: Rows, sensor: Sensor) -> Array:
    return _joint_rows(rows, sensor, rows.q, "coordinates", 1.0)


def _jointvel(rows: Rows, sensor: Sensor) -> Array:
    return _joint_rows(rows, sensor, rows.v, "velocities", 0.0)


def _actuatorfrc(rows: Rows, sensor: Sensor) -> Array:
    names = list(rows.model.control_names)
    if sensor.of not in names:  # motors of its joint do not act
        return np.zeros(len(rows.t))
    forces = rows.model.actuator_forces(rows.q, rows.v, rows.control)
    return forces[:, names.index(sensor.of)]


def _pose(rows: Rows, sensor: Sensor) -> tuple[Array, Array]:
    """Return axes (rows, 3, 3) and origin (rows, 3) of the sensor in the world."""
    X_WL = rows.model.poses(rows.q, sensor.of)
    R_WL = X_WL[:, :3, :3]
    return R_WL @ sensor.X.R, X_WL[:, :3, 3] + R_WL @ sensor.X.p


def _twist(rows: Rows, sensor: Sensor) -> tuple[Array, Array]:
    """Return angular velocity and velocity of the sensor, (rows, 3) each, in the world's axes."""
    twist = rows.model.velocities(rows.q, rows.v, sensor.of)
    arm = rows.model.poses(rows.q, sensor.of)[:, :3, :3] @ sensor.X.p
    return twist[:, :3], twist[:, 3:] + np.cross(twist[:, :3], arm)


def _in_axes(R: Array, x: Array) -> Array:
    """Return vectors of the world in the axes of R, row by row."""
    out: Array = np.einsum("nij,ni->nj", R, x)
    return out


def _framequat(rows: Rows, sensor: Sensor) -> Array:
    """Return quaternions x y z w with w >= 0."""
    R = _pose(rows, sensor)[0]
    diagonal = np.diagonal(R, axis1=1, axis2=2)
    # 4 x x, 4 y y, 4 z z, 4 w w: from the greatest of them all are computed without cancellation
    squares = np.empty((len(R), 4))
    squares[:, :3] = 1 + 2 * diagonal - diagonal.sum(axis=1, keepdims=True)
    squares[:, 3] = 1 + diagonal.sum(axis=1)
    products = np.empty((len(R), 4, 4))
    products[:, :3, :3] = R + R.transpose(0, 2, 1)
    for i in range(4):
        products[:, i, i] = squares[:, i]
    for i, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
        products[:, i, 3] = products[:, 3, i] = R[:, k, j] - R[:, j, k]
    q: Array = products[np.arange(len(R)), squares.argmax(axis=1)]
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    return np.where(q[:, 3:] < 0, -q, q)


def _gyro(rows: Rows, sensor: Sensor) -> Array:
    return _in_axes(_pose(rows, sensor)[0], _twist(rows, sensor)[0])


def _velocimeter(rows: Rows, sensor: Sensor) -> Array:
    return _in_axes(_pose(rows, sensor)[0], _twist(rows, sensor)[1])


def _accelerometer(rows: Rows, sensor: Sensor) -> Array:
    """Return the mean since the row before: change of velocity by time, less gravity.

    It is read in the mean of the axes at both ends, which makes it of second order at the middle
    of the interval. Before the first row velocities are taken not to change.
    """
    R = _pose(rows, sensor)[0]
    v = _twist(rows, sensor)[1]
    acceleration = np.zeros_like(v)
    dt = np.diff(rows.t)[:, np.newaxis]
    np.divide(np.diff(v, axis=0), dt, out=acceleration[1:], where=dt > 0)
    before = np.concatenate([R[:1], R[:-1]])
    return _in_axes((R + before) / 2, acceleration - rows.model.gravity)


def _acting(rows: Rows, sensor: Sensor) -> tuple[Touch, Array]:
    """Return all impulses, and for each +1, -1 or 0: what of it acts on the sensor's link."""
    model = rows.model
    touch = rows.touch()
    links = model.link_names
    shapes = {shape.name: {shape.name, links[shape.link]} for shape in model.shapes}
    signs: dict[str, float] = {}
    for pair in set(touch.pair):
        first, _, second = pair.partition(" ~ ")
        sides = [shapes.get(side, shapes.get(_whole(side), set())) for side in (first, second)]
        signs[pair] = 0.0
        for (own, other), sign in zip((sides, sides[::-1]), (1.0, -1.0), strict=True):
            if sensor.of in own and (not sensor.other or sensor.other in other):
                signs[pair] = sign
    return touch, np.array([signs[pair] for pair in touch.pair])


def _whole(side: str) -> str:
    """Return the shape's name of `shape[part]`."""
    return side.rpartition("[")[0] if side.endswith("]") else side


def _per_time(rows: Rows, row: Indices, impulses: Array) -> Array:
    """Return the sums of impulses by row as mean forces."""
    out = np.zeros((len(rows.t), *impulses.shape[1:]))
    np.add.at(out, row, impulses)
    spans = rows.spans.reshape(-1, *[1] * (impulses.ndim - 1))
    return np.divide(out, spans, out=np.zeros_like(out), where=spans > 0)


def _touch(rows: Rows, sensor: Sensor) -> Array:
    touch, signs = _acting(rows, sensor)
    return _per_time(rows, touch.row, np.abs(signs) * touch.normal)


def _contactforce(rows: Rows, sensor: Sensor) -> Array:
    touch, signs = _acting(rows, sensor)
    return _per_time(rows, touch.row, signs[:, np.newaxis] * touch.impulse)


READERS: dict[SensorKind, Callable[[Rows, Sensor], Array]] = {
    SensorKind.jointpos: _jointpos,
    SensorKind.jointvel: _jointvel,
    SensorKind.actuatorfrc: _actuatorfrc,
    SensorKind.framepos: lambda rows, sensor: _pose(rows, sensor)[1],
    SensorKind.framequat: _framequat,
    SensorKind.framelinvel: lambda rows, sensor: _twist(rows, sensor)[1],
    SensorKind.frameangvel: lambda rows, sensor: _twist(rows, sensor)[0],
    SensorKind.velocimeter: _velocimeter,
    SensorKind.gyro: _gyro,
    SensorKind.accelerometer: _accelerometer,
    SensorKind.touch: _touch,
    SensorKind.contactforce: _contactforce,
}


def touches(row: Iterable[int], pair: Iterable[str], *numbers: Iterable[object]) -> Touch:
    """Make a Touch of columns: the normal impulse, the friction and the normal follow the pair."""
    normal, tangential, direction = (np.array(list(x), dtype=np.float64) for x in numbers)
    impulse = normal[:, np.newaxis] * direction.reshape(-1, 3) + tangential.reshape(-1, 3)
    return Touch(np.array(list(row), dtype=np.int64), list(pair), normal, impulse)
