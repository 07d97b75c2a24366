"""The joints of a model as sliders: which numbers there are, between which limits."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus._core import JointType, Model, ModelError, Pose, State
from saltus.records.tables import Array

CONTROL = 10.0
ANGLES = ("roll", "pitch", "yaw")


@dataclass(frozen=True)
class Slider:
    """One number of a posture.

    Attributes
    ----------
    name : str
        The coordinate's; of a ball joint the joint's, and which angle.
    unit : str
        "rad" or "m".
    lower, upper : float
        [rad | m] limits of the joint; where it has none, half a turn or `reach` both ways.
    get : callable
        Returns its value of coordinates q.
    set : callable
        Returns coordinates q with another value of it.
    velocities : list of int
        Those of its joint, in v.
    """

    name: str
    unit: str
    lower: float
    upper: float
    get: Callable[[Array], float]
    set: Callable[[Array, float], Array]
    velocities: list[int]


def sliders_of(model: Model, *, reach: float) -> list[Slider]:
    """Return the sliders of all joints of a model, in the order of its coordinates."""
    sliders = []
    for joint in model.joints:
        if joint.type is JointType.fixed:
            continue
        ball = [i for i in joint.coordinates if model.coordinates[i].unit == "1"]
        plain = [i for i in joint.coordinates if i not in ball]
        sliders += [_plain(model, i, list(joint.velocities), reach) for i in plain]
        if ball:
            sliders += [
                _angle(joint.name, ball, k, list(joint.velocities)) for k in range(len(ANGLES))
            ]
    return _once(sliders)


def controls_of(model: Model) -> list[dict[str, Any]]:
    """Return name and range of each actuator's control, for the page.

    A control may be a force, a target of a servo, or anything else that the model's author chose:
    where it has no limits, the slider goes from -10 to 10.
    """
    ranges = []
    for name, (lower, upper) in zip(model.control_names, model.control_limits, strict=True):
        low = float(lower) if math.isfinite(lower) else -CONTROL
        high = float(upper) if math.isfinite(upper) else CONTROL
        ranges.append({"name": name, "unit": "", "lower": min(low, 0.0), "upper": max(high, 0.0)})
    return ranges


def posture(model: Model, state: State, slider: Slider, value: float) -> State:
    """Return a state with another value of a slider; its joint stands still there.

    Raises ModelError on a value that is no number or outside of its limits.
    """
    if not slider.lower - 1e-9 <= value <= slider.upper + 1e-9:
        raise ModelError(
            f"{slider.name} = {value:g}; it is from {slider.lower:g} to {slider.upper:g}"
        )
    v = np.array(model.velocity(state))
    v[slider.velocities] = 0.0
    return model.state(slider.set(np.array(state.q), value), v, state.t)


def _plain(model: Model, i: int, velocities: list[int], reach: float) -> Slider:
    coordinate = model.coordinates[i]
    far = math.pi if coordinate.unit == "rad" else reach
    lower, upper = coordinate.lower, coordinate.upper
    if not (math.isfinite(lower) and math.isfinite(upper) and lower < upper):
        lower, upper = (
            lower if math.isfinite(lower) else min(-far, upper - far),
            upper if math.isfinite(upper) else max(far, lower + far),
        )

    def set_(q: Array, value: float) -> Array:
        q[i] = value
        return q

    return Slider(
        coordinate.name, coordinate.unit, lower, upper, lambda q: float(q[i]), set_, velocities
    )


def _angle(joint: str, ball: list[int], k: int, velocities: list[int]) -> Slider:
    """Return the slider of an angle of a ball joint, whose quaternion has these coordinates."""
    half = math.pi / 2 if k == 1 else math.pi

    def get(q: Array) -> float:
        return float(Pose.from_quaternion(q[ball]).rpy[k])

    def set_(q: Array, value: float) -> Array:
        rpy = np.array(Pose.from_quaternion(q[ball]).rpy)
        rpy[k] = value
        q[ball] = Pose.from_rpy(*rpy).quaternion
        return q

    return Slider(f"{joint} {ANGLES[k]}", "rad", -half, half, get, set_, velocities)


def _once(sliders: list[Slider]) -> list[Slider]:
    """Return each slider once: a mimic joint moves by the coordinate that it follows."""
    return list({slider.name: slider for slider in reversed(sliders)}.values())[::-1]
